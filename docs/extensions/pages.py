"""Pages that are written from the package and from results: methods, building blocks, commands.

They lie in docs/generated, which is made anew by each build.
"""

import importlib
import shutil
from pathlib import Path

import click
import numpy as np
from docstrings import escaped, of_module, paragraph, plain, rendered, signature
from reach import HOPS, Place

from curvlib import estimate, kit, surface, tessellate
from curvlib.catalogue import estimators, peers, surfaces
from curvlib.commands.main import VERBS
from curvlib.commands.main import curvlib as program
from curvlib.figures.values import picture
from curvlib.signatures import Signature, resolved

ROOT = Path(__file__).parents[2]
GENERATED = Path(__file__).parents[1] / "generated"
PACKAGE = ROOT / "curvlib"
BENCHMARK = ROOT / "results/benchmark"
# Pages that the benchmark writes, with what they answer.
ANSWERS = {
    "which-estimator": "Which estimator should I use?",
    "is-my-library-right": "Is my library right?",
}
GIVEN = {
    "ring": "the closed ring of triangles around a vertex",
    "disk": "the neighbours over some rings or within a length",
    "ball": "the triangles within a length, cut where they leave it",
    "mesh": "the whole mesh",
    "passes": "the whole mesh, in passes over disks and balls",
}


def put(name, *parts):
    """Write a page of parts with empty lines between them, where it differs from what is there."""
    path = GENERATED / name
    path.parent.mkdir(parents=True, exist_ok=True)
    text = "\n\n".join(parts) + "\n"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def heading(text, line="="):
    """A heading with its underline."""
    return f"{text}\n{line * len(text)}"


def indented(text, by=3):
    """A block, each line moved to the right."""
    return "\n".join(f"{' ' * by}{line}".rstrip() for line in text.splitlines())


def table(rows, widths, head=True):
    """A list-table; its first row is its head, if it has one."""
    lines = [".. list-table::", f"   :widths: {widths}"]
    lines += ["   :header-rows: 1", ""] if head else [""]
    for row in rows:
        lines += [f"   {'* -' if k == 0 else '  -'} {cell}" for k, cell in enumerate(row)]
    return "\n".join(lines)


def prose(text):
    """Text of a docstring, escaped, on one line."""
    return " ".join(escaped([" ".join(text.split())]))


def changes(place, name):
    """`Place.changes`, kept until a file of the estimators or of the kit is newer."""
    kept = GENERATED / f"methods/{name}.npy"
    code = [path for room in ("estimators", "kit") for path in (PACKAGE / room).glob("*.py")]
    if not kept.exists() or kept.stat().st_mtime < max(path.stat().st_mtime for path in code):
        kept.parent.mkdir(parents=True, exist_ok=True)
        np.save(kept, place.changes(name))
    return np.load(kept)


def methods():
    """A page per estimator, and their list."""
    place = Place()
    rows = [("Method", "Given", "Order", "Vertices")]
    for name in estimators.names():
        module = estimators.module(name)
        given = Signature.of(*resolved(name)).given
        text = plain(module.estimate).__doc__
        count = place.draw(GENERATED / f"methods/{name}.png", changes(place, name))
        order = paragraph(text, "Order: ")
        rows.append((f":doc:`{name}`", f"``{given}``", prose(order), str(count)))
        facts = [
            ("Given", f"``{given}``: {GIVEN[given]}"),
            ("Values", "per " + " or ".join(Signature.of(*resolved(name)).per)),
            ("Order", prose(order)),
            ("Source", f"`{module.SOURCE} <{module.SOURCE}>`__"),
            ("Cost", "measured on your machine by ``snakemake throughput``"),
        ]
        alt = (
            f"Irregular triangles around a ringed vertex; the {count} vertices on which the value "
            f"of {name} there depends are filled, darker where it depends more."
        )
        put(
            f"methods/{name}.rst",
            heading(name),
            prose(module.__doc__),
            table(facts, "15 85", head=False),
            f".. figure:: {name}.png\n   :alt: {alt}\n   :width: 320px\n\n   {alt}",
            f".. py:function:: curvlib.estimators.{name}.estimate{signature(module.estimate)}\n"
            f"   :no-index-entry:\n\n{indented(rendered(text))}",
        )
    put(
        "methods/index.rst",
        heading("The methods"),
        "One page per estimator: definition, neighbourhood, options, where it has no value, order "
        "of convergence and source. The column *vertices* counts those on which the value at one "
        f"vertex of an irregular mesh depends, among the {len(place.near)} up to {HOPS} rings "
        "away, by moving each.",
        table(rows, "20 12 58 10"),
        ".. toctree::\n   :hidden:\n\n" + indented("\n".join(estimators.names())),
    )


def peers_and_surfaces():
    """The other two catalogues."""
    for catalogue, title, words in (
        (peers, "Other libraries", "Functions of other libraries as estimators, turned to the "
         "conventions here. Their names are taken by :func:`curvlib.estimate`, where the library "
         "is installed."),
        (surfaces, "Surfaces", "NURBS surfaces by name, for :func:`curvlib.surface`."),
    ):  # fmt: skip
        parts = [heading(title), words]
        for name in catalogue.names():
            parts += [heading(name, "-"), of_module(catalogue.module(name))]
        put(f"{catalogue.folder.name}.rst", *parts)


def building_blocks():
    """The public functions and classes of the rooms that `curvlib.kit` names."""
    names = [line.split("`")[1] for line in kit.__doc__.splitlines() if line.startswith("`")]
    for name in names:
        module = importlib.import_module(f"curvlib.kit.{name}")
        parts = [heading(f"curvlib.kit.{name}"), of_module(module)]
        for each, thing in sorted(vars(module).items()):
            if each.startswith("_") or getattr(plain(thing), "__module__", "") != module.__name__:
                continue
            if not callable(thing) or not plain(thing).__doc__:
                continue
            kind = "class" if isinstance(thing, type) else "function"
            head = f".. py:{kind}:: curvlib.kit.{name}.{each}"
            head += "" if kind == "class" else signature(thing)
            parts.append(f"{head}\n\n{indented(rendered(plain(thing).__doc__))}")
        put(f"kit/{name}.rst", *parts)
    opening, _, closing = kit.__doc__.partition("\n\n`")
    put(
        "kit/index.rst",
        heading("Building blocks of estimators"),
        "\n".join(escaped(opening.splitlines())),
        ".. toctree::\n   :maxdepth: 1\n\n" + indented("\n".join(names)),
        "\n".join(escaped(closing.partition("\n\n")[2].splitlines())),
    )


def commands():
    """The help of each verb as the terminal shows it."""
    parts = [heading("Command line")]
    for verb in (None, *VERBS):
        command = program.get_command(None, verb) if verb else program
        context = click.Context(command, info_name=f"curvlib {verb}" if verb else "curvlib",
                                max_content_width=90, terminal_width=90)  # fmt: skip
        title = f"curvlib {verb}" if verb else "curvlib"
        parts += [
            heading(title, "-"),
            ".. code-block:: text\n\n" + indented(command.get_help(context)),
        ]
    put("commands.rst", *parts)


def front():
    """The picture of the first page, as `curvlib estimate --picture` makes it."""
    mesh = tessellate(surface("teapot_spout_tube"), 64)
    found = estimate(mesh)
    picture(GENERATED / "spout.png", mesh, found.H, "vertex", "H", "y")


def answers():
    """Pages of the benchmark, or how to get them."""
    for name, title in ANSWERS.items():
        made = BENCHMARK / f"{name}.md"
        if made.exists():
            put(f"{name}.md", made.read_text(encoding="utf-8"))
        else:
            put(
                f"{name}.md",
                f"# {title}",
                "This page is computed. `snakemake benchmark conformance` writes it to "
                f"`results/benchmark/{name}.md`; the next `make docs` shows it here.",
            )


def write(app):
    """Everything, before Sphinx looks for sources."""
    shutil.rmtree(GENERATED / "kit", ignore_errors=True)
    front()
    methods()
    peers_and_surfaces()
    building_blocks()
    commands()
    answers()


def setup(app):
    """Write the pages before Sphinx looks for sources."""
    app.setup_extension("docstrings")
    app.connect("builder-inited", write)
    return {"parallel_read_safe": True}
