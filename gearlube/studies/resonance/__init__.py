"""Resonance of the torsional hypoid pair: response curves, motions, flank contacts as datasets."""
