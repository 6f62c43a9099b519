"""Independent routes to a result, which tests hold the package against."""
