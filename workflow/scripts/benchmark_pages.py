"""Write the recommendation, and the page "Which estimator should I use?"."""

from pathlib import Path

import pandas as pd

from curvlib.benchmark.page import recommendation, which
from curvlib.benchmark.plan import Plan
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    files = snakemake.input
    names = ("advice", "situations", "cost", "methods")
    found = [pd.read_csv(files[name], keep_default_na=name != "methods") for name in names]
    text = recommendation(found[0])
    Path(snakemake.output.recommendation).write_text(text, encoding="utf-8")
    Path(snakemake.output.which).write_text(which(*found, Plan(files.plan)), encoding="utf-8")
