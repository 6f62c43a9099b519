"""Hypoid gear blanks: pitch cones, mean point and the fixed frame of the pair."""
