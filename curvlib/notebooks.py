"""An estimate as notebooks show it."""


def as_html(estimates) -> str:
    """A table of quantiles over the area, with what is undefined and the shares of the shapes."""
    from .columns import CATEGORIES, CODES, columns
    from .regions import PROBABILITIES, quantiles, shares

    mesh, per = estimates.mesh, estimates.per
    heads = "".join(f"<th>{100 * p:.0f} %</th>" for p in PROBABILITIES)
    rows = [
        f"<tr><th>{name}</th>{''.join(f'<td>{x:.4g}</td>' for x in found)}</tr>"
        for name, values in columns(estimates).items()
        if values.ndim == 1 and name not in CODES
        for found in [quantiles(mesh, values, per)]
    ]
    parts = zip(CATEGORIES, shares(mesh, estimates.category, len(CATEGORIES), per))
    shapes = ", ".join(f"{name} {part:.0%}" for name, part in parts if part >= 0.005)
    lacking = ", ".join(f"{n} {cause}" for cause, n in estimates.undefined.items()) or "nowhere"
    return (
        f"<p>{repr(estimates)[1:-1]}; undefined: {lacking}</p>"
        f"<table><tr><th>over the area</th>{heads}</tr>{''.join(rows)}</table>"
        f"<p>Shape by area: {shapes or 'undefined'}</p>"
    )
