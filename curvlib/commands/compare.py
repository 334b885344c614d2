"""`curvlib compare`: an estimator of yours against the others, on meshes with exact curvature."""

import click

from .terminal import (
    PATH,
    check_picture,
    json_option,
    names_of,
    number,
    progress,
    put_json,
    table_text,
    threads_option,
    told_of_compiling,
)

FIRST = 5  # of the standing that are shown


@click.command()
@click.argument("mine", metavar="MINE.py", type=PATH)
@click.option(
    "--against",
    multiple=True,
    metavar="NAME",
    shell_complete=names_of("estimators"),
    help="May be repeated. Default: all estimators.",
)
@click.option(
    "-n",
    "resolutions",
    type=click.IntRange(8),
    multiple=True,
    default=(25, 50, 100),
    metavar="N",
    help="Meshes of N^2 vertices, at least 8^2; may be repeated. Default: 25, 50 and 100.",
)
@click.option(
    "--seeds",
    type=click.IntRange(1),
    default=3,
    metavar="N",
    help="Meshes of each surface and size. Default: 3.",
)
@click.option(
    "--seed",
    type=click.IntRange(0),
    metavar="N",
    help="Of the first mesh. Default: drawn anew each time, so that nothing is tuned to it.",
)
@click.option("-o", "--output", metavar="CSV", type=PATH, help="All errors, orders and ranks.")
@click.option("--picture", metavar="PNG", type=PATH, help="Errors against n, among all others.")
@json_option
@threads_option
def command(mine, against, resolutions, seeds, seed, output, picture, as_json, threads):
    """Compare an estimator with others: errors, orders, ranks.

    On irregular meshes of a torus, an ellipsoid and an open patch, inside and at the boundary.
    MINE.py is a file, or a name of `curvlib list`.
    """
    import secrets

    import pandas

    import curvlib
    from curvlib.comparison.calls import Call
    from curvlib.comparison.standing import beside_best, ranked, standing
    from curvlib.comparison.survey import survey
    from curvlib.files import whole_file
    from curvlib.signatures import readings

    names = [mine, *(name for name in against or curvlib.estimators() if name != mine)]
    for name in names:
        readings(name)  # unknown names and files that fail are told before any work
    check_picture(picture)
    resolutions = sorted(set(resolutions))
    seed = secrets.randbelow(10**6) if seed is None else seed
    drawn = range(seed, seed + seeds)
    with told_of_compiling():
        parts = [survey([name], threads, resolutions, drawn) for name in progress(names, str)]
    table = ranked(pandas.concat(parts, ignore_index=True))
    own = str(Call(mine, {}))
    if output:
        with whole_file(output) as part:
            table.to_csv(part, index=False, lineterminator="\n")
    if picture:
        from curvlib.figures.standing import standing_plot
        from curvlib.figures.style import save

        save(standing_plot(table, own), picture)
    written = [path for path in (output, picture) if path]
    rows, overall = beside_best(table, own), standing(table)
    if as_json:
        ratios = overall.to_dict("index")
        told = {"mine": mine, "n": resolutions[-1], "seed": seed, "rows": rows, "ratios": ratios}
        put_json(told | {"written": written})
        return
    others, meshes = table.estimator.nunique() - 1, f"{seeds} mesh{'es' * (seeds > 1)}"
    print(f"{mine} against {others} others, n = {resolutions[-1]}, {meshes} of each surface")
    print(f"(--seed {seed} makes the same); mean errors:")
    shown = [
        (
            f"{row['surface']}, {row['place']}",
            row["quantity"],
            number(row["value"]),
            decimal(row["order"]),
            f"{row['rank']:.0f} of {row['of']}" if row["rank"] == row["rank"] else "-",
            f"{row['best']} {number(row['best_value'])}",
            f"{row['defined']:.0%}",
        )
        for row in rows
    ]
    print(table_text(("", "", "error", "order", "rank", "best", "defined"), shown))
    print("\nover the best error, geometric mean of the surfaces, inside:")
    place = overall.index.get_loc(own)
    lines = [
        (f"{at + 1}. {name}", *map(decimal, overall.loc[name]))
        for at, name in enumerate(overall.index)
        if at < FIRST or at == place
    ]
    print(table_text(("", *overall), lines))
    print(f"written: {', '.join(written)}" if written else "next: -o all.csv --picture all.png")


def decimal(value):
    """Two decimals; "-" for NaN."""
    return "-" if value != value else f"{value:.2f}"
