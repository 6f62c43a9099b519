"""Make the measured data of gearlube measured --example: python -m docs.measured_file.data.

Nothing here was measured. The flanks are those of changed machine settings,
with noise of the probe.
"""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.settings_fit import flank_deviation
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import COLUMNS
from gearlube_core.hypoid_geometry.measured.measured_file import (
    PITCH_COLUMNS,
    WAVE_COLUMNS,
    MeasuredFile,
)
from gearlube_core.hypoid_geometry.measured.measured_flanks import EXAMPLE
from gearlube_core.storage.atomic_file import write_text

FOLDER = EXAMPLE
MADE = "# made, not measured: python -m docs.measured_file.data"
NOISE_UM = 0.3
TEETH: dict[Role, tuple[int, ...]] = {"pinion": (1, 5, 9), "gear": (1, 13, 25)}
WAVES = (
    MADE,
    ",".join(WAVE_COLUMNS),
    "pinion,drive,31,0.3,0",
    "pinion,coast,31,0.3,0",
    "gear,drive,83,0.4,45",
    "gear,coast,83,0.4,45",
)
CHANGES = {
    "pinion": {"pinion.machine.tilt_angle_deg": 0.05, "pinion.machine.radial_setting_mm": 0.03},
    "gear": {"gear.machine.horizontal_setting_mm": 0.02},
}


def cut_file(nominal: HypoidGearFile, role: str) -> HypoidGearFile:
    """Return the gear file with the settings with which a member was really cut."""
    changed: dict[str, object] = {}
    for field, change in CHANGES[role].items():
        value: object = nominal
        for part in field.split("."):
            value = getattr(value, part)
        assert isinstance(value, float)
        changed[field] = value + change
    return nominal.varied(changed)


def deviation_lines(file: MeasuredFile, rng: np.random.Generator) -> list[str]:
    """Return the lines of the CSV file of deviations."""
    nominal = file.nominal(FOLDER)
    lines = [MADE, ",".join(COLUMNS)]
    for (role, side), places in file.places(nominal.blank()).items():
        flanks = (Flank.from_file(one, role, side) for one in (nominal, cut_file(nominal, role)))
        smooth = flank_deviation(*flanks, places.s, places.t)
        for tooth in TEETH[role]:
            lines += _lines(f"{role},{side},{tooth}", 1e6 * smooth, rng)
    return lines


def _lines(head: str, smooth: Array, rng: np.random.Generator) -> list[str]:
    found = smooth + NOISE_UM * rng.standard_normal(smooth.shape)
    found -= found[found.shape[0] // 2, found.shape[1] // 2]  # the machine turns it to zero there
    return [
        f"{head},{i + 1},{j + 1},{value:.1f}"
        for (i, j), value in np.ndenumerate(np.where(np.abs(found) < 0.05, 0.0, found))
    ]


def pitch_lines(rng: np.random.Generator) -> list[str]:
    """Return the lines of the CSV file of cumulative pitch deviations: once a turn, and noise."""
    lines = [MADE, ",".join(PITCH_COLUMNS)]
    for role, teeth, once, noise in (("pinion", 13, 4.0, 1.0), ("gear", 36, 8.0, 1.5)):
        for side, phase in (("drive", 0.6), ("coast", 2.0)):
            turn = 2.0 * np.pi * np.arange(teeth) / teeth
            values = once * np.cos(turn - phase) + noise * rng.standard_normal(teeth)
            values -= values[0]  # counted from tooth 1
            lines += [f"{role},{side},{k},{value:.1f}" for k, value in enumerate(values, 1)]
    return lines


def main() -> None:
    """Write the CSV files."""
    rng = np.random.default_rng(17)
    file = MeasuredFile.from_toml(FOLDER / "axle_17.toml")
    write_text("\n".join(deviation_lines(file, rng)) + "\n", FOLDER / "deviations.csv")
    write_text("\n".join(pitch_lines(rng)) + "\n", FOLDER / "pitch.csv")
    write_text("\n".join(WAVES) + "\n", FOLDER / "waviness.csv")


if __name__ == "__main__":
    main()
