"""Ways to the film of a point contact where Newton's method fails directly."""
