"""`curvlib info`: a mesh described, what is wrong with it for curvature, and what to do."""

import click

from .terminal import json_option, number, put_json, told_warnings

SHOWN = 5  # places of each fault
# Faults of the file as it stands; the others are of the mesh with its points joined.
OF_VERTICES = ("vertices that stand where another does", "vertices without a triangle")


@click.command()
@click.argument("mesh", metavar="MESH")
@json_option
def command(mesh, as_json):
    """Describe a mesh: what is wrong for curvature, and what to do."""
    import curvlib
    from curvlib.meshes.check import STAIRCASE

    with told_warnings() as warnings:
        read = curvlib.read(mesh)
        found = curvlib.check(read)
        # A soup of triangles is judged as what it becomes once its points are joined.
        joined = curvlib.check(curvlib.weld(read)[0])
    faults = [fault for fault in found.faults if fault.name in OF_VERTICES]
    faults += [fault for fault in joined.faults if fault.name not in OF_VERTICES]
    staircase = found.step >= STAIRCASE
    advice, why = _advice(mesh, faults, staircase)
    if as_json:
        report = joined._asdict() | {"faults": [fault._asdict() for fault in faults]}
        put_json({"mesh": mesh} | report | {"advice": advice, "why": why, "warnings": warnings})
        return
    form = "closed" if joined.closed else f"open, {joined.boundaries} boundary loops"
    genus = "" if joined.genus is None else f", genus {joined.genus}"
    size = joined.high - joined.low
    print(f"{mesh}: {joined.vertices} vertices, {joined.triangles} triangles")
    print(f"  {joined.components} component{'s' * (joined.components != 1)}, {form}{genus}")
    print(f"  extent {' x '.join(map(number, size))}, {_unit(size)}")
    edges = " / ".join(map(number, joined.edges))
    print(f"  edges {edges} (least, quartiles, largest)")
    volume = f", volume {number(joined.volume)}" if joined.closed else ""
    print(f"  area {number(joined.area)}{volume}")
    if staircase:
        print(f"  staircase: coordinates on a lattice, {number(found.step)} edges a step")
    print("wrong for curvature:" if faults else "wrong for curvature: nothing found")
    for fault in faults:
        places = ", ".join(str(place).replace("\n", "") for place in fault.where[:SHOWN].tolist())
        more = ", ..." if fault.count > SHOWN else ""
        print(f"  {fault.count} {fault.name} ({places}{more}): {fault.remedy}")
    print(f"next: {advice}\n  {why}")


def _unit(size):
    """A guess at the unit: files name none."""
    largest = max(size)
    if 20 <= largest <= 2000:
        return "of an object in millimetres, if of one in the hand"
    return "in a unit that the file does not name"


def _advice(mesh, faults, staircase):
    """The command line that comes next, and why."""
    from shlex import quote

    from curvlib.estimation import BECAUSE

    words = f"curvlib estimate {quote(mesh)}"
    turned = any("face inward" in name or "opposite sides" in name for name, *_ in faults)
    if turned:
        words += " --orient"
    why = f"adaptive_fit: {BECAUSE['adaptive_fit']}"
    if staircase:
        why += "; on a staircase, normals averaged over balls that do not see its steps"
    return words + " -o values.vtp", why
