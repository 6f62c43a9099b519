"""Traces that other packages hold: WLTC of `wltp`, FTP-75 of `fastsim`."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

_KMH = 1.0 / 3.6
_COLD_PHASE = 505  # s, that a hot start repeats
WLTC_SUM = 83758.6  # km/h, of all 1801 speeds of class 3b
FTP75_DISTANCE = 17_769.0  # m


def wltc() -> tuple[Array, Array]:
    """Return time [s] and speed [m/s] of the WLTC of class 3b [unece_2014], from `wltp`.

    Raises
    ------
    ParameterError
        The package is missing, or its trace is not the one of the regulation.
    """
    module = _package("wltp.cycles.class3", "wltc")
    kmh = np.array(_read("wltp", lambda: module.class_data_b()["cycle"]), dtype=float)
    total = float(kmh.sum())
    if kmh.size != 1801 or abs(total - WLTC_SUM) > 0.05:
        raise _wrong("wltp", f"{kmh.size} speeds with sum {total:.1f} km/h", f"1801, {WLTC_SUM}")
    return np.arange(1801.0), kmh * _KMH


def ftp75() -> tuple[Array, Array]:
    """Return time [s] and speed [m/s] of FTP-75 [epa_2014], from the UDDS of `fastsim`.

    Notes
    -----
    The UDDS, then its first 505 s again. The soak of 10 min between them is left out.

    Raises
    ------
    ParameterError
        The package is missing, or its trace is not the one of the regulation.
    """
    module = _package("fastsim", "ftp75")
    held = _read("fastsim", lambda: module.Cycle.from_resource("udds.csv").to_dict())
    time = np.array(_read("fastsim", lambda: held["time_seconds"]), dtype=float)
    speed = np.array(_read("fastsim", lambda: held["speed_meters_per_second"]), dtype=float)
    if not np.array_equal(time, np.arange(1370.0)) or speed.size != time.size:
        raise _wrong("fastsim", f"{time.size} speeds", "1370, one each second")
    whole = np.concatenate([speed, speed[1 : _COLD_PHASE + 1]])
    seconds = np.arange(float(whole.size))
    distance = float(np.trapezoid(whole, seconds))
    if abs(distance - FTP75_DISTANCE) > 5.0:
        raise _wrong("fastsim", f"{distance:.0f} m", f"{FTP75_DISTANCE:.0f} m")
    return seconds, whole


def _package(module: str, cycle: str) -> Any:
    package = module.split(".")[0]
    try:
        return import_module(module)
    except ImportError:
        raise ParameterError(
            f"The cycle {cycle} is read from the package {package}, which is not installed. "
            f"Install it: pip install 'gearlube[cycles]'. Or give the trace as a CSV file with "
            "the columns time_s and speed_kmh, or take nedc, which needs no package."
        ) from None


def _read(package: str, held: Callable[[], Any]) -> Any:
    try:
        return held()
    except (AttributeError, KeyError, TypeError, OSError) as reason:
        raise ParameterError(
            f"The package {package} does not hold its trace where it should: {reason!r}. Install "
            "the version that gearlube asks for: pip install 'gearlube[cycles]'."
        ) from None


def _wrong(package: str, got: str, limit: str) -> ParameterError:
    return ParameterError(
        f"The trace of the package {package} must have {limit}; got {got}. Install the version "
        "that gearlube asks for: pip install 'gearlube[cycles]', or give a CSV file."
    )
