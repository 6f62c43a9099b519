"""Lubricated contacts as labelled datasets and summaries."""
