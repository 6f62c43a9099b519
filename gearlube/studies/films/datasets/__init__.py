"""Lubricated contacts as labelled datasets."""
