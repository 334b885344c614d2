"""Estimates against exact values: norms, runs, trials, slopes and ranks, cost."""
