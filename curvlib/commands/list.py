"""`curvlib list`: the estimators, or one in full."""

import ast

import click

from .terminal import json_option, put_json, table_text


@click.command()
@click.argument("name", required=False)
@json_option
def command(name, as_json):
    """List estimators, peers and surfaces, or tell all of one estimator."""
    from curvlib.catalogue import estimators, peers, surfaces

    if name is None:
        rooms = {"estimators": estimators, "peers": peers, "surfaces": surfaces}
        told = {
            room: {each: _head(catalogue, each) for each in catalogue.names()}
            for room, catalogue in rooms.items()
        }
        if as_json:
            put_json(told)
            return
        for room, those in told.items():
            print(f"{room}:")
            for each, words in those.items():
                print(f"  {each:<24} {words}")
        print("next: curvlib list NAME, or curvlib estimate MESH -e NAME")
        return
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


def _head(catalogue, name):
    """The first line of a file's docstring; the file is not imported, since that takes long."""
    text = catalogue.path(name).read_text(encoding="utf-8")
    return (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]
