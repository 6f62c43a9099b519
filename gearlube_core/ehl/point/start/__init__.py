"""Starting values and continuation for point contacts where Newton's method fails directly."""
