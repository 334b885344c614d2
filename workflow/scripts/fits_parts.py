"""Measure what each part of the fits is worth, where they fail, and what lies beyond them."""

from curvlib.comparison.ablation import compact, jets
from curvlib.comparison.boundary import boundary, over_square
from curvlib.comparison.contraction import contraction
from curvlib.comparison.frontier import on
from curvlib.comparison.held_out import CLOSED, KINDS
from curvlib.comparison.moonshots import halves, seconds
from curvlib.comparison.negatives import measures
from curvlib.comparison.voxels import SPHERES, voxels
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    sizes, tables = snakemake.params.resolutions, {}
    few, n = sizes[:3], sizes[min(1, len(sizes) - 1)]
    every = [(surface, kind) for surface, kinds in KINDS.items() for kind in kinds]
    opened = [(surface, kind) for surface, kind in every if surface not in CLOSED]
    some = [("pear", "jittered"), ("pear", "random"), *(x for x in opened if x[0] == "wave")]
    tables["ablation_jets"] = jets(on(some, [n]))
    tables["ablation_compact"] = compact(on(some, [n]))
    tables["contraction"] = contraction(on(every, few))
    tables["boundary"] = boundary(on(opened, few[1:] or few))
    round_ones = [("torus", "jittered"), ("pear", "jittered"), ("blob", "jittered")]
    tables["hessians"] = seconds(on(round_ones, few[1:] or few))
    (shown,) = on([("wave", "jittered")], [n]).values()
    tables["map"] = over_square(shown)
    tables["measures"] = measures(on(round_ones, few[1:] or few))
    tables["half"] = halves(on([("pear", "jittered"), ("bump", "jittered")], [n]), (0.01, 0.05), n)
    tables["voxel"] = voxels(list(SPHERES) if n >= 50 else list(SPHERES)[:1])
    for name, table in tables.items():
        table.to_csv(snakemake.output[name], index=False)
