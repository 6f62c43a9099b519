"""Figures of a resonance study: functions from its datasets to a matplotlib Figure."""

from gearlube.studies.resonance.figures.catalogue import RESONANCE_CATALOGUE, save_resonance_figures

__all__ = ["RESONANCE_CATALOGUE", "save_resonance_figures"]
