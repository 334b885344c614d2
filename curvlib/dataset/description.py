"""The description of an archive: a table of its meshes, and templates filled with its numbers."""

import hashlib
import json
from pathlib import Path
from string import Template

import numpy as np
import pandas as pd

from .archive import file_hash
from .library import Library, mesh_files


def describe(templates, members: dict, library: Library, labels: dict, **facts) -> dict:
    """The members that describe an archive, name -> text: meshes.csv and the filled templates.

    `templates`: files with $-names for `facts` and for the counts made here; .json files are
    filled by `fill`. `members`: name -> path of the archive's other files. `labels`: surface ->
    its label.
    """
    table = mesh_table(library, labels)
    meshes = table.to_csv(index=False, lineterminator="\n")
    texts = [mesh_files(*key)[-1] for key in library]
    facts |= {
        "surfaces": len(labels),
        "meshes": len(table),
        "triangles": f"{table.triangles.sum():,}",
        "megabytes": round(sum(path.stat().st_size for path in members.values()) / 1e6),
        "table": _summary(table),
        "meshes_bytes": len(meshes.encode("utf-8")),
        "meshes_hash": hashlib.sha256(meshes.encode("utf-8")).hexdigest(),
        "texts": [_text_resource(name, members[name]) for name in texts],
    }
    described = {"meshes.csv": meshes}
    for path in map(Path, templates):
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".json":
            document = fill(json.loads(text), facts)
            described[path.name] = json.dumps(document, indent=2, ensure_ascii=False) + "\n"
        else:
            described[path.name] = Template(text).substitute(facts)
    return described


def fill(node, facts: dict):
    """A JSON document with facts in place of $-names.

    A string `$name` alone becomes the fact, a number or a list; a list inside a list is spliced
    into it. In a longer string the fact becomes text.
    """
    if isinstance(node, dict):
        return {key: fill(value, facts) for key, value in node.items()}
    if isinstance(node, list):
        items = []
        for value in node:
            filled = fill(value, facts)
            items += filled if isinstance(value, str) and isinstance(filled, list) else [filled]
        return items
    if not isinstance(node, str):
        return node
    name = node.removeprefix("$")
    return facts[name] if node == f"${name}" and name in facts else Template(node).substitute(facts)


def _summary(table):
    """A Markdown row per surface: its meshes and the extremes of K."""
    table = table.assign(label=table.label.str.replace("|", r"\|"))
    per_surface = table.groupby("surface", sort=False)
    summary = per_surface.agg({"label": "first", "n": "size", "K_min": "min", "K_max": "max"})
    # + 0 turns -0, which K = -1e-30 of a cone is rounded to, into 0.
    summary[["K_min", "K_max"]] = summary[["K_min", "K_max"]].round(3) + 0
    summary = summary.reset_index().rename(columns={"n": "meshes"})
    return summary.to_markdown(index=False, floatfmt="g")


def mesh_table(library: Library, labels: dict) -> pd.DataFrame:
    """A row per mesh: sizes, the number of vertices without K and H, the extremes of both."""
    rows = []
    for (surface, diagonal, n), mesh in library.items():
        row = {
            "surface": surface,
            "label": labels[surface],
            "diagonal": diagonal,
            "n": n,
            "vertices": len(mesh.vertices),
            "triangles": len(mesh.faces),
            "boundary": int(mesh.boundary.sum()),
            "undefined": int(np.isnan(mesh.K).sum()),
        }
        for quantity in ("K", "H"):
            values = getattr(mesh, quantity)
            row |= {f"{quantity}_min": np.nanmin(values), f"{quantity}_max": np.nanmax(values)}
        rows.append(row | {"file": mesh_files(surface, diagonal, n)[0]})
    return pd.DataFrame(rows)


def _text_resource(name, path):
    """A text file in the paper's format as a resource of the data package."""
    return {
        "name": Path(name).stem.lower(),
        "path": name,
        "bytes": path.stat().st_size,
        "hash": f"sha256:{file_hash(path)}",
        "profile": "tabular-data-resource",
        "scheme": "file",
        "format": "csv",
        "mediatype": "text/plain",
        "encoding": "utf-8",
        "dialect": {"header": False, "commentChar": "#", "csv": {"delimiter": " "}},
        "schema": {
            "fields": [{"name": field, "type": "number"} for field in ("x", "y", "z", "K", "H2")],
            "missingValues": ["nan"],
        },
    }
