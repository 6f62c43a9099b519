"""How results are written as text."""
