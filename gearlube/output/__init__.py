"""Results as text files."""
