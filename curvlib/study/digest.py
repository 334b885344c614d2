"""Digests of the code behind a result, which comments and docstrings do not change."""

import ast
import functools
import hashlib
from pathlib import Path

PACKAGE = Path(__file__).parents[1]


def digest(*files) -> str:
    """Hash of Python files and of all files that they use.

    For Python: the syntax tree without docstrings, and the modules of curvlib that it imports,
    except under `if TYPE_CHECKING:`. For data, a file below a module's folder that the module
    names in a string: the bytes.
    """
    todo, seen = [Path(f).resolve() for f in files], {}
    while todo:
        path = todo.pop()
        if path not in seen:
            seen[path], used = _read(path, path.read_bytes())
            todo += used
    return hashlib.sha256("\n".join(sorted(seen.values())).encode()).hexdigest()[:16]


@functools.cache
def _read(path, content):
    """The hash of a file, and the files that it uses. Kept: digests of jobs share most files."""
    if path.suffix != ".py":
        return hashlib.sha256(content).hexdigest(), ()
    written, used, todo = [], [], [ast.parse(content)]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.AST):
            written.append(type(node).__name__)
            fields = [getattr(node, name, None) for name in node._fields]
            match node:
                case ast.If(test=ast.Name("TYPE_CHECKING") | ast.Attribute(attr="TYPE_CHECKING")):
                    fields = [node.orelse]
                case ast.Module() | ast.ClassDef() | ast.FunctionDef() | ast.AsyncFunctionDef():
                    fields[node._fields.index("body")] = _without_docstring(node.body)
                case ast.Import() | ast.ImportFrom():
                    used += _imported(node, path)
                case ast.Constant(value=str(name)):
                    used += _data_file(name, path)
            todo += fields
        elif isinstance(node, list):
            written.append(str(len(node)))
            todo += node
        else:
            written.append(repr(node))
    return hashlib.sha256("\n".join(written).encode()).hexdigest(), tuple(used)


def _without_docstring(body):
    match body:
        case [ast.Expr(value=ast.Constant(value=str())), *rest]:
            return rest
    return body


def _imported(node, path):
    """Files of curvlib behind `from . import x`, `from curvlib.x import y`, `import curvlib.x`.

    Without `__init__.py`: a room's is one docstring, and curvlib's would tie every file to all.
    """
    names = [alias.name for alias in node.names]
    if isinstance(node, ast.Import):
        modules = [name.split(".") for name in names]
        found = [PACKAGE.joinpath(*rest) for first, *rest in modules if first == PACKAGE.name]
    else:
        folder, parts = path.parents[max(node.level - 1, 0)], (node.module or "").split(".")
        if not node.level:
            if parts[0] != PACKAGE.name:
                return []
            folder, parts = PACKAGE, parts[1:]
        folder = folder.joinpath(*parts)
        found = [folder, *(folder / name for name in names)]
    return [file for module in found if (file := module.with_suffix(".py")).is_file()]


def _data_file(name, path):
    """The file below a module's folder that a string in the module names, if it names one."""
    if not 0 < len(name) < 256 or not name.isprintable() or name.endswith(".py"):
        return []
    file = path.parent / name
    return [file] if file.is_file() and file.resolve().is_relative_to(path.parent) else []
