"""Put the answer and the picture of this run into the README."""

import re
import shutil
from pathlib import Path

from curvlib.job import logged

with logged(snakemake.log[0]):
    readme = Path(snakemake.params.readme)
    answer = Path(snakemake.input.answer).read_text()
    begin, end = "<!-- answer: written by `snakemake readme` -->", "<!-- end of answer -->"
    pattern = re.compile(f"(?<={begin}\n).*(?={end})", re.DOTALL)
    readme.write_text(pattern.sub(lambda _: f"\n{answer}\n", readme.read_text()))
    shutil.copy(snakemake.input.figure, snakemake.params.figure)
