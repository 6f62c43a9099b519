"""Sweep vehicle speed and bearing preload from Python: the run of `gearlube sweep --quick`."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

import gearlube as gl


def sweep(out: Path) -> xr.Dataset:
    """Run three speeds and two preloads, write the report into `out`, return all results."""
    settings = gl.studies.quick_sweep_settings(gl.SweepSettings())
    speeds, preloads = [20.0, 60.0, 100.0], [2500.0, 6000.0]
    results = gl.run_sweep(settings, speeds_kmh=speeds, preloads=preloads, out=out)
    gl.studies.write_sweep_report(results, out)
    return results


if __name__ == "__main__":  # the workers import this file, so the run needs the guard
    import webbrowser

    folder = Path("gearlube_sweep")
    sweep(folder)
    webbrowser.open((folder / "report.html").resolve().as_uri())
