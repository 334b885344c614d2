"""The surfaces of the study: one file each, found by listing this folder.

A file holds LABEL (for legends) and build(), which returns a geomdl NURBS surface whose
normal S_u x S_v points outward. Seams and poles are found on it.
"""
