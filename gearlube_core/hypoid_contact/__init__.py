"""Loaded tooth contact of a hypoid pair; it writes the mesh table."""
