"""Exact curvature of NURBS surfaces, and their tessellation."""
