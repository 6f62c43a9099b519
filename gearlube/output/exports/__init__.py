"""Results of any study as files for other tools."""
