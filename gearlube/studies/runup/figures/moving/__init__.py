"""Flanks and rollers in motion: pictures for a GIF, charts for the report, sentences."""
