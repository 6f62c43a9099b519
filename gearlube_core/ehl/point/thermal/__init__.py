"""Heat in the film and the bodies of a point contact."""
