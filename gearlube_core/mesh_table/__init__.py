"""Mesh data against angle and load: written by contact analysis, read by dynamics."""
