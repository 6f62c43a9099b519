"""Gear pairs as REXS files, read and written; whole gearboxes as train files."""
