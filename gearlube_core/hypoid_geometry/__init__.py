"""Hypoid gears: gear files, blanks and the flanks that a machine cuts."""
