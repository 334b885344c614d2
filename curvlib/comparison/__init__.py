"""Estimates against exact values: norms, runs, trials, other shapes, slopes and ranks, cost."""
