"""Speed sweeps: many operating points of the axle FMU, on one machine or on a cluster."""

from drivetrain.sweep.bookkeeping import Progress
from drivetrain.sweep.merge import load_sweep, summary_table
from drivetrain.sweep.point import run_point
from drivetrain.sweep.runner import SweepInterruptedError, run_sweep
from drivetrain.sweep.settings import SweepSettings, quick_settings

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
