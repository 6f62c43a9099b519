"""Derivatives of tooth contact by machine settings and misalignments."""
