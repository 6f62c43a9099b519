"""Terms of the film equations on one grid: each owns its data and has a null object."""
