"""Mesh data against angle and load: what contact analysis writes and dynamics reads."""
