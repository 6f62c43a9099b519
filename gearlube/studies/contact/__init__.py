"""Tooth contact analysis of a hypoid pair."""
