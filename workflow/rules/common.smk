# What all stages share. In: config. Out: `study`, checked; code(), what a result depends on.
import os
import re
import sys
from functools import partial
from pathlib import Path

import yaml

# This checkout's curvlib, here and in the jobs, whatever else is installed.
sys.path.insert(0, HOUSE)

from curvlib.catalogue import estimators, surfaces
from curvlib.errors import InputError
from curvlib.dataset.library import mesh_files
from curvlib.meshes.key import MeshKey
from curvlib.study import captions
from curvlib.study.digest import digest
from curvlib.study.config import Study
from curvlib.study.readings import PAPER_FIGURES, Named, Rows, error_figures, stem_of

# One thread per job: jobs run side by side, and sums come out the same on any machine.
os.environ |= {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "PYTHONPATH": os.pathsep.join([HOUSE, os.environ.get("PYTHONPATH", "")]),
}

# The study of config.yaml, which an overlay may not overwrite.
OWN = yaml.safe_load(Path(HOUSE, "config/config.yaml").read_text(encoding="utf-8"))

try:
    study = Study(config)
    THE_STUDY = study.is_that_of(OWN)
    if not THE_STUDY:
        study.check_places(OWN)
except InputError as error:
    sys.exit(f"error: {error}")

if workflow.is_main_process and not study.library.exists():
    # A folder named on the command line is one that is there: 880 MB are not made for a typing error.
    if "library" in workflow.config_settings.config:
        sys.exit(f"error: config: library: {str(study.library)!r} does not exist")
    print(f"There are no meshes yet; they are made in {study.library}", file=sys.stderr)


def code(script, *files):
    """A job's parameter that changes when the code behind its script or in `files` does."""
    return digest(Path(HOUSE, "workflow", "scripts", f"{script}.py"), *files)


# Files outside the package are known to the rules by their stems.
SURFACES = Named({stem_of(name): name for name in study.surfaces})
ESTIMATORS = Named({stem_of(name): name for name in study.estimators})
# The options that each is run with, by variant.
VARIANTS = Named({stem: study.variants(name) for stem, name in ESTIMATORS.items()})
MODULES = [*map(estimators.path, study.estimators), *map(surfaces.path, study.surfaces)]


# How the study cuts each surface; its meshes, and those on which all readings are run.
CUTS = [(diagonal, n) for diagonal, n, _ in study.meshes()]
MESHES = Rows(MeshKey(surface, *cut) for surface in SURFACES for cut in CUTS)
FULL = Rows(
    MeshKey(surface, diagonal, n)
    for surface in SURFACES
    for diagonal, n, full in study.meshes()
    if full
)
# Those with the paper's resolutions and cut, the first one.
PAPER = Rows(mesh for mesh in FULL if mesh.diagonal == study.diagonals[0])

# The library is an archive, from which the study is then made.
ARCHIVED = study.library.suffix == ".zip"


def files_of(meshes):
    """The files that hold these meshes: the archive, or one each."""
    if ARCHIVED:
        return [study.library]
    return [study.library / mesh_files(*mesh)[0] for mesh in meshes]


def installed_libraries(wildcards):
    """A job's parameter that changes when a library of curvlib/libraries does."""
    from curvlib.conformance.cells import versions

    return versions()


def files_in(folder, name, *kinds):
    """The files of a figure in a folder, one for each kind of file."""
    return [folder / f"{name}.{kind}" for kind in kinds]


def tables_in(folder, *names):
    """The files of tables in a folder of results, by their names with _ for -."""
    return {name.replace("-", "_"): folder / f"tables/{name}.csv" for name in names}


LIBRARY = files_of(MESHES)

FIGURES = study.results / "figures"

# The report is grouped by these.
HOLDS = "1. Does the paper hold?"
ERRORS_FALL = "2. How large are errors?"
WHERE = "3. Where are they?"
MEASURED_ON = "4. Measured on what?"
HOW_FAST = "5. How fast is it?"


def caption(figure):
    """The caption file of a figure: its own or that of its kind, `error-K` for `error-K-cone`."""
    try:
        file = captions.found(figure, f"{HOUSE}/workflow/report")
        captions.read(file)
    except InputError as error:
        sys.exit(f"error: {error}")
    return str(file)


# The labels of surfaces and estimators by the names that tables have for them.
SURFACE_LABELS, ESTIMATOR_LABELS = (
    captions.distinct({name: module.LABEL for name, module in modules.items()})
    for modules in (surfaces.modules(SURFACES), estimators.modules(ESTIMATORS))
)


def reported(file, question, name):
    """A file for the report: under a question, with its caption and what that says it shows."""
    text = caption(name)
    return report(
        file, caption=text, category=question, labels=captions.labels(name, text, SURFACE_LABELS)
    )


# The tables that the report shows, each with a caption `table-<name>`.
TABLED = []


def tabled(table):
    """The file of a table that the report shows as a page."""
    TABLED.append(table)
    return study.results / f"tables/{table}.csv"


def drawn(figures, question, kinds=("svg", "png")):
    """Files of figures, those of the first kind for the report."""
    others = [FIGURES / f"{figure}.{kind}" for kind in kinds[1:] for figure in figures]
    return [reported(FIGURES / f"{f}.{kinds[0]}", question, f) for f in figures] + others


wildcard_constraints:
    surface="|".join(map(re.escape, SURFACES)),
    estimator="|".join(map(re.escape, ESTIMATORS)),
