"""Obtain the numbers of the comparison of 2020 again, and decide what it found."""

from curvlib.benchmark.plan import Plan
from curvlib.claims.comparison_2020 import sentences, verdicts
from curvlib.comparison.published import obtained
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    found = obtained(Plan(snakemake.input[0]).published_2020)
    tables = {"claims_2020": verdicts(found), "claims_2020_sentences": sentences(found)}
    for name, table in tables.items():
        table.to_csv(snakemake.output[name], index=False, lineterminator="\n")
