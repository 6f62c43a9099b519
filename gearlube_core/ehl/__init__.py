"""Elastohydrodynamic lubrication: dimensionless groups that films, maps and solvers share."""
