"""Geometry of helical and spur gear pairs: macro geometry, contact lines, flank modifications."""
