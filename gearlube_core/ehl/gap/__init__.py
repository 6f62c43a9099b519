"""Shapes of the gap: ridges, dents, waviness, measured heights."""
