"""What --rings, --radius and --set choose for an estimator."""

import click


def options_of(name, options):
    """The options of an estimator from --rings, --radius and --set."""
    from curvlib.errors import InputError, check_name
    from curvlib.kit.options import Lengths
    from curvlib.signatures import readings

    texts = {}
    for pair in options["chosen"]:
        option, equals, value = pair.partition("=")
        if not equals:
            raise click.UsageError(f"--set {pair!r}: expected option=value")
        texts[option.strip()] = value.strip()
    for option in ("rings", "radius"):
        if options[option] is not None:
            texts[option] = str(options[option])
    known, chosen = readings(name), {}
    for option, words in texts.items():
        check_name(f"option of {name}", option, known)
        valid = known[option]
        same = [value for value in valid if str(value) == words]
        if isinstance(valid, Lengths) and not same:
            try:
                same = [float(words)]
            except ValueError:
                same = [words]
        if not same and not valid[1:]:
            raise InputError(f"{option} of {name}: has one value alone, {valid[0]}")
        chosen[option] = same[0] if same else words
    return chosen
