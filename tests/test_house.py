"""The house itself: what imports what, what an import costs, what changes a digest."""

import ast
import importlib
import inspect
import re
import subprocess
import sys
from pathlib import Path

import curvlib

PACKAGE = Path(curvlib.__file__).parent

# Each room and the others that it imports: exactly these, so that a door nothing uses goes.
DOORS = {
    "__init__": {"catalogue", "estimators", "peers", "surfaces"},
    "errors": set(),
    "parallel": set(),
    "files": {"errors"},
    "catalogue": {"errors"},
    "columns": {"errors"},
    "regions": set(),
    "kit": {"errors"},
    "estimators": {"kit"},
    "meshes": {"columns", "errors", "files", "kit", "parallel"},
    "peers": {"files", "kit"},
    "libraries": set(),
    "nurbs": {"errors", "kit", "meshes"},
    "implicit": {"catalogue", "meshes"},
    "families": {"catalogue", "implicit", "meshes", "nurbs", "surfaces"},
    "surfaces": {"catalogue", "errors", "nurbs"},
    "causes": {"errors", "meshes"},
    "notebooks": {"columns", "regions"},
    "estimates": {"causes", "columns", "kit", "meshes", "notebooks", "regions"},
    "sides": {"errors", "meshes"},
    "signatures": {"catalogue", "errors", "kit"},
    "task": {"catalogue", "errors", "kit"},
    "passes": {"errors", "kit", "meshes", "parallel", "signatures"},
    "estimation": {
        "causes",
        "errors",
        "estimates",
        "meshes",
        "passes",
        "sides",
        "signatures",
        "task",
    },
    "dataset": {"errors", "files", "meshes", "nurbs"},
    "comparison": {
        "catalogue",
        "errors",
        "estimation",
        "estimators",
        "files",
        "kit",
        "meshes",
        "passes",
        "signatures",
        "surfaces",
    },
    "benchmark": {"catalogue", "comparison", "errors", "estimation", "meshes"},
    "claims": {"comparison"},
    "accessor": {"estimation"},
    "figures": {"comparison", "errors", "files", "meshes", "regions"},
    "study": {"catalogue", "comparison", "errors", "files", "nurbs", "signatures"},
    "conformance": {
        "__version__",
        "catalogue",
        "errors",
        "estimation",
        "kit",
        "meshes",
        "nurbs",
        "parallel",
        "signatures",
        "surfaces",
    },
    "commands": {
        "__version__",
        "catalogue",
        "columns",
        "comparison",
        "conformance",
        "dataset",
        "errors",
        "estimation",
        "figures",
        "files",
        "kit",
        "meshes",
        "parallel",
        "regions",
        "signatures",
    },
}


def imported(path):
    """The rooms of curvlib that a file imports from, its own left out."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            full = ["curvlib", *parts[: len(parts) - node.level]] if node.level else []
            full += (node.module or "").split(".") if node.module else []
            if full[:1] == ["curvlib"]:
                rooms = [full[1]] if full[1:] else [alias.name for alias in node.names]
                yield from (room for room in rooms if room != parts[0])


def test_doors_between_rooms():
    found = {}
    for path in PACKAGE.rglob("*.py"):
        room = path.relative_to(PACKAGE).with_suffix("").parts[0]
        found.setdefault(room, set()).update(imported(path))
    assert found == DOORS


def test_doors_as_contributing_shows_them():
    guide = (PACKAGE.parent / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \| .* \|(.*)\|$", guide, re.M)
    shown = {room: set(re.findall(r"`(\w+)`", others)) for room, others in rows}
    rooms = {room: others - {"__version__"} for room, others in DOORS.items()}
    assert shown == {room: others for room, others in rooms.items() if room != "__init__"}


def test_two_levels_and_rooms_that_open_with_one_docstring():
    for path in PACKAGE.rglob("*.py"):
        assert len(path.relative_to(PACKAGE).parts) <= 2, path
        if path.name == "__init__.py" and path.parent != PACKAGE:
            (docstring,) = ast.parse(path.read_text(encoding="utf-8")).body
            assert isinstance(docstring.value, ast.Constant), path


def public_functions(room):
    """(file, function, its docstring, the module's) of the public functions in a room."""
    for path in (PACKAGE / room).glob("*.py"):
        module = ast.parse(path.read_text(encoding="utf-8"))
        for node in module.body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                yield path, node, ast.get_docstring(node) or "", ast.get_docstring(module) or ""


def test_docstrings_name_every_parameter():
    published = re.findall(r"^`(\w+)`", importlib.import_module("curvlib.kit").__doc__, re.M)
    assert "ring" in published
    for path, function, own, module in [*public_functions("kit"), *public_functions("estimators")]:
        if path.parent.name == "estimators" or path.stem in published:
            for argument in function.args.args:
                shown = re.search(rf"\b{argument.arg}\b", own + module)
                assert shown, f"{path}: {function.name}: {argument.arg}"


def test_estimators_say_where_they_are_defined_their_order_and_their_source():
    for path, function, own, _ in public_functions("estimators"):
        if function.name == "estimate":
            for words in ("Parameters\n---", "Returns\n---", "NaN: needs a", "Order: ", "Source: "):
                assert words in own, f"{path}: {words}"


def test_an_import_brings_nothing_heavy():
    heavy = "numba scipy pandas matplotlib pyvista h5py pooch snakemake"
    code = f"import sys, curvlib; print([m for m in '{heavy}'.split() if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_listings_stay_callable_after_their_packages_are_used():
    curvlib.estimate(curvlib.tessellate(curvlib.surface("cone"), 4), "taubin_a")
    assert "cone" in curvlib.surfaces()
    assert "taubin_a" in curvlib.estimators()
    assert "vtk_curvatures" in curvlib.peers()


def opens_text(call):
    """Whether a call opens a file as text, as far as its source shows."""
    method = isinstance(call.func, ast.Attribute)
    name = call.func.attr if method else getattr(call.func, "id", "")
    if name in ("read_text", "write_text"):
        return method
    strings = [a.value for a in call.args if isinstance(a, ast.Constant)]
    modes = [s for s in strings if isinstance(s, str) and set(s) <= set("rwaxbt+")]
    if name == "NamedTemporaryFile" or (method and name == "open" and call.args):
        return bool(modes) and "b" not in modes[0]
    return name == "open" and not (modes and "b" in modes[0])


def test_text_is_utf_8_whatever_the_locale():
    workflow = PACKAGE.parent / "workflow"
    for path in (*PACKAGE.rglob("*.py"), *workflow.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and opens_text(node):
                named = {keyword.arg for keyword in node.keywords}
                assert "encoding" in named, f"{path}, line {node.lineno}"


def test_type_checkers_see_the_public_names():
    """The stub has those of __all__, and `estimate` with its own parameters."""
    stub = ast.parse((PACKAGE / "__init__.pyi").read_text(encoding="utf-8"))
    named, modules = set(), {}
    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            named.add(node.name)
        elif isinstance(node, ast.ImportFrom) and node.level:
            named |= {alias.asname for alias in node.names}
            modules |= {alias.asname: node.module for alias in node.names}
    assert named == set(curvlib.__all__)
    for name, module in modules.items():
        assert getattr(curvlib, name) is getattr(importlib.import_module(f"curvlib.{module}"), name)
    own = list(inspect.signature(curvlib.estimate).parameters)
    for node in stub.body:
        if isinstance(node, ast.FunctionDef) and node.name == "estimate":
            assert [x.arg for x in (*node.args.args, node.args.kwarg)] == own
