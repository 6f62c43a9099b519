"""Flank surfaces of hypoid gears, computed from machine settings."""
