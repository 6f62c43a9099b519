"""Flanks and rollers of the axle in motion, over two mesh periods at one speed of the ramp."""
