"""Surrogate of solved films for the axle: training set, fit, audit."""
