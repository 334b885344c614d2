"""`curvlib list`: the estimators, or one in full."""

import ast
from shutil import get_terminal_size
from textwrap import fill

import click

from .terminal import json_option, names_of, put_json, table_text

INDENT = {"initial_indent": "  ", "subsequent_indent": " " * 27}


@click.command(short_help="List estimators, peers and surfaces, or tell all of one.")
@click.argument("name", required=False, shell_complete=names_of("estimators", "peers", "surfaces"))
@json_option
def command(name, as_json):
    """List estimators, peers and surfaces, or tell all of one of them.

    NAME may be the path of a .py file with an estimator.
    """
    from curvlib.catalogue import estimators, peers, surfaces
    from curvlib.errors import check_name

    rooms = {"estimators": estimators, "peers": peers, "surfaces": surfaces}
    if name is None:
        told = {
            room: {
                each: " ".join(_docstring(catalogue, each).partition("\n\n")[0].split())
                for each in catalogue.names()
            }
            for room, catalogue in rooms.items()
        }
        if as_json:
            put_json(told)
            return
        width = max(60, min(120, get_terminal_size().columns))
        for room, those in told.items():
            print(f"{room}:")
            for each, words in those.items():
                print(fill(f"{each:<24} {words}", width, **INDENT))
        print("next: curvlib list NAME, or curvlib estimate MESH -e NAME")
        return
    if name in surfaces.names():
        words = _docstring(surfaces, name)
        if as_json:
            put_json({"name": name, "description": words})
        else:
            print(f"{words}\n\nnext: curvlib mesh {name} -n 32 -o {name}.vtp")
        return
    if not estimators.holds(name):
        every = [each for catalogue in rooms.values() for each in catalogue.names()]
        check_name("estimator, peer or surface", name, every)
    from inspect import getdoc

    from curvlib.signatures import Signature, resolved

    signature = Signature.of(*resolved(name))
    described = getdoc(signature.function) or ""
    options = {option: list(values) for option, values in signature.options.items()}
    if as_json:
        parts = {"given": signature.given, "per": signature.per, "options": options}
        put_json({"name": name} | parts | {"description": described})
        return
    print(f"{name} is given: {signature.given}; values per {' or '.join(signature.per)}\n")
    if options:
        rows = [
            (option, str(values[0]), ", ".join(map(str, values[1:])) or "a length")
            for option, values in options.items()
        ]
        print(table_text(("option", "default", "others"), rows))
        print()
    print(described)
    print(f"\nnext: curvlib estimate MESH -e {name}")


def _docstring(catalogue, name):
    """The docstring of a file, which is not imported, since that takes long."""
    text = catalogue.path(name).read_text(encoding="utf-8")
    return ast.get_docstring(ast.parse(text)) or ""
