"""Films in motion: the march of a point contact in time."""
