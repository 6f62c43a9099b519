"""Discrete Reynolds equation of a point contact on one grid."""
