"""Docstrings of curvlib as reStructuredText: their formulas are plain text."""

import inspect
import re

from numpydoc.docscrape_sphinx import SphinxDocString

# What numpydoc is told about every docstring that is rendered without autodoc.
OPTIONS = {"show_class_members": False}


def escaped(lines):
    """Lines in which `|x|`, `a*b` and `v_` outside of backticks stand for themselves."""
    return [line if _as_it_is(line) else _escape(line) for line in lines]


def _as_it_is(line):
    # Doctests and the rules of tables and headings.
    return re.match(r"\s*(>>>|\.\.\.? |[-=]{3,}[-= ]*$)", line)


def _escape(line):
    parts = re.split(r"(`+[^`]*`+)", line)
    for k in range(0, len(parts), 2):
        parts[k] = re.sub(r"[|*]|(?<=\w)_(?!\w)", lambda found: "\\" + found[0], parts[k])
    return "".join(parts)


def rendered(text) -> str:
    """The reStructuredText of a docstring by numpydoc."""
    lines = escaped(inspect.cleandoc(text).splitlines())
    return str(SphinxDocString("\n".join(lines), OPTIONS))


def of_module(module) -> str:
    """The docstring of a module, which has no sections; what is indented stands as it is."""
    paragraphs = inspect.cleandoc(module.__doc__).split("\n\n")
    return "\n\n".join(
        f"::\n\n{each}" if each.startswith("    ") else "\n".join(escaped(each.splitlines()))
        for each in paragraphs
    )


def plain(function):
    """The Python function behind one that Numba compiles."""
    return getattr(function, "py_func", function)


def signature(function) -> str:
    """Names and defaults of the parameters, without annotations."""
    found = inspect.signature(plain(function))
    parameters = [p.replace(annotation=p.empty) for p in found.parameters.values()]
    return str(found.replace(parameters=parameters, return_annotation=found.empty))


def paragraph(text, start) -> str:
    """The rest of the paragraph of a docstring that begins with `start`, on one line; or ''."""
    found = re.search(rf"(?:^|\s){re.escape(start)}(.*?)(?:\n\s*\n|\Z)", text, re.S)
    return " ".join(found[1].split()) if found else ""


def setup(app):
    """Escape docstrings before numpydoc reads them."""

    def process(app, what, name, obj, options, lines):
        lines[:] = escaped(lines)

    app.connect("autodoc-process-docstring", process, priority=400)
    return {"parallel_read_safe": True}
