"""Decide every claim for every surface, diagonal and reading, and sum up."""

import json
from pathlib import Path

import pandas as pd

from curvlib.claims.answer import answer, findings, in_words
from curvlib.claims.evidence import decide
from curvlib.claims.explanations import search
from curvlib.claims.guesses import guesses, readings_on_shapes
from curvlib.claims.summary import agreement, decided_by_ties, on_other_cuts, summary
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    output = snakemake.output
    tables = {name: pd.read_csv(file) for name, file in snakemake.input.items()}
    explanations, convergence, shapes = map(tables.pop, ("explanations", "convergence", "shapes"))
    claims = decide(**tables)
    claims.to_csv(output.claims, index=False)
    agreement(tables["readings"], tables["variants"]).to_csv(output.agreement, index=False)
    on_shapes = readings_on_shapes(tables["readings"])
    guesses(shapes, on_shapes).to_csv(output.guesses, index=False)
    table = summary(claims, tables["readings"])
    table.to_csv(output.summary, index=False)
    searched, elsewhere = search(explanations), on_other_cuts(claims)
    told = findings(table, searched, convergence, elsewhere) | {
        "search": searched,
        "on_other_cuts": elsewhere,
        "decided_by_ties": decided_by_ties(tables["readings"], tables["variants"]),
    }
    Path(output.findings).write_text(json.dumps(told, indent=1), encoding="utf-8")
    words = answer(table, told, tables["variants"].n.max())
    Path(output.answer).write_text(words, encoding="utf-8")
    Path(output.words).write_text(in_words(table), encoding="utf-8")
