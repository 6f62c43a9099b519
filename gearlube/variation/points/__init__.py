"""Computation of each study at one point of a variation."""
