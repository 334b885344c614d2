"""Every picture, from tables and library files."""
