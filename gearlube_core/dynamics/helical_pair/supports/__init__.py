"""Bearings and shafts that carry a member."""
