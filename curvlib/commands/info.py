"""`curvlib info`: a mesh described, what is wrong with it for curvature, and what to do."""

from pathlib import Path

import click

from .terminal import PATH, json_option, number, put_json, told_warnings

SHOWN = 5  # places of each fault
NOISY = 0.005  # in mean edges: from there on, detail may be noise
UNITS = {
    **dict.fromkeys((".glb", ".gltf"), "metres"),
    **dict.fromkeys((".gii", ".pial", ".white", ".smoothwm", ".orig", ".inflated"), "millimetres"),
}
# Faults of the file as it stands; the others are of the mesh with its points joined.
OF_FILE = (
    "vertices that stand where another does",
    "vertices without a triangle",
    "vertices whose position is not finite",
    "triangles that are there again",
)


@click.command()
@click.argument("mesh", metavar="MESH", type=PATH)
@json_option
def command(mesh, as_json):
    """Describe a mesh: what is wrong for curvature, and what to do."""
    import curvlib

    with told_warnings() as warnings:
        read = curvlib.read(mesh)
        found = joined = curvlib.check(read)
        if any(fault.name == OF_FILE[0] for fault in found.faults):
            # A soup of triangles is judged as what it becomes once its points are joined.
            joined = curvlib.check(curvlib.weld(read)[0])
    faults = [fault for fault in found.faults if fault.name in OF_FILE]
    faults += [fault for fault in joined.faults if fault.name not in OF_FILE]
    size = joined.high - joined.low
    unit = _unit(mesh, max(size))
    advice, why = _advice(mesh, faults, joined)
    if as_json:
        report = joined._asdict() | {"faults": [fault._asdict() for fault in faults]}
        told = {"unit": unit, "advice": advice, "why": why, "warnings": warnings}
        put_json({"mesh": mesh} | report | told)
        return
    form = "closed" if joined.closed else f"open, {joined.boundaries} boundary loops"
    genus = "" if joined.genus is None else f", genus {joined.genus}"
    print(f"{mesh}: {joined.vertices} vertices, {joined.triangles} triangles")
    print(f"  {joined.components} component{'s' * (joined.components != 1)}, {form}{genus}")
    print(f"  extent {' x '.join(map(number, size))}, unit: {unit}")
    edges = " / ".join(map(number, joined.edges))
    print(f"  edges {edges} (least, quartiles, largest)")
    volume = f", volume {number(joined.volume)}" if joined.closed else ""
    print(f"  area {number(joined.area)}{volume}")
    print(f"  noise {_noise(joined)}")
    print("wrong for curvature:" if faults else "wrong for curvature: nothing found")
    for fault in faults:
        places = ", ".join(str(place).replace("\n", "") for place in fault.where[:SHOWN].tolist())
        more = ", ..." if fault.count > SHOWN else ""
        print(f"  {fault.name}: {fault.count} ({places}{more})\n    {fault.remedy}")
    print(f"next: {advice}\n  {why}")


def _noise(report):
    """The noise level in words."""
    if report.noise != report.noise:
        return "unknown: too few vertices lie two rings from a boundary or a fault"
    if report.staircase:
        return f"{report.noise:.2g} mean edges, a staircase: the edges are steps of a lattice"
    if report.noise < 1e-7:
        return "none"
    finer = ", or detail finer than the edges" if report.noise >= NOISY else ""
    return f"{report.noise:.1g} mean edges{finer}"


def _unit(path, size):
    """The unit of the format; a guess by the size where files name none."""
    suffix = Path(path).suffix.lower()
    if suffix in UNITS:
        return f"{UNITS[suffix]}, as {suffix} defines it"
    if 20 <= size <= 2000:
        return "not in the file; millimetres, if this is an object to hold"
    if 0.02 <= size <= 2:
        return "not in the file; metres, if this is an object to hold"
    return "not in the file"


def _advice(mesh, faults, report):
    """The command line that comes next, and why."""
    from shlex import quote

    from curvlib.estimation import BECAUSE

    words = f"curvlib estimate {quote(mesh)}"
    if any("face inward" in name or "opposite sides" in name for name, *_ in faults):
        words += " --orient"
    why = f"adaptive_fit: {BECAUSE['adaptive_fit']}"
    if report.staircase:
        why += "; on a staircase, normals averaged over balls that do not see its steps"
    elif report.noise >= NOISY:
        why += "; on noise, fits or balls that average it"
    return words + " -o values.vtp", why
