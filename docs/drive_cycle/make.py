"""Compute and draw what docs/drive_cycle.md shows: python -m docs.drive_cycle.make.

A minute of one processor; the WLTC needs `pip install 'gearlube[cycles]'`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from docs.page import IMAGES, ROOT
from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.axle_file.read_axle import read_axle
from drivetrain.cycle.traces import DriveCycle
from gearlube.output.csv_text import csv_text
from gearlube.studies.drive_cycle.figures import cycle_figure
from gearlube.studies.drive_cycle.run import grid_change, run_cycle
from gearlube.studies.drive_cycle.settings import DriveCycleSettings
from gearlube.studies.loss_map.figures import loss_contours
from gearlube.studies.loss_map.run import run_loss_map
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.storage.atomic_file import write_text

NUMBERS = Path(__file__).parent / "numbers.csv"
_DRAWN = (
    ("lost in all", "energy_lost", 1.0, "kJ"),
    ("efficiency", "efficiency", 100.0, "%"),
    ("oil at the end", "end_temperature", 1.0, "degC"),
)
VAN = ROOT / "examples" / "my_axle.toml"


def _rows(name: str, car: CarAxle, cycle: str) -> list[tuple[str, str, str, str, str]]:
    settings = DriveCycleSettings(car=car, cycle=DriveCycle.named(cycle))
    found = run_cycle(settings)
    if (name, cycle) == ("van", "wltc"):
        cycle_figure(found).savefig(IMAGES / "drive_cycle_van_wltc.png", dpi=100)
    energy = found["energy_lost"]
    values = [
        (f"lost: {source}", float(one), "kJ")
        for source, one in zip(energy["source"].values, energy.values, strict=True)
        if one > 1e-3 * float(energy.sum())
    ]
    oil = found["oil_temperature"].values
    values += [
        ("lost in all", float(energy.sum()), "kJ"),
        ("put in", float(found["energy_in"]), "kJ"),
        ("efficiency", 100.0 * float(found["efficiency"]), "%"),
        *(
            (f"{words}, {end} of 95 % of draws", scale * float(found[f"{name}_{end}"]), unit)
            for words, name, scale, unit in _DRAWN
            for end in ("low", "high")
        ),
        ("oil at the end", float(oil[-1]), "degC"),
        ("lowest oil at the end, assumed data", float(found["oil_temperature_low"][-1]), "degC"),
        ("highest oil at the end, assumed data", float(found["oil_temperature_high"][-1]), "degC"),
        ("change of the energy by a map twice as fine", 100.0 * grid_change(settings, found), "%"),
    ]
    values += [
        (f"energy lost outside {one['range'].item()}", 100.0 * float(one), "%")
        for one in found["energy_outside_range"]
        if float(one) > 0.0
    ]
    return [(name, cycle, words, f"{value:.4g}", unit) for words, value, unit in values]


def main() -> None:
    """Compute both axles over the cycles, and the map of the van's axle."""
    rows = []
    for name, car in (("paper", read_axle("mohammadpour_2015")), ("van", read_axle(VAN))):
        for cycle in ("nedc", "wltc"):
            rows += _rows(name, car, cycle)
    head = ("axle", "cycle", "quantity", "value", "unit")
    write_text(csv_text(head, rows), NUMBERS)
    low, high = read_axle(VAN).axle.torque_range
    van = run_loss_map(
        LossMapSettings(axle=read_axle(VAN).axle, torques=np.linspace(0.5 * low, high, 31), draws=0)
    )
    loss_contours(van).savefig(IMAGES / "own_axle_map.png", dpi=100)


if __name__ == "__main__":
    main()
