"""Speed sweeps: many operating points of the axle FMU, on one machine or on a cluster."""

from gearlube.studies.sweep.bookkeeping import Progress
from gearlube.studies.sweep.merge import load_sweep, summary_table
from gearlube.studies.sweep.point import run_point
from gearlube.studies.sweep.runner import SweepInterruptedError, run_sweep
from gearlube.studies.sweep.settings import SweepSettings, quick_settings

__all__ = [
    "Progress",
    "SweepInterruptedError",
    "SweepSettings",
    "load_sweep",
    "quick_settings",
    "run_point",
    "run_sweep",
    "summary_table",
]
