"""Figures of a speed sweep: functions from the merged dataset to a matplotlib Figure."""

from gearlube.studies.sweep.figures.bubbles import spectrum_bubbles
from gearlube.studies.sweep.figures.catalogue import CATALOGUE, ESSENTIAL, Entry, save_figures
from gearlube.studies.sweep.figures.charts import efficiency, extremes_against_speed
from gearlube.studies.sweep.figures.orders import order_cuts
from gearlube.studies.sweep.figures.waveforms import (
    film_over_mesh_cycle,
    operating_points,
    roller_zone,
    waveforms,
)

__all__ = [
    "CATALOGUE",
    "ESSENTIAL",
    "Entry",
    "efficiency",
    "extremes_against_speed",
    "film_over_mesh_cycle",
    "operating_points",
    "order_cuts",
    "roller_zone",
    "save_figures",
    "spectrum_bubbles",
    "waveforms",
]
