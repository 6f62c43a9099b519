"""Friction losses of tapered roller bearings: raceways, rib, drag, hysteresis, catalogue laws."""
