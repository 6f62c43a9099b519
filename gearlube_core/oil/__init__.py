"""Lubricants and solids: parameter sets with sources, and their elastic pairing."""
