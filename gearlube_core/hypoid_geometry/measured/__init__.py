"""Measured gears: deviations of flanks, pitch, running axis and waves."""
