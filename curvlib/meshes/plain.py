"""Meshes from the bytes of OBJ, OFF and STL files."""

import re

import numpy as np

from curvlib.errors import InputError

# Of a binary STL file: 80 bytes of text and the number of triangles, then each triangle.
HEAD = 84
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
# Texture coordinates, colours and normals of points; 4 or n: points of another space.
OFF = re.compile(rb"(ST)?C?(?P<normals>N)?(?P<other>4?n?)OFF")
NAMES = {int: "index", float: "number"}


def read_obj(data):
    """Vertices (V, 3), triangles (F, 3) and normals (V, 3) or None, from an OBJ file.

    Vertices in the order of the file, whatever textures and normals their corners have; the normal
    of a vertex is the sum of those at its corners.
    """
    data = data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
    points, normals, corners, sizes, seen = [], [], [], [], []
    for line in data.splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == b"v":
            points.append(words[1:4])
        elif words[0] == b"vn":
            normals.append(words[1:4])
        elif words[0] == b"f":
            corners += [word.split(b"/") for word in words[1:]]
            sizes.append(len(words) - 1)
            seen.append((len(points), len(normals)))
    vertices, sizes = numbers(points, 3, "v"), np.array(sizes, int)
    seen = np.repeat(np.array(seen, int).reshape(-1, 2), sizes, axis=0)
    at = _from_one([corner[0] for corner in corners], seen[:, 0], len(vertices))
    if not normals or not all(len(corner) == 3 and corner[2] for corner in corners):
        return vertices, fans(sizes, at), None
    own = _from_one([corner[2] for corner in corners], seen[:, 1], len(normals))
    directions, sums = numbers(normals, 3, "vn")[own], np.zeros_like(vertices)
    for component, column in zip(directions.T, sums.T):
        column[:] = np.bincount(at, component, len(vertices))
    return vertices, fans(sizes, at), sums


def _from_one(words, seen, count):
    """Indices that count from 1, or back from the `seen` ones before if negative, as from 0."""
    found = values(words, int)
    found = np.where(found < 0, seen + found, found - 1)
    wrong = (found < 0) | (found >= count)
    if wrong.any():
        word = words[int(np.argmax(wrong))].decode()
        raise InputError(f"a face names {word}, but indices run from 1 to {count}")
    return found


def read_off(data):
    """Vertices (V, 3), triangles (F, 3) and normals (V, 3) or None, from an OFF file."""
    lines = [words for words in (x.partition(b"#")[0].split() for x in data.splitlines()) if words]
    kind = OFF.match(lines[0][0]) if lines else None
    if not kind or kind["other"] or b"BINARY" in lines[0]:
        raise InputError("it is no OFF file of text and of points in space")
    rest = lines[0][0][kind.end() :]  # the first number, with no space between
    lines[0] = [rest, *lines[0][1:]] if rest else lines[0][1:]
    lines = lines if lines[0] else lines[1:]
    counts = values(lines[0][:2], int) if lines else np.zeros(0, int)
    if len(counts) < 2 or counts.min() < 0:
        raise InputError("the numbers of its vertices and faces are missing")
    points, faces = lines[1 : counts[0] + 1], lines[counts[0] + 1 : counts.sum() + 1]
    if len(points) + len(faces) < counts.sum():
        raise InputError(
            f"it is cut off: {len(lines) - 1} lines for {counts[0]} vertices and {counts[1]} faces"
        )
    width = 6 if kind["normals"] else 3
    table = numbers([words[:width] for words in points], width, "vertex")
    sizes = values([words[0] for words in faces], int)
    for size, words in zip(sizes, faces):
        if not 0 <= size < len(words):
            raise InputError(f"a face is {_told(words)}, which is no number and so many vertices")
    at = values([word for size, words in zip(sizes, faces) for word in words[1 : size + 1]], int)
    return table[:, :3], fans(sizes, at), table[:, 3:] if kind["normals"] else None


def read_stl(data):
    """Vertices (3 F, 3), those of each triangle after another, triangles (F, 3) and None."""
    named = int.from_bytes(data[HEAD - 4 : HEAD], "little")
    there, rest = divmod(max(len(data) - HEAD, 0), TRIANGLE.itemsize)
    # The text of a binary file, too, may begin with the word solid.
    if data.lstrip()[:5].lower() != b"solid" or (named == there > 0 and not rest):
        if len(data) < HEAD or named > there:
            raise InputError(f"it is cut off: {there} triangles, of {named}")
        corners = np.frombuffer(data, TRIANGLE, named, HEAD)["corners"].reshape(-1, 3)
    else:
        rows = [words for words in map(bytes.split, data.lower().splitlines()) if words]
        rows = [words[1:4] for words in rows if words[0] == b"vertex"]
        corners = numbers(rows, 3, "vertex")
        if len(rows) % 3:
            raise InputError(f"it is cut off: {len(rows)} corners make no whole triangles")
    return corners, np.arange(len(corners)).reshape(-1, 3), None


def fans(sizes, corners):
    """Triangles (F, 3) of polygons, each divided at its first corner; none of fewer than three.

    Parameters
    ----------
    sizes : (n,) int
        How many corners each polygon has.
    corners : (sum of sizes,) int
    """
    counts = np.maximum(sizes - 2, 0)
    first = np.repeat(np.cumsum(sizes) - sizes, counts)
    step = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return corners[np.column_stack((first, first + step + 1, first + step + 2))]


def numbers(rows, width, what):
    """(n, width) float64 of rows of words; InputError tells the first that is not so many numbers.

    `what` names a row.
    """
    try:
        table = np.array(rows, dtype=float).reshape(len(rows), width if not rows else -1)
    except (ValueError, OverflowError):
        table = None
    if table is not None and table.shape[1] in (width, 0):
        return table.reshape(-1, width)
    for row in rows:
        try:
            if len([float(word) for word in row]) == width:
                continue
        except ValueError:
            pass
        raise InputError(f"{what} {_told(row)} is not {width} numbers")


def values(words, kind):
    """(n,) float64 or int64 of words; InputError tells the first that is none."""
    try:
        return np.array(words, dtype=kind)
    except (ValueError, OverflowError):
        pass
    for word in words:
        try:
            np.array([word], dtype=kind)
        except (ValueError, OverflowError):
            raise InputError(f"{_told([word])} is no {NAMES[kind]}") from None


def _told(words):
    return repr(b" ".join(words)[:40].decode("ascii", "replace"))
