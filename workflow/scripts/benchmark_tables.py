"""Put the errors of the benchmark together: orders, ranks, advice."""

import pandas as pd

from curvlib.benchmark.advice import advice, situations
from curvlib.benchmark.errors import orders
from curvlib.benchmark.methods import methods
from curvlib.benchmark.plan import Plan
from curvlib.benchmark.ranking import ranked
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    files, put = snakemake.input, snakemake.output
    errors = pd.concat(map(pd.read_csv, files.errors), ignore_index=True)
    every = situations(errors)
    tables = {
        "errors": errors,
        "undefined": pd.concat(map(pd.read_csv, files.causes), ignore_index=True),
        "orders": orders(errors),
        "ranking": ranked(errors, ["family", "noise", "place", "quantity"]),
        "situations": every,
        "advice": advice(every, pd.read_csv(files.cost)),
        "methods": methods(Plan(files.plan)),
    }
    for name, table in tables.items():
        table.to_csv(put[name], index=False, lineterminator="\n")
