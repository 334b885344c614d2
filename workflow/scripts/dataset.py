"""Pack the library and its description into one archive."""

import re
from pathlib import Path

from curvlib.catalogue import surfaces
from curvlib.dataset.archive import write_archive
from curvlib.dataset.description import describe
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    files, params = snakemake.input, snakemake.params
    members = {str(Path(f).relative_to(params.folder)): Path(f) for f in files.files + files.nurbs}
    citation = Path(files.citation).read_text(encoding="utf-8")
    described = describe(
        files.templates,
        members,
        load_library(params.folder).only(params.meshes),
        {name: surfaces.module(file).LABEL for name, file in params.surfaces.items()},
        name=Path(snakemake.output.archive).stem,
        version=params.version,
        released=re.search(r"^date-released: (.*)$", citation, re.M)[1],
    )
    texts = {"LICENSE": Path(files.licence), "requirements.lock": Path(files.versions)}
    write_archive(snakemake.output.archive, members | texts | described)
