"""Scripts behind docs/optimise.md."""
