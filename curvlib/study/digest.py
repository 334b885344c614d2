"""Which code made a result: a digest that a comment or a docstring does not change."""

import ast
import functools
import hashlib
from pathlib import Path

PACKAGE = Path(__file__).parents[1]


def digest(*files) -> str:
    """Hash of the syntax trees of files and of all they import from curvlib, without docstrings."""
    todo, seen = [Path(f).resolve() for f in files], {}
    while todo:
        path = todo.pop()
        if path not in seen:
            seen[path], imports = _parsed(path, path.read_text())
            todo += imports
    return hashlib.sha256("\n".join(sorted(seen.values())).encode()).hexdigest()[:16]


@functools.cache
def _parsed(path, text):
    """The syntax tree of a file, without docstrings, as a string, and what it imports.

    Kept, since nearly every job's digest asks for the same files.
    """
    tree = ast.parse(text)
    imports = tuple(_imports(tree, path))
    return ast.dump(_without_docstrings(tree)), imports


def _imports(tree, path):
    """Files of curvlib that a module imports, by `from . import x` or `from curvlib.x import y`."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom):
            continue
        if node.level:
            base = path.parents[node.level - 1]
            parts = (node.module or "").split(".") if node.module else []
        elif (node.module or "").split(".")[0] == PACKAGE.name:
            base, parts = PACKAGE, node.module.split(".")[1:]
        else:
            continue
        folder = base.joinpath(*parts)
        for alias in node.names:
            for candidate in (folder / f"{alias.name}.py", folder / alias.name / "__init__.py"):
                if candidate.is_file():
                    yield candidate
        for candidate in (folder.with_suffix(".py"), folder / "__init__.py"):
            # Not curvlib/__init__.py, which offers everything and would tie all to all.
            if parts and candidate.is_file():
                yield candidate


def _without_docstrings(tree):
    for node in ast.walk(tree):
        match getattr(node, "body", None):
            case [ast.Expr(value=ast.Constant(value=str())), *_]:
                node.body[0].value.value = ""
    return tree
