"""Gear dynamics: hypoid axle, torsional hypoid pair, helical pair, trains of elements."""
