"""Dry contact: Hertzian ellipses and rough surfaces: kernels and closed forms."""
