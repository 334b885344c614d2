"""Read broken copies of files; a line for each on stdout.

    python broken.py FOLDER SEED COUNT FILE...

It runs in a process of its own, which a reader may end.
"""

import random
import re
import sys
import warnings
from pathlib import Path

import curvlib

NUMBERS = [
    b"0",
    b"-1",
    b"7",
    b"99999999",
    b"4294967296",
    b"9223372036854775808",
    b"1e400",
    b"nan",
    b"x",
]


def broken(data, others, rng):
    """The bytes of a file, spoilt in one of the ways in which files are."""
    data, way = bytearray(data), rng.randrange(8)
    at, other = rng.randrange(len(data)), rng.randrange(len(data))
    if way == 0:  # cut off
        del data[at:]
    elif way in (1, 2):  # bytes flipped, of all or of the header
        for _ in range(rng.choice((1, 3, 30))):
            data[rng.randrange(len(data) if way == 1 else min(len(data), 300))] = rng.randrange(256)
    elif way == 3:
        del data[at : at + rng.randrange(200)]
    elif way == 4:
        data[at:at] = data[other : other + rng.randrange(200)]
    elif way == 5:  # another number in text
        found = list(re.finditer(rb"\d+", data))
        if found:
            place = rng.choice(found)
            data[place.start() : place.end()] = rng.choice(NUMBERS)
    elif way == 6:  # another number in bytes
        data[at : at + 4] = rng.choice((b"\xff" * 4, b"\0" * 4, b"\xff\xff\xff\x7f"))
    else:  # another format under the suffix
        data = bytearray(rng.choice(others))
    return bytes(data)


def main(folder, seed, count, *files):
    rng = random.Random(int(seed))
    contents = [Path(file).read_bytes() for file in files]
    for number in range(int(count)):
        file = Path(files[number % len(files)])
        path = Path(folder, f"broken{number}{file.suffix}")
        path.write_bytes(broken(contents[number % len(files)], contents, rng))
        print(path, end=" ", flush=True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                mesh = curvlib.read(path)
                curvlib.check(mesh)
                fate = "mesh"
            except curvlib.InputError as error:
                one = "\n" not in str(error) and str(path) in str(error)
                fate = "error" if one else f"no error of one line that names the file: {error}"
        print(fate, flush=True)
        path.unlink()


if __name__ == "__main__":
    main(*sys.argv[1:])
