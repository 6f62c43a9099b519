"""Elements of a train, a file for each."""
