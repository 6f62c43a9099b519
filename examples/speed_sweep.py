"""Sweep vehicle speed and bearing preload from Python: the run of `gearlube sweep --quick`."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from gearlube.studies.sweep import SweepSettings, quick_settings, run_sweep, write_report


def sweep(out: Path) -> xr.Dataset:
    """Run three speeds and two preloads, write the report into `out`, return all results."""
    settings = quick_settings(SweepSettings())
    speeds, preloads = [20.0, 60.0, 100.0], [2500.0, 6000.0]
    results = run_sweep(settings, speeds_kmh=speeds, preloads=preloads, out=out)
    write_report(results, out)
    return results


if __name__ == "__main__":  # the workers import this file, so the run needs the guard
    import webbrowser

    folder = Path("gearlube_sweep")
    sweep(folder)
    webbrowser.open((folder / "report.html").resolve().as_uri())
