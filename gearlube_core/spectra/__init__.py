"""Spectra and order cuts of signals sampled at equal pinion angles."""
