"""Gear pairs as REXS files: what they hold of a pair, read and written."""
