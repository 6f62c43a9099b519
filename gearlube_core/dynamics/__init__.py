"""Gears in motion: hypoid axle, torsional hypoid pair, helical pair."""
