"""Hypoid gears: gear files, blanks and cut flanks."""
