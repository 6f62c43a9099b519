"""Study that fits uncertain inputs of an axle to measured losses."""
