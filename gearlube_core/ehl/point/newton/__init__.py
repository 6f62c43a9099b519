"""Newton steps of a point contact, preconditioned by multigrid."""
