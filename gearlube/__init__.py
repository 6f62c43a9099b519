"""Lubricated gear pairs for vehicle co-simulation."""
