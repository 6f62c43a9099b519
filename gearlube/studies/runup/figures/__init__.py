"""Figures of a run-up: functions from its dataset to a matplotlib Figure."""

from gearlube.studies.runup.figures.catalogue import CATALOGUE, Entry, save_runup_figures

__all__ = ["CATALOGUE", "Entry", "save_runup_figures"]
