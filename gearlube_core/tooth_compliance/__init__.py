"""Condensed elastic compliance of one gear tooth on a base block, by finite elements."""
