"""An axle over a drive cycle: energy lost by source, and the oil temperature from a cold start."""
