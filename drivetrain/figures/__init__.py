"""Figures of a speed sweep: functions from the merged dataset to a matplotlib Figure."""

from drivetrain.figures.catalogue import CATALOGUE, ESSENTIAL, Entry, save_figures
from drivetrain.figures.efficiency import efficiency
from drivetrain.figures.extremes import extremes_against_speed
from drivetrain.figures.film import film_over_mesh_cycle
from drivetrain.figures.operation import operating_points
from drivetrain.figures.order_cuts import order_cuts
from drivetrain.figures.spectrum_map import spectrum_map
from drivetrain.figures.waveforms import roller_zone, waveforms

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
    "spectrum_map",
    "waveforms",
]
