"""Loaded contact of any gear pair: strips of cells on elastic teeth, over a mesh cycle."""
