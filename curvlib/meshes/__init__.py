"""Triangle meshes: validation, and who is around a vertex."""
