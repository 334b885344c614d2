"""Which mesh of a library: the surface, how its cells are cut, and how many they are."""

from collections import namedtuple

MeshKey = namedtuple("MeshKey", "surface diagonal n")
MeshKey.__doc__ = """The mesh of n x n cells of a surface, each cut along a diagonal.

`surface` and `diagonal` are names, `n` is an integer.
"""
