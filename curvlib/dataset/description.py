"""What the archive says of itself: the table of its meshes, and texts filled with numbers."""

import hashlib
import json
from pathlib import Path
from string import Template

import numpy as np
import pandas as pd

from .archive import file_hash
from .library import Library, mesh_files


def describe(templates, members: dict, library: Library, labels: dict, **facts) -> dict:
    """The describing members of an archive, member name -> text: meshes.csv and the templates.

    `templates`: files in which $-names stand for `facts` and for what is counted here.
    `members`: name -> path of what the archive holds. `labels`: name in words by surface.
    """
    table = mesh_table(library, labels)
    meshes = table.to_csv(index=False, lineterminator="\n")
    texts = [mesh_files(*key)[-1] for key in library]
    per_surface = table.groupby("surface", sort=False)
    summary = per_surface.agg({"label": "first", "n": "size", "K_min": "min", "K_max": "max"})
    # + 0 makes 0 of -0, which is left of K = -1e-30 on a cone.
    summary[["K_min", "K_max"]] = summary[["K_min", "K_max"]].round(3) + 0
    summary = summary.reset_index().rename(columns={"n": "meshes"})
    facts |= {
        "surfaces": len(labels),
        "meshes": len(table),
        "triangles": f"{table.triangles.sum():,}",
        "megabytes": round(sum(path.stat().st_size for path in members.values()) / 1e6),
        "table": summary.to_markdown(index=False, floatfmt="g"),
        "meshes_bytes": len(meshes.encode()),
        "meshes_hash": hashlib.sha256(meshes.encode()).hexdigest(),
        "texts": ",\n".join(_text_resource(name, members[name]) for name in texts),
    }
    described = {Path(t).name: Template(Path(t).read_text()).substitute(facts) for t in templates}
    return {"meshes.csv": meshes, **described}


def mesh_table(library: Library, labels: dict) -> pd.DataFrame:
    """A row per mesh: sizes, the vertices without K and H, the extremes of both."""
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
    """A text file of the paper's form as a resource of the data package."""
    resource = {
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
    return json.dumps(resource, indent=2)
