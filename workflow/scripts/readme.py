"""Put the answer and the picture of this run into the README, and its words into the CHANGELOG."""

import re
import shutil
from pathlib import Path

from curvlib.study.job import logged

BEGIN, END = "<!-- answer: written by `snakemake readme` -->", "<!-- end of answer -->"

with logged(snakemake.log[0]):
    for document, answer in zip(snakemake.params.documents, snakemake.input.answers):
        path, text = Path(document), Path(answer).read_text(encoding="utf-8")
        pattern = re.compile(f"(?<={BEGIN}\n).*(?={END})", re.DOTALL)
        before = path.read_text(encoding="utf-8")
        after = pattern.sub(lambda _, text=text: f"\n{text}\n", before)
        path.write_text(after, encoding="utf-8")
    shutil.copy(snakemake.input.figure, snakemake.params.figure)
