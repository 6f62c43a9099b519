"""Dry contact: Hertz, rough surfaces, half-space cells in unilateral contact."""
