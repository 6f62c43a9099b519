"""Elastic compliance of gear teeth by finite elements."""
