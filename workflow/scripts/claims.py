"""Decide every claim for every surface, diagonal and reading, and sum up."""

from pathlib import Path

import pandas as pd

from curvlib.claims import evidence
from curvlib.claims.summary import answer, in_words, summary
from curvlib.comparison import accuracy
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, params, output = snakemake.input, snakemake.params, snakemake.output
    rows = accuracy.by_variant(map(pd.read_csv, inputs.errors), set(map(tuple, params.full)))
    noise, rings = (pd.concat(map(pd.read_csv, files)) for files in (inputs.noise, inputs.rings))
    slopes = evidence.ring_slopes(rings)
    slopes.to_csv(output.rings, index=False)
    found = evidence.Evidence(rows, noise, slopes)
    readings = pd.DataFrame(params.readings).groupby("reading", sort=False)
    claims = pd.DataFrame(row for _, reading in readings for row in found.decide(reading))
    claims.to_csv(output.claims, index=False)
    table = summary(claims, params.named, params.singles, params.diagonals)
    table.to_csv(output.summary, index=False)
    Path(output.answer).write_text(answer(table), encoding="utf-8")
    Path(output.words).write_text(in_words(table), encoding="utf-8")
