"""Speed sweeps: many operating points of the axle FMU, on one machine or on a cluster."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlube.studies.sweep.merge import load_sweep, summary_table
    from gearlube.studies.sweep.point import run_point
    from gearlube.studies.sweep.progress import Progress
    from gearlube.studies.sweep.report import write_report
    from gearlube.studies.sweep.run import SweepModel, run_sweep
    from gearlube.studies.sweep.settings import SweepSettings, quick_settings

__all__ = [
    "Progress",
    "SweepModel",
    "SweepSettings",
    "load_sweep",
    "quick_settings",
    "run_point",
    "run_sweep",
    "summary_table",
    "write_report",
]

_MODULES = {
    "Progress": "progress",
    "SweepModel": "run",
    "SweepSettings": "settings",
    "load_sweep": "merge",
    "quick_settings": "settings",
    "run_point": "point",
    "run_sweep": "run",
    "summary_table": "merge",
    "write_report": "report",
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used, so that the command line starts fast."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
