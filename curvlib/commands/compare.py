"""`curvlib compare`: an estimator of yours against the others, on meshes with exact curvature."""

import click

from .terminal import (
    json_option,
    number,
    progress,
    put_json,
    table_text,
    threads_option,
)


@click.command()
@click.argument("mine", metavar="MINE.py")
@click.option(
    "--against", multiple=True, metavar="NAME", help="May be repeated. Default: all estimators."
)
@click.option(
    "-n",
    "resolutions",
    type=click.IntRange(8),
    multiple=True,
    default=(25, 50, 100),
    show_default=True,
    help="Meshes of n^2 vertices; may be repeated.",
)
@click.option("--seeds", type=click.IntRange(1), default=3, show_default=True, help="Meshes each.")
@click.option("-o", "--output", metavar="CSV", help="All errors and orders.")
@json_option
@threads_option
def command(mine, against, resolutions, seeds, output, as_json, threads):
    """Compare an estimator with others: errors, orders, ranks.

    On irregular meshes of a torus, an ellipsoid and an open patch, inside and at the boundary.
    MINE.py is a file, or a name of `curvlib list`.
    """
    import pandas

    import curvlib
    from curvlib.comparison.calls import Call
    from curvlib.comparison.survey import survey
    from curvlib.files import whole_file
    from curvlib.signatures import readings

    names = [mine, *(name for name in against or curvlib.estimators() if name != mine)]
    for name in names:
        readings(name)  # unknown names and files that fail are told before any work
    resolutions = sorted(set(resolutions))
    parts = [survey([name], threads, resolutions, range(seeds)) for name in progress(names, str)]
    table = pandas.concat(parts, ignore_index=True)
    place = ["surface", "place", "quantity", "n"]
    table["rank"] = table.groupby(place).value.rank(method="min")
    if output:
        with whole_file(output) as part:
            table.to_csv(part, index=False, lineterminator="\n")
    finest = table[table.n == resolutions[-1]]
    own, rows = finest[finest.estimator == str(Call(mine, {}))], []
    for row in own.sort_values(place).to_dict("records"):
        same = finest[(finest[place] == [row[key] for key in place]).all(axis=1)]
        best = same.sort_values("rank").iloc[0]
        known = int(same.value.notna().sum())
        rows.append(row | {"of": known, "best": best.estimator, "best_value": best.value})
    if as_json:
        put_json({"mine": mine, "n": resolutions[-1], "rows": rows, "written": output})
        return
    print(f"{mine} against {len(names) - 1} estimators, n = {resolutions[-1]}, mean errors:")
    shown = [
        (
            f"{row['surface']}, {row['place']}",
            row["quantity"],
            number(row["value"]),
            number(row["order"]),
            f"{row['rank']:.0f} of {row['of']}" if row["rank"] == row["rank"] else "-",
            f"{row['best']} {number(row['best_value'])}",
            f"{row['defined']:.0%}",
        )
        for row in rows
    ]
    print(table_text(("", "", "error", "order", "rank", "best", "defined"), shown))
    print(f"written: {output}" if output else "next: -o all.csv, for every estimator and n")
