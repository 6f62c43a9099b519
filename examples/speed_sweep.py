"""Sweep vehicle speed and bearing preload from Python: the run of `gearlube sweep --quick`."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from fmu_src.build import build_hypoid_axle
from gearlube.studies.sweep import SweepSettings, quick_settings, run_sweep
from gearlube.studies.sweep.report import write_report


def sweep(out: Path) -> xr.Dataset:
    """Run three speeds and two preloads, write the report into `out`, return all results."""
    fmu, settings = build_hypoid_axle(out), quick_settings(SweepSettings())
    speeds, preloads = [20.0, 60.0, 100.0], [2500.0, 6000.0]
    results = run_sweep(fmu, speeds_kmh=speeds, preloads=preloads, settings=settings, out=out)
    write_report(results, out)
    return results


if __name__ == "__main__":  # the workers import this file, so the run needs the guard
    import webbrowser

    folder = Path("gearlube_sweep")
    folder.mkdir(exist_ok=True)
    sweep(folder)
    webbrowser.open((folder / "report.html").resolve().as_uri())
