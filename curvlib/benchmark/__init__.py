"""The benchmark: every estimator on every family of meshes and under noise, ranked, with advice."""
