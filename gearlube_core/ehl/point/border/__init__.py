"""Oil that goes on beyond the domain of a point contact."""
