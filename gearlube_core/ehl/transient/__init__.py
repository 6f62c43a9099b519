"""Transient films: time integration of point contacts."""
