"""Figures, from tables and library files."""
