"""The library of meshes: formats, writing, archive, loading, fetching."""
