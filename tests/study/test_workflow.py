"""Snakemake itself, on a copy of the checkout and a small study."""

import html
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from urllib.parse import quote

import pandas as pd
import pytest

from curvlib.claims.cell import NINE
from curvlib.claims.explanations import best

ROOT = Path(__file__).parents[2]
SMALL = """
surfaces: [sphere, teapot_spout]
estimators: [gauss_bonnet, paraboloid]
resolutions: [8, 12]
diagonals: [same]
more: []
vary: []
product: []
library: data/small
results: results/small
"""
FIGURES = {"claim_plots", "error_plots_K", "error_plots_H", "error_maps"}
ERRORS = "results/small/tables/errors.csv"
AGGREGATES = {"explanations", "best_explanation", "accuracy", "shapes", "claims", *FIGURES, "all"}


@pytest.fixture
def study(tmp_path):
    """A copy of what the project tracks, and a function that runs snakemake in it."""
    for name in ("Snakefile", "config", "curvlib", "workflow", "profiles"):
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(source, tmp_path / name)
    (tmp_path / "small.yaml").write_text(SMALL)

    def run(*arguments, ok=True, config="small.yaml", environment=None):
        command = [Path(sys.executable).with_name("snakemake"), *arguments, "--configfile", config]
        path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
        done = subprocess.run(
            command,
            cwd=tmp_path,
            env=os.environ | {"PATH": path} | (environment or {}),
            capture_output=True,
            text=True,
            check=False,
        )
        output = done.stdout + done.stderr
        assert (done.returncode == 0) == ok, output
        return output

    run.folder = tmp_path
    run.write = lambda name, text: (tmp_path / name).write_text(text)
    return run


def rules(output):
    """Rule name -> number of its jobs, from the table that snakemake prints first."""
    return {rule: int(count) for rule, count in re.findall(r"^(\w+) +(\d+)$", output, re.M)}


def contents(folder):
    return {
        str(p.relative_to(folder)): p.read_bytes()
        for part in ("data/small", "results/small/tables", "results/small/figures")
        for p in sorted((folder / part).rglob("*"))
        if p.is_file()
    }


def replace(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def check_report(results):
    """The report's start page has the answer of this run; every figure and table has its caption
    and labels of its own; no parameter is long."""
    report = (results / "report.html").read_text()

    def part(name):
        (found,) = re.findall(rf'<script id="{name}">\s*var \w+ = (.*);$', report, re.M)
        return json.loads(found)

    start, entries, parts = part("workflow-desc"), part("results"), part("categories")
    answer = [
        [cell.strip().replace("^2", "²") for cell in row.strip("|\n").split("|")]
        for row in (results / "tables/answer.md").open(encoding="utf-8")
        if row.startswith("|") and not row.startswith("|:")
    ]
    rows = re.findall("<tr>(.*?)</tr>", start, re.S)
    rows = [re.findall("<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows]
    assert [[html.unescape(cell) for cell in row] for row in rows] == answer
    assert len(rows) == 1 + len(pd.read_csv(results / "tables/claims-summary.csv"))
    for question in parts:
        assert f"showCategory('{quote(question)}')\">{question}</a>" in start

    for question, entry_paths in ((q, paths) for q, of in parts.items() for paths in of.values()):
        shown = [tuple(entries[path]["labels"].values()) for path in entry_paths]
        assert len(set(shown)) == len(shown), question
    for path, entry in entries.items():
        assert len(entry["caption"]) > 80, path
        for name, value in re.findall(
            r"(\w+)=(.*?)(?=, \w+=|$)", entry["job_properties"]["params"]
        ):
            assert len(value) <= 200, (path, name)
    error = entries[f"{Path(*results.parts[-2:])}/figures/error-K-sphere.svg"]
    assert list(error["labels"].values())[1:] == ["Gaussian curvature K", "Sphere"]
    assert "Mean absolute error of the Gaussian curvature K" in error["caption"]
    pages = {
        Path(path).stem for path, entry in entries.items() if entry["mime_type"] == "text/html"
    }
    assert pages >= {"claims", "claims-summary", "readings"}
    script = (ROOT / "workflow/report/report.js").read_text()
    assert report.rstrip().endswith(f"<script>\n{script}</script>\n</body>\n\n</html>")
    assert (ROOT / "workflow/report/report.css").read_text() in report
    assert not re.search('(src|href)="https?:', start)


def test_reruns_what_changed_and_nothing_else(study):
    first = rules(study("--cores", "1"))
    assert first["library"] == first["estimate"] == 2
    one_core = contents(study.folder)
    assert {ERRORS, "data/small/sphere/sphere.same.008.txt"} <= set(one_core)
    assert "Nothing to be done" in study()

    package = study.folder / "curvlib"
    whole = rules(study("--dry-run", "figures", config="config/config.yaml"))
    for folder, new, old in (("estimators", "mine", "watanabe_b"), ("surfaces", "ball", "sphere")):
        shutil.copy(package / folder / f"{old}.py", package / folder / f"{new}.py")
    assert "Nothing to be done" in study(), "a new file is no part of a study that lists its own"
    assert rules(study("--dry-run", "figures", config="config/config.yaml")) == whole

    study("report")
    check_report(study.folder / "results/small")

    estimator = study.folder / "curvlib/estimators/paraboloid.py"
    replace(estimator, "xy * xy, a + c\n", "xy * xy, (a + c)  # H\n")
    replace(estimator, '"""Paraboloid fitting, section 3.1."""', '"""Another docstring."""')
    assert "Nothing to be done" in study(), "a comment is no change"

    replace(estimator, "4 * a * c - xy * xy, ", "5 * a * c - xy * xy, ")
    changed = rules(study("--cores", "2"))
    own = {"estimate": 1, "refine": 1, "trials": 1}
    assert changed == {**own, **dict.fromkeys(AGGREGATES, 1), "total": 3 + len(AGGREGATES)}
    assert contents(study.folder)[ERRORS] != one_core[ERRORS]

    replace(estimator, "5 * a * c - xy * xy, ", "4 * a * c - xy * xy, ")
    study("--cores", "2", "--forceall")
    assert contents(study.folder) == one_core, "other bytes on two cores"

    replace(study.folder / "curvlib/kit/ring.py", "FLAT = 1e-12", "FLAT = 1e-11")
    assert rules(study("--dry-run"))["estimate"] == 2
    assert "library" not in rules(study("--dry-run"))


def test_a_new_file_joins_where_the_config_says_all(study):
    """An estimator and a surface join `all` by lying in their folders, alone or in a list."""
    rest = SMALL[SMALL.index("resolutions") :]
    study.write("all.yaml", f"surfaces: all\nestimators: all\n{rest}")
    before = rules(study("--dry-run", config="all.yaml"))
    estimator = study.folder / "curvlib/estimators/mine.py"
    shutil.copy(estimator.with_name("watanabe_b.py"), estimator)
    replace(estimator, "#009E73", "#123456")
    surface = study.folder / "curvlib/surfaces/tube.py"
    shutil.copy(surface.with_name("cylinder.py"), surface)
    replace(surface, "from ._shapes", "from curvlib.surfaces._shapes")
    shutil.copy(surface, study.folder / "pipe.py")
    study.write("all.yaml", f"surfaces: [all, pipe.py]\nestimators: all\n{rest}")
    after = rules(study("--dry-run", config="all.yaml"))
    assert after["estimate"] == before["estimate"] + 1
    assert after["library"] == before["library"] + 2


def test_an_estimator_and_a_surface_from_elsewhere(study):
    for name, source in (("mine", "estimators/watanabe_b"), ("a pipe+1", "surfaces/cylinder")):
        shutil.copy(study.folder / f"curvlib/{source}.py", study.folder / f"{name}.py")
    text = (study.folder / "mine.py").read_text()
    study.write("mine.py", re.sub("STYLE = .*", "", text))
    replace(study.folder / "a pipe+1.py", "from ._shapes", "from curvlib.surfaces._shapes")
    study.write(
        "small.yaml",
        SMALL.replace("paraboloid", "mine.py, watanabe_b").replace("teapot_spout", "a pipe+1.py"),
    )
    output = study("--cores", "2")
    assert "estimate mine\n" in output
    assert "library a pipe+1\n" in output
    assert re.search("^tables +results/small/tables$", output, re.M), "says where tables are"
    errors = (study.folder / ERRORS).read_text()
    assert "a pipe+1,same,8,128,mine,default,K,mean," in errors


def test_the_survey_is_of_every_file(study):
    """In the folder, though the study names one of them, and of the study; its page shows the
    cost where it was measured."""
    folder = study.folder / "curvlib/estimators"
    for path in folder.glob("[a-z]*.py"):
        if path.stem not in (*NINE, "jet"):
            path.unlink()
    text = (folder / "watanabe_b.py").read_text()
    study.write("mine.py", re.sub("STYLE = .*", "", text))
    study.write("small.yaml", SMALL.replace("paraboloid", "mine.py"))
    both = {"estimator_errors": 1, "estimators": 1, "total": 2}
    assert rules(study("estimators", "--cores", "2")) == both
    assert "Nothing to be done" in study("estimators")
    tables = study.folder / "results/small/tables"
    surveyed = set(pd.read_csv(tables / "estimators.csv").estimator.str.partition("(")[0])
    assert surveyed == {*NINE, "jet", "mine"}
    page = (tables / "estimators.md").read_text(encoding="utf-8")
    assert "| mine | 1 ring |\n" in page

    measured = "method,mesh,vertices,threads,seconds,ratio\nmine,irregular,1000,1,0.0025,3.5\n"
    (tables / "throughput.csv").write_text(measured)
    assert rules(study("estimators", "--cores", "2")) == {"estimators": 1, "total": 1}
    page = (tables / "estimators.md").read_text(encoding="utf-8")
    assert "| mine | 1 ring | 2.5 | 3.5 |\n" in page
    shutil.copy(folder / "watanabe_b.py", folder / "own.py")
    assert rules(study("--dry-run", "estimators")) == both
    assert "estimators" not in rules(study("--dry-run"))


PLAN = """
estimators: [jet, gauss_bonnet]
peers: [vtk_curvatures]
families: [fan]
seed: 1
resolutions: [8]
own_resolutions: {}
noise: {family: jittered, surfaces: [patch], n: 12, kinds: [white], levels: [0.1]}
cost: 16
published_2020: [torus-25-10]
"""


def test_the_benchmark_as_its_file_plans_it(study):
    study.write("plan.yaml", PLAN)
    study.write("small.yaml", f"{SMALL}\nbenchmark: plan.yaml\n")
    done = rules(study("benchmark", "--cores", "2"))
    assert done["benchmark_errors"] == 2
    assert "Nothing to be done" in study("benchmark")
    folder = study.folder / "results/small/benchmark"
    errors = pd.read_csv(folder / "tables/errors.csv")
    assert set(errors.noise) == {"none", "white"}
    assert set(errors.estimator.str.partition("(")[0]) >= {"jet", "gauss_bonnet"}
    text = (folder / "tables/recommendation.md").read_text(encoding="utf-8")
    assert "| CAD tessellations | `gauss_bonnet` |" in text
    assert "# Which estimator" in (folder / "which-estimator.md").read_text(encoding="utf-8")
    study.write("plan.yaml", PLAN.replace("[fan]", "[fans]"))
    assert "did you mean 'fan'" in study("benchmark", ok=False)
    assert "benchmark" not in "".join(
        rules(study("--dry-run", "estimators", config="config/quick.yaml"))
    )


def test_a_fault_in_a_strangers_file_is_one_line(study):
    study.write(
        "mine.py", "LABEL = 'Mine'\n\n\ndef estimate(ring):\n    raise ValueError('not today')\n"
    )
    study.write("small.yaml", SMALL.replace("paraboloid", "mine.py"))
    output = study("results/small/estimates/mine.csv", ok=False)
    (line,) = (line for line in output.splitlines() if "not today" in line)
    log = "results/small/logs/estimate/mine.log"
    assert line == f"error: estimator mine.py, line 5: ValueError: not today (traceback: {log})"
    assert "in for_each" not in output
    assert "Traceback" in (study.folder / log).read_text()


def test_a_study_without_what_the_paper_looked_at(study):
    """None of its seven surfaces, none of its two favourites: everything is made all the same."""
    text = SMALL.replace("[sphere, teapot_spout]", "[cone_apex]")
    text = text.replace("[gauss_bonnet, paraboloid]", "[taubin]")
    study.write("small.yaml", text)
    study()
    figures = {path.stem for path in (study.folder / "results/small/figures").glob("*.png")}
    assert {"figure-1", "claims", "ranks-K", "rings-H"} <= figures
    summary = pd.read_csv(study.folder / "results/small/tables/claims-summary.csv")
    assert set(summary.of) == {1}


def test_a_mistake_is_one_line_before_any_job(study):
    """In the file or on the command line; every kind of mistake is in test_config.py."""
    study.write("small.yaml", "surfaces: [sphre]")
    for arguments, message in (
        ((), "surfaces: unknown surface 'sphre'; did you mean 'sphere'?"),
        (("--config", "results="), "results has to be the path of a folder"),
        (("--config", "surfaces=[sphere]", "resolutions=[8]"), "'8' has to be an integer"),
        (("--config", "surfaces=[sphere]"), "results: the tables of the study of config.yaml"),
    ):
        output = study(*arguments, ok=False)
        (line,) = (line for line in output.splitlines() if line.startswith("error: config: "))
        assert message in line
        assert "Traceback" not in output
        assert not (study.folder / "results").exists()
        assert not (study.folder / "data").exists()


def test_a_library_named_on_the_command_line_is_there(study):
    output = study("--dry-run", "--config", "library=data/smal", ok=False)
    assert "error: config: library: 'data/smal' does not exist" in output
    assert "they are made in data/small" in study("--dry-run")


def test_a_locale_without_utf_8_and_no_home(study):
    """Snakemake itself needs a cache: where there is no home `make` names a folder for it."""
    target = "results/small/estimates/paraboloid.csv"
    ascii_only = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    cache = os.environ.get("XDG_CACHE_HOME", str(Path.home() / ".cache"))
    study(target, environment={**ascii_only, "HOME": "/proc", "XDG_CACHE_HOME": cache})
    assert "Nothing to be done" in study(target)

    command = ["make", "--silent", "--eval", "show: ; @echo $$XDG_CACHE_HOME", "show"]
    bare = {k: v for k, v in os.environ.items() if k != "XDG_CACHE_HOME"}
    for home, named in (("/proc", f"{ROOT}/.venv/cache\n"), (str(study.folder), "\n")):
        environment = bare | {"HOME": home}
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
        assert done.stdout == named


def test_readme_shows_what_the_study_says(study):
    """The whole study, cold: README's table and picture and CHANGELOG's words are its own, and so
    is the article, the same bytes each time; without a value that it quotes there is none."""
    names = ("README.md", "CHANGELOG.md", "paper/readme-figure.svg")
    shutil.copytree(ROOT / "paper", study.folder / "paper")
    shutil.copy(ROOT / "CITATION.cff", study.folder)
    tracked = [study.folder / name for name in names]
    for name, path in zip(names, tracked):
        shutil.copy(ROOT / name, path)
    before = [path.read_bytes() for path in tracked]
    study("readme", "all", config="config/config.yaml")
    assert [path.read_bytes() for path in tracked] == before, "run `snakemake readme` and commit"

    article = study.folder / "results/paper/paper.pdf"
    made = article.read_bytes()
    assert made.startswith(b"%PDF")
    article.unlink()
    study("paper", config="config/config.yaml")
    assert article.read_bytes() == made
    table = study.folder / "results/tables/rings.csv"
    rows = table.read_text().splitlines(keepends=True)
    quoted = "6,regular,K,gauss_bonnet,"
    table.write_text("".join(row for row in rows if not row.startswith(quoted)))
    output = study("paper", config="config/config.yaml", ok=False)
    assert "not in the results of this run: slope on rings 6/regular/K/gauss_bonnet" in output
    assert not article.exists()


def test_truncated_library_file(study):
    study("--cores", "2", "--until", "library")
    path = study.folder / "data/small/sphere/sphere.same.012.vtkhdf"
    path.write_bytes(path.read_bytes()[:3000])
    output = study("--cores", "1", "results/small/estimates/paraboloid.h5", ok=False)
    assert "error: data/small/sphere/sphere.same.012.vtkhdf: cut off or not HDF5" in output
    assert not list(study.folder.glob("results/**/*.h5*"))


def test_a_mesh_changed_by_hand(study):
    study("--cores", "2", "--until", "library")
    path = study.folder / "data/small/sphere/sphere.same.012.vtkhdf"
    made = path.read_bytes()
    path.write_bytes(made + b"x")
    output = study("results/small/estimates/paraboloid.csv", ok=False)
    assert "error: data/small/sphere/sphere.same.012.vtkhdf: changed since it was made" in output
    path.unlink()
    study("results/small/estimates/paraboloid.csv")
    assert path.read_bytes() == made


def test_archive_takes_the_place_of_the_meshes(study, monkeypatch):
    for name in ("CITATION.cff", "LICENSE-data", "requirements.lock"):
        shutil.copy(ROOT / name, study.folder)
    results = study.folder / "results/small"
    first = rules(study("--cores", "1", "dataset"))
    assert first == {"library": 2, "nurbs": 1, "dataset": 1, "total": 4}
    (archive,) = (results / "dataset").glob("*.zip")
    made = archive.read_bytes()
    with monkeypatch.context() as older_machine:
        older_machine.setenv("NPY_DISABLE_CPU_FEATURES", "X86_V3 X86_V4 AVX512_ICL AVX512_SPR")
        study("--cores", "2", "--forceall", "dataset")
    assert archive.read_bytes() == made, "other bytes on two cores without vector instructions"

    assert "library" not in rules(study("figures")), "its meshes are those of the study"
    computed = {k: v for k, v in contents(study.folder).items() if k.startswith("results/")}
    downloaded = shutil.move(archive, study.folder)
    shutil.rmtree(results)
    shutil.rmtree(study.folder / "data")
    study("figures", "--config", f"library={downloaded}")
    assert contents(study.folder) == computed, "or meshes were made"

    study.write("small.yaml", SMALL.replace("teapot_spout", "cone"))
    output = study("figures", "--config", f"library={downloaded}", ok=False)
    assert f"{downloaded}: unknown surface 'cone'; did you mean" in output


NOTHING = """
import numpy as np

LABEL, STYLE = "Nothing", {"color": "#123456", "marker": "x"}


def estimate(mesh):
    nan = np.full(len(mesh.vertices), np.nan)
    return nan, nan
"""


def decided_again(tables):
    """The claims by the lines in results/README.md."""
    (lines,) = re.findall("```python\n(.*?)```", (ROOT / "results/README.md").read_text(), re.S)
    found = {}
    exec(lines.replace("results/tables", str(tables)), found)
    return found["claims"]


def test_an_estimator_without_a_value(study):
    """Tables count what it leaves undefined, figures leave it out, the claims are decided; and
    decided again by the lines in results/README.md they are the same."""
    (study.folder / "nothing.py").write_text(NOTHING)
    small = SMALL.replace("gauss_bonnet, paraboloid", "gauss_bonnet, nothing.py")
    (study.folder / "small.yaml").write_text(small)
    study("figures", "--cores", "2")
    (claims,) = (study.folder / "results").rglob("claims.csv")
    errors = pd.read_csv(claims.with_name("errors.csv"))
    nothing = errors[errors.estimator == "nothing"]
    assert set(nothing.quantity) == {"K", "H"}
    assert set(nothing.vertices) == {0}
    assert nothing.undefined.min() > 0
    assert nothing.value.isna().all()
    other = errors[errors.estimator == "gauss_bonnet"]
    key = ["surface", "diagonal", "n", "reading", "quantity", "norm"]
    both = nothing.merge(other, on=key)
    assert len(both) == len(nothing) == len(other)
    assert (both.undefined_x == both.vertices_y + both.undefined_y).all()
    ranks = pd.read_csv(claims.with_name("ranks.csv"))
    assert set(ranks.estimator) == {"gauss_bonnet"}
    decided = pd.read_csv(claims)
    assert set(decided.holds) == {"undecided"}
    assert decided.evidence.str.startswith("not in this study: ").all()

    assert decided_again(claims.parent).to_csv(index=False) == claims.read_text()


def test_claims_are_decided_again_from_the_tables(study):
    """All nine, with products and single changes: byte for byte the rule's own."""
    small = SMALL.replace("[gauss_bonnet, paraboloid]", "all").replace("8, 12", "8, 12, 16")
    small = small.replace("vary: []", "vary: [area, vertices]")
    small = small.replace("product: []", "product: [dihedral, pairs]")
    (study.folder / "small.yaml").write_text(small)
    study("claims", "--cores", "2")
    (claims,) = (study.folder / "results").rglob("claims.csv")
    decided = decided_again(claims.parent)
    assert decided.to_csv(index=False) == claims.read_text()
    assert {"true", "false"} <= set(decided.holds)
    readings = pd.read_csv(claims.with_name("readings.csv"))
    assert set(readings.kind) == {"named", "single", "product"}
    assert set(readings.reading[readings.kind != "product"]) == set(decided.reading)
    explanations = pd.read_csv(claims.with_name("explanations.csv"))
    assert len(explanations.drop_duplicates(["dihedral", "pairs"])) == 15
    assert ("best-explanation" in set(decided.reading)) == bool(best(explanations))
    tabulated = set(pd.read_csv(claims.with_name("errors.csv")).reading)
    assert tabulated == set(readings.reading[readings.kind != "product"])
