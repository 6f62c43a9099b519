"""Drivetrains as lists: bodies own states, elements act on bodies."""
