"""Style of all figures."""
