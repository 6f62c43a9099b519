"""Steady films of point contacts, isothermal and thermal."""
