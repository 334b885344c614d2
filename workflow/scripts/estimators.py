"""Write the survey of estimators as a page."""

from pathlib import Path

import pandas as pd

from curvlib.comparison.survey_page import page
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params = snakemake.params
    cost = next(map(pd.read_csv, params.cost), None)
    text = page(pd.read_csv(snakemake.input[0]), params.estimators, cost)
    Path(snakemake.output[0]).write_text(text, encoding="utf-8")
