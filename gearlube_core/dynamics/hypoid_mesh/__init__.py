"""Mesh of a hypoid pinion and its gear in motion: numbers, force, and lubricated flanks."""
