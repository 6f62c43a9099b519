"""Elastohydrodynamic film thickness correlations, named by author and year: kernels."""
