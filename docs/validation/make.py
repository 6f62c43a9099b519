"""Rewrite docs/validation.md and the pictures of the README: python -m docs.validation.make.

Runs four sweeps with the FMU (about three minutes on two cores; finished points are kept in the
folder given as argument, by default build/validation) and reads the claims off them.
"""

from __future__ import annotations

import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from docs.validation.claims import CLAIMS, Claim
from docs.validation.rejudge import axle_section
from fmu_src.build import build_hypoid_axle
from gearlube.studies.sweep.report import write_sweep_report
from gearlube.studies.sweep.run import run_sweep
from gearlube.studies.sweep.settings import SweepSettings

ROOT = Path(__file__).resolve().parents[2]
TEXTS = Path(__file__).parent / "text"
PRELOADS = [2500.0, 6000.0]
OF_EFFICIENCY = (43, 44, 45)  # claims
PICTURES = ("dte_map", "efficiency", "dte_extremes", "film")

FIGURES = """
Spectra of the transmission error with the printed equations: at the higher speeds a line near the
radial modes of the pinion takes over, with sidebands at the mesh frequency.

![As printed](images/dte_map_printed.png)

The default (consistent equations, coupled to the driveline) shows mesh orders alone:

![Consistent](images/dte_map.png)
"""


def sweep(fmu: Path, folder: Path, speeds: list[float], settings: SweepSettings) -> xr.Dataset:
    """Run or resume one sweep and return its merged results."""
    results = run_sweep(settings, speeds_kmh=speeds, preloads=PRELOADS, fmu=fmu, out=folder)
    failed = int((results["status"] != 1).sum())
    if failed:
        raise SystemExit(f"{failed} points failed in {folder}; see its summary.csv")
    return results


def row(claim: Claim, consistent: xr.Dataset, printed: xr.Dataset, traction: xr.Dataset) -> str:
    """Return a claim's line of the table."""
    cells = [str(claim.number), claim.statement, claim.source, claim.tolerance]
    for data in (consistent, printed, traction):
        if data is traction and claim.number not in OF_EFFICIENCY:
            cells += ["-", "-"]
            continue
        verdict = claim.evaluate(data)
        cells += [f"{verdict.value}. {verdict.reason}".strip(), f"**{verdict.verdict}**"]
    return "| " + " | ".join(cells) + " |\n"


def default_sweep_text(data: xr.Dataset) -> str:
    """Return what the default sweep, coupled to the driveline, shows of itself."""
    asked = data["speed"].values[None, :]
    deviation = np.max(np.abs(data["vehicle_speed"].values / asked - 1.0))
    closure = np.max(np.abs(data["energy_closure_error"].values))
    torque_balance = (
        data["pinion_torque"] * data["pinion_frequency"]
        - data["wheel_torque"] * data["wheel_frequency"]
    ) * 2.0 * np.pi - data["loss"].sum("source")
    relative = float(np.max(np.abs(torque_balance / data["power_in"])))
    return f"""
## The default sweep

`gearlube sweep`: 34 points coupled to the casadi driveline.

| Quantity | Value | Limit |
|---|---|---|
| largest deviation of the mean vehicle speed from the request | {100 * deviation:.3f} % | 0.1 % |
| input work not accounted for by output, losses and stored energy | {closure:.1e} | 1e-6 |
| mean power in minus out minus losses, over power in | {relative:.1e} | 1e-2 |

The last line differs from the one above it by the change of stored energy: an axle that settles by
0.01 % of its speed over half a second stores or returns that much.
"""


def main() -> None:
    """Run the sweeps, write the page and the pictures."""
    work = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "validation"
    work.mkdir(parents=True, exist_ok=True)
    fmu = build_hypoid_axle(work)
    hold = SweepSettings(driver="hold")
    speeds = [float(v) for v in range(20, 101, 5)]
    consistent = sweep(fmu, work / "consistent", speeds, hold)
    printed = sweep(
        fmu,
        work / "as_printed",
        speeds,
        replace(hold, equations="as_printed", friction="as_printed"),
    )
    traction = sweep(
        fmu,
        work / "traction",
        speeds,
        replace(hold, friction="printed_traction_circular", bearing_torque_loss="none"),
    )
    coupled = sweep(fmu, work / "default", speeds, SweepSettings())
    text = _text("head") + "".join(row(claim, consistent, printed, traction) for claim in CLAIMS)
    text += FIGURES + "\n" + axle_section()
    text += default_sweep_text(coupled)
    text += _text("structural_tests")
    (ROOT / "docs" / "validation.md").write_text(text, encoding="utf-8")
    write_sweep_report(coupled, work / "default")
    images = ROOT / "docs" / "images"
    images.mkdir(exist_ok=True)
    for name in PICTURES:
        shutil.copyfile(work / "default" / "figures" / f"{name}.png", images / f"{name}.png")
    write_sweep_report(printed, work / "as_printed")
    shutil.copyfile(work / "as_printed" / "figures" / "dte_map.png", images / "dte_map_printed.png")


def _text(name: str) -> str:
    return (TEXTS / f"{name}.md").read_text(encoding="utf-8")


if __name__ == "__main__":
    main()
