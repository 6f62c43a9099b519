"""Put numbers into docs/validation.md, draw the README's pictures: python -m docs.validation.make.

Runs four sweeps with the FMU (about three minutes on two cores; finished points are kept in the
folder given as argument, by default build/validation) and reads the claims off them.
"""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from docs.page import IMAGES, Page, begin
from docs.validation import efficiency
from docs.validation.claims import CLAIMS
from fmu_src.build import build_hypoid_axle
from gearlube.studies.sweep.report import write_sweep_report
from gearlube.studies.sweep.run import run_sweep
from gearlube.studies.sweep.settings import SweepSettings

PRELOADS = [2500.0, 6000.0]
OF_EFFICIENCY = ("43", "44", "45")  # statements
PICTURES = ("dte_map", "efficiency")


def sweep(fmu: Path, folder: Path, speeds: list[float], settings: SweepSettings) -> xr.Dataset:
    """Run or resume one sweep and return its merged results."""
    results = run_sweep(settings, speeds_kmh=speeds, preloads=PRELOADS, fmu=fmu, out=folder)
    failed = int((results["status"] != 1).sum())
    if failed:
        raise SystemExit(f"{failed} points failed in {folder}; see its summary.csv")
    return results


def judged(data: tuple[xr.Dataset, xr.Dataset, xr.Dataset]) -> dict[str, list[str]]:
    """Return what consistent, printed and printed-traction sweeps give, by statement."""
    rows = {}
    for name, claim in CLAIMS.items():
        found = [claim(one) for one in data[: 3 if name in OF_EFFICIENCY else 2]]
        rows[name] = [cell for one in found for cell in (one.value, f"**{one.verdict}**")]
    return rows


def balances(data: xr.Dataset) -> list[list[str]]:
    """Return what the default sweep, coupled to the driveline, shows of itself."""
    asked = data["speed"].values[None, :]
    deviation = np.max(np.abs(data["vehicle_speed"].values / asked - 1.0))
    closure = np.max(np.abs(data["energy_closure_error"].values))
    torque_balance = (
        data["pinion_torque"] * data["pinion_frequency"]
        - data["wheel_torque"] * data["wheel_frequency"]
    ) * 2.0 * np.pi - data["loss"].sum("source")
    relative = float(np.max(np.abs(torque_balance / data["power_in"])))
    return [[f"{100 * deviation:.3f} %"], [f"{closure:.1e}"], [f"{relative:.1e}"]]


def main(work: Path) -> None:
    """Run the sweeps, write the page and the pictures."""
    fmu = build_hypoid_axle(work)
    hold = SweepSettings(driver="hold")
    as_printed = replace(hold, equations="as_printed", friction="as_printed")
    of_circle = replace(hold, friction="printed_traction_circular", bearing_torque_loss="none")
    speeds = [float(v) for v in range(20, 101, 5)]
    consistent = sweep(fmu, work / "consistent", speeds, hold)
    printed = sweep(fmu, work / "as_printed", speeds, as_printed)
    traction = sweep(fmu, work / "traction", speeds, of_circle)
    coupled = sweep(fmu, work / "default", speeds, SweepSettings())
    page = Page("validation")
    page.claims(judged((consistent, printed, traction)), "## Statements of the paper")
    efficiency.fill(page)
    page.cells("Default sweep, 34 points", balances(coupled), first=1)
    page.write()
    write_sweep_report(coupled, work / "default")
    for name in PICTURES:
        shutil.copyfile(work / "default" / "figures" / f"{name}.png", IMAGES / f"{name}.png")
    write_sweep_report(printed, work / "as_printed")
    shutil.copyfile(work / "as_printed" / "figures" / "dte_map.png", IMAGES / "dte_map_printed.png")


if __name__ == "__main__":
    main(begin("validation"))
