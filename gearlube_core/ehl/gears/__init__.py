"""Films on the flanks of helical and hypoid pairs."""
