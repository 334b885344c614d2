"""What the comparison of 2020 found, as claims on its numbers and on those obtained again."""

from collections import namedtuple

import numpy as np
import pandas as pd

Sentence = namedtuple("Sentence", "number sentence methods quantities meshes measure holds")
Sentence.__doc__ = """A sentence in our words: of which `methods` (a, b), `quantities` and `meshes`;
`measure`: what the effect is; `holds`: of effects (m,), whether it holds at each."""

# Obtained errors within this part of the published ones are the same, or near.
SAME, NEARLY = 0.05, 0.5

SENTENCES = [
    Sentence(
        1,
        "On voxels, weights by area reduce the error of k1 of vector voting.",
        ("AVV", "RVV"),
        ("k1",),
        ("voxel-sphere-10", "voxel-sphere-30"),
        "error of AVV over that of RVV",
        lambda x: x < 1,
    ),
    Sentence(
        2,
        "On voxels VTK's one-ring values have ten times the error of vector voting or more.",
        ("VTK", "AVV"),
        ("k1", "k2", "H"),
        ("voxel-sphere-10", "voxel-sphere-30"),
        "error of VTK over that of AVV",
        lambda x: x >= 10,
    ),
    Sentence(
        3,
        "On a smooth torus of exact vertices VTK's values are better than those of vector voting.",
        ("VTK", "AVV"),
        ("k1", "k2", "H"),
        ("torus-25-10",),
        "error of VTK over that of AVV",
        lambda x: x < 1,
    ),
    Sentence(
        4,
        "On spheres of marching cubes vector voting is better than VTK's values.",
        ("AVV", "VTK"),
        ("k1", "k2", "H"),
        ("smooth-sphere-10", "smooth-sphere-20"),
        "error of AVV over that of VTK",
        lambda x: x < 1,
    ),
]


def verdicts(obtained: pd.DataFrame) -> pd.DataFrame:
    """claims-2020.csv: every published number with its verdict.

    Parameters
    ----------
    obtained : DataFrame
        From `curvlib.comparison.published.obtained`.

    Returns
    -------
    DataFrame
        With `ratio`, ours over published, and `verdict`: `same` within 5 %, `near` within 50 %,
        `smaller` or `larger` beyond; `not here` where the method is not in this package or its
        library not installed, `other mesh` where it has another number of elements.
    """
    ratio = obtained.ours / obtained.published
    off = (ratio - 1).abs()
    verdict = np.where(ratio < 1, "smaller", "larger")
    verdict = np.where(off <= NEARLY, "near", verdict)
    verdict = np.where(off <= SAME, "same", verdict)
    verdict = np.where(obtained["values"] != obtained.elements, "other mesh", verdict)
    verdict = np.where(obtained.ours.isna(), "not here", verdict)
    return obtained.assign(ratio=ratio, verdict=verdict)


def sentences(obtained: pd.DataFrame) -> pd.DataFrame:
    """claims-2020-sentences.csv: the SENTENCES, on the published numbers and on ours.

    Returns
    -------
    DataFrame
        Per sentence and `numbers` (`published`, `ours`): the `least` and the `largest` effect, in
        how many `cases`, and `holds`: `true` in all, `false` in none, `in part`, or `undecided`
        without numbers.
    """
    rows = []
    for claim in SENTENCES:
        for numbers in ("published", "ours"):
            effects = _effects(claim, obtained, numbers)
            holds = claim.holds(effects)
            verdict = "true" if holds.all() else "in part" if holds.any() else "false"
            row = {"claim": claim.number, "sentence": claim.sentence, "measure": claim.measure}
            row |= {"numbers": numbers, "cases": len(effects)}
            if len(effects):
                row |= {"least": effects.min(), "largest": effects.max(), "holds": verdict}
            else:
                row |= {"least": np.nan, "largest": np.nan, "holds": "undecided"}
            rows.append(row)
    return pd.DataFrame(rows)


def _effects(claim, table, numbers):
    first, second = claim.methods
    rows = table[table.quantity.isin(claim.quantities) & table.mesh.isin(claim.meshes)]
    effects = []
    for _, own in rows.groupby(["mesh", "quantity"], sort=False):
        by = own.set_index("radius_hit")
        a, b = (by[by.method == name][numbers] for name in (first, second))
        # A method of one ring has no radius: it is compared with the other at each.
        alone = a.index.isna().all() or b.index.isna().all()
        if alone:
            effects += [x / y for x in a for y in b]
        else:
            effects += [a[hit] / b[hit] for hit in a.index.intersection(b.index)]
    effects = np.array(effects, float)
    return effects[np.isfinite(effects)]
