"""Meshes from the bytes of PLY files: a header of elements and their properties, then the values,
as text or as bytes."""

import re
from collections import namedtuple

import numpy as np

from curvlib.errors import InputError, check_name

from .plain import fans, values

ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
TYPES = {
    **dict(char="i1", uchar="u1", short="i2", ushort="u2", int="i4", uint="u4"),
    **dict(int8="i1", uint8="u1", int16="i2", uint16="u2", int32="i4", uint32="u4"),
    **dict(float="f4", float32="f4", double="f8", float64="f8"),
}
CORNERS = ("vertex_indices", "vertex_index")

# A type of NumPy; `sizes` is that of the number before the values of a list, else None.
Property = namedtuple("Property", "name type sizes")
Element = namedtuple("Element", "name rows properties")


def read_ply(data):
    """Vertices (V, 3), triangles (F, 3) and normals (V, 3) or None, from a PLY file."""
    elements, data = _header(data)
    found, at = {}, 0
    for element in elements:
        found[element.name], at = _values(element, data, at)
    vertex, face = found.get("vertex", {}), found.get("face", {})
    if not {"x", "y", "z"} <= set(vertex):
        raise InputError("it has no vertices of x, y and z")
    points = np.column_stack([vertex[x] for x in "xyz"])
    lists = [face[name] for name in CORNERS if name in face]
    corners = fans(*lists[0]) if lists else np.zeros((0, 3), int)
    strips = [found.get("tristrips", {}).get(name) for name in CORNERS]
    corners = np.vstack((corners, *(_of_strips(*x) for x in strips if x)))
    if corners.dtype.kind == "f":
        if not (corners == np.floor(corners)).all():
            raise InputError("a face names what is no index")
        corners = corners.astype(np.int64)
    if not {"nx", "ny", "nz"} <= set(vertex):
        return points, corners, None
    return points, corners, np.column_stack([vertex[x] for x in ("nx", "ny", "nz")])


def _of_strips(sizes, corners):
    """Triangles (F, 3) of strips: each corner from the third on with the two before it.

    A strip ends with its list or with -1.
    """
    corners = np.insert(corners, np.cumsum(sizes), -1)
    start = np.where(np.append(True, corners[:-1] < 0), np.arange(len(corners)), 0)
    odd = (np.arange(len(corners)) - np.maximum.accumulate(start))[:-2] % 2 == 1
    faces = np.column_stack((corners[:-2], corners[1:-1], corners[2:]))
    faces[odd, :2] = faces[odd, 1::-1]
    return faces[(faces >= 0).all(1)]


def _header(data):
    """The elements of the header, and the bytes behind it; text becomes bytes of float64."""
    end = re.search(rb"^end_header[ \t]*(\r\n|\n|\r)", data, re.MULTILINE)
    if not data.startswith(b"ply") or not end:
        raise InputError("it is no PLY file: its header is missing or cut off")
    order, elements = None, []
    for line in data[: end.start()].decode("latin-1").splitlines()[1:]:
        match line.split():
            case ["format", name, *_]:
                check_name("format", name, ORDERS, "PLY")
                order = ORDERS[name]
            case ["element", name, rows] if rows.isdecimal():
                elements.append(Element(name, int(rows), []))
            case ["property", "list", sizes, kind, name] if elements:
                types = _type(sizes, order), _type(kind, order)
                elements[-1].properties.append(Property(name, types[1], types[0]))
            case ["property", kind, name] if elements:
                elements[-1].properties.append(Property(name, _type(kind, order), None))
            case [] | ["comment" | "obj_info", *_]:
                pass
            case _:
                raise InputError(f"{line[:40]!r} cannot stand in the header of a PLY file")
    body = data[end.end() :]
    if order == "":
        body = values(body.split(), float).tobytes()
    return elements, body


def _type(name, order):
    check_name("type", name, TYPES, "PLY")
    if order is None:
        raise InputError("the format is missing in its header")
    return np.dtype(order + TYPES[name]) if order else np.dtype(float)


def _values(element, data, at):
    """name -> values (rows,), or the sizes (rows,) and values of a list; and where they end."""
    try:
        same, end = _of_one_size(element, data, at)
        return (same, end) if same is not None else _of_any_size(element, data, at)
    except ValueError:  # of frombuffer
        raise InputError(
            f"it is cut off: {element.rows} of {element.name} are not all there"
        ) from None


def _of_one_size(element, data, at):
    """As `_values`, if each list has as many values in all rows; else None."""
    first, _ = _row(element.properties, data, at) if element.rows else ({}, at)
    fields = []
    for name, type_, sizes in element.properties:
        if sizes is None:
            fields.append((name, type_))
        else:
            fields += [(f"{name} size", sizes), (name, type_, (len(first.get(name, ())),))]
    row = np.dtype(fields)
    end = at + element.rows * row.itemsize
    if end > len(data):
        return None, at
    table = np.frombuffer(data[at:end], row) if row.itemsize else np.zeros(element.rows, row)
    found = {}
    for name, _, sizes in element.properties:
        if sizes is None:
            found[name] = table[name]
        else:
            own = table[f"{name} size"]
            if len(own) and (own != own[0]).any():
                return None, at
            found[name] = own.astype(int), table[name].reshape(-1)
    return found, end


def _of_any_size(element, data, at):
    rows = []
    for _ in range(element.rows):
        row, at = _row(element.properties, data, at)
        rows.append(row)
    found = {}
    for name, _, sizes in element.properties:
        column = [row[name] for row in rows]
        if sizes is None:
            found[name] = np.array(column)
        else:
            found[name] = np.array([len(x) for x in column]), np.concatenate(column)
    return found, at


def _row(properties, data, at):
    """name -> value, or the values of a list, of one row; and where it ends."""
    row = {}
    for name, type_, sizes in properties:
        count = 1
        if sizes is not None:
            (size,) = np.frombuffer(data, sizes, 1, at)
            count, at = int(size) if size >= 0 else len(data), at + sizes.itemsize
        values = np.frombuffer(data, type_, count, at) if count else np.empty(0, type_)
        row[name], at = values[0] if sizes is None else values, at + count * type_.itemsize
    return row, at
