"""Variation of any parameter in any study: grids, samples, scatter; results in chunks."""
