"""Make a page of each table that the report shows, and the answer of its start page."""

from pathlib import Path

from curvlib.study import captions, report
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, output = snakemake.input, snakemake.output
    template = Path(inputs.template).read_text(encoding="utf-8")
    words = snakemake.params.names, report.sentences(inputs.summary)
    for table, caption, page in zip(inputs.tables, inputs.captions, output.pages):
        text = report.page(template, table, captions.read(caption), *words)
        Path(page).write_text(text, encoding="utf-8")
    answer = report.answer(Path(inputs.answer).read_text(encoding="utf-8"))
    Path(output.answer).write_text(answer, encoding="utf-8")
