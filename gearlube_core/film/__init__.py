"""Film thickness formulas, named by author and year, and their dimensionless groups."""
