"""Do our guesses of shapes matter? The paper's ranking on random shapes."""

import pandas as pd

from .cell import NINE, Holds
from .evidence import Evidence
from .explanations import BEST, RANKING

# Longest over shortest edge, median over the triangles: the paper's seven surfaces have less.
LONG = 4
ALL = "all"
KEY = ["reading", "family", "triangles"]

# The option whose other values are tried in the best explanation.
TRIED = "dihedral"


def readings_on_shapes(readings) -> pd.DataFrame:
    """The rows of readings.csv for shapes: the default, the best explanation where the study has
    it, and that with the other values of TRIED, called `best-explanation,dihedral=signed`.

    An estimator without such a variant in `readings` keeps its own.
    """
    first = readings[readings.reading == BEST]
    known = set(zip(readings.estimator, readings.variant))
    chosen = [readings[readings.reading == "default"], first]
    values = readings.variant.str.extract(rf"\b{TRIED}=([^,]*)")[0]
    for choice in TRIED + "=" + values.dropna().drop_duplicates():
        other = first.variant.str.replace(rf"\b{TRIED}=[^,]*", choice, regex=True)
        exists = [pair in known for pair in zip(first.estimator, other)]
        other = other.where(exists, first.variant)
        if not other.equals(first.variant):
            chosen.append(first.assign(reading=f"{BEST},{choice}", variant=other))
    return pd.concat(chosen, ignore_index=True)


def guesses(shapes, readings) -> pd.DataFrame:
    """guesses.csv: on how many random shapes the paper's ranking comes out.

    Parameters
    ----------
    shapes : DataFrame
        shapes.csv: errors of every variant on every shape.
    readings : DataFrame
        What the readings on shapes are, from `readings_on_shapes`.

    Returns
    -------
    DataFrame
        Per reading, `family` of shapes and kind of `triangles` (`short`, `long`: the median of
        longest over shortest edge above 4; `all` of each too): the number of `shapes`; on how many
        claims 1, 2 and 6 are true and degenerate (`claim_1`, `claim_1_degenerate`, ...); the mean
        rank of Gauss-Bonnet for H (`gauss_bonnet_H`). Readings without all nine are left out.
    """
    evidence = Evidence(shapes.assign(paper=True, full=True))
    about = shapes.drop_duplicates("surface").set_index("surface")
    rows = []
    for name, reading in readings.groupby("reading", sort=False):
        if set(NINE) - set(reading.estimator):
            continue
        ranks = {
            cell.surface: cell.ranks["H"][-1][NINE.index("gauss_bonnet")]
            for _, cell in evidence.cells(reading)
            if cell.complete["H"][-1]
        }
        for row in evidence.rows(reading):
            if row["claim"] in RANKING:
                surface = row["surface"]
                kind = "long" if about.elongation[surface] > LONG else "short"
                rows.append(
                    {"reading": name, "family": about.family[surface], "triangles": kind}
                    | {"surface": surface, "claim": row["claim"], "holds": row["holds"]}
                    | {"rank": ranks.get(surface)}
                )
    if not rows:
        return pd.DataFrame(columns=KEY)
    rows = pd.DataFrame(rows)
    rows = pd.concat([rows, rows.assign(family=ALL)])
    rows = pd.concat([rows, rows.assign(triangles=ALL)])
    groups = rows.groupby(KEY, sort=False)
    table = groups.agg(shapes=("surface", "nunique"), gauss_bonnet_H=("rank", "mean"))
    for claim in RANKING:
        for holds, column in ((Holds.TRUE, "claim_{}"), (Holds.DEGENERATE, "claim_{}_degenerate")):
            counted = (rows.claim == claim) & (rows.holds == holds.value)
            table[column.format(claim)] = (
                rows[counted].groupby(KEY).size().reindex(table.index, fill_value=0)
            )
    return table.reset_index()
