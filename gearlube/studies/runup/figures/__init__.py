"""Figures of a run-up: functions from its dataset to a matplotlib Figure."""

from gearlube.studies.runup.figures.catalogue import CATALOGUE, Entry

__all__ = ["CATALOGUE", "Entry"]
