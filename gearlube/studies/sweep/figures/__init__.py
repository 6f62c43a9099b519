"""Figures of a speed sweep: functions from the merged dataset to a matplotlib Figure."""

from gearlube.studies.sweep.figures.catalogue import CATALOGUE, ESSENTIAL, Entry

__all__ = ["CATALOGUE", "ESSENTIAL", "Entry"]
