"""Rewrite a section of docs/tooth_contact.md: python -m docs.tooth_contact.sensitivity.

Differentiates the shipped pair's contact, draws what small errors change, and compares with
differences of the plain analysis: two minutes.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from docs.page import IMAGES, Page
from gearlube.studies.contact.sensitivity import (
    SensitivityRow,
    parameter_words,
    sensitivity_figure,
    sensitivity_rows,
    tolerance_words,
)
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED
from gearlube_core.hypoid_contact.sensitivity.analysis import (
    SensitivitySettings,
    contact_sensitivity,
)
from gearlube_core.hypoid_contact.sensitivity.loaded_rates import loaded_rates
from gearlube_core.hypoid_contact.sensitivity.parameter import Parameter, Variations
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.process_pool import single_threaded

FILE = HypoidGearFile.named("mohammadpour_2015")
SETTINGS = SensitivitySettings(torque=50.0)
COMPARED = (
    "misalignment.pinion_offset",
    "misalignment.pinion_axial",
    "misalignment.gear_axial",
    "misalignment.shaft_angle",
    "pinion.machine.radial_setting_mm",
    "gear.machine.vertical_setting_mm",
    "pinion.cutter.blade_edge_radius_mm",
)
SHOWN = 12
STEP = 0.5  # tolerances, of the plain analysis to either side: less scatters, more bends


def measured(pair: FlankPair) -> dict[str, float]:
    """Return drive-side quantities of a pair over the mesh, each position on strips of its own."""
    teeth = pair_stiffness(FILE, SETTINGS.body)["drive"]
    states = [
        MeshPosition.at(pair, float(phase)).load(
            SETTINGS.torque, teeth, LoadedSettings(tolerance=1e-7)
        )
        for phase in SETTINGS.phases
    ]
    nothing = Variations.of(FILE, pair, ())
    values = [loaded_rates(nothing, state, teeth).value for state in states]
    rotation = np.array([state.rotation for state in states])
    wave = np.exp(-2j * np.pi * SETTINGS.phases) * 2.0 / rotation.size
    return {
        "unloaded_pp": float(abs(unloaded_error(pair, 9).angular[0])),
        "te_1": float(abs(rotation @ wave)),
        "s": float(np.mean([one.s for one in values])),
        "t": float(np.mean([one.t for one in values])),
        "sliding_loss": float(np.mean([one.sliding_loss for one in values])),
        "stiffness": float(np.mean([one.secant_stiffness for one in values])),
    }


def changed_pair(parameter: Parameter, change: float) -> FlankPair:
    """Return the drive pair with a parameter changed, built again."""
    section, _, key = parameter.name.partition(".")
    if section == "misalignment":
        displaced = replace(ALIGNED, **{key: parameter.value + change})
        return FlankPair.from_file(FILE, "drive", displaced)
    return FlankPair.from_file(FILE.varied({parameter.name: parameter.value + change}), "drive")


def comparison(rows: list[SensitivityRow]) -> list[list[str]]:
    """Return the rows of rates beside differences of the plain analysis."""
    here = measured(FlankPair.from_file(FILE, "drive"))
    found = {row.parameter: row for row in rows if row.side == "drive"}
    lines = []
    for name in COMPARED:
        parameter = Parameter.named(name, FILE, ALIGNED)
        size = STEP * parameter.tolerance
        above, below = (measured(changed_pair(parameter, sign * size)) for sign in (1.0, -1.0))
        row = found[name]
        cells = [parameter_words(name), tolerance_words(parameter.tolerance, parameter.unit)]
        for key, scale in (
            ("unloaded_pp", 1e6),
            ("te_1", 1e6),
            ("s", 1e2),
            ("t", 1e2),
            ("stiffness", 1e2 / here["stiffness"]),
            ("sliding_loss", 1e2 / here["sliding_loss"]),
        ):
            plain = scale * (above[key] - below[key]) / (2.0 * STEP)
            rate = getattr(row, key) * (1e6 if scale == 1e6 else 1e2)
            cells.append(f"{rate:+.3f} / {plain:+.3f}")
        lines.append(cells)
    return lines


def largest(rows: list[SensitivityRow]) -> list[list[str]]:
    """Return the rows of the parameters with the largest change of the loaded error."""
    pairs = list(zip(rows[::2], rows[1::2], strict=True))
    pairs.sort(key=lambda pair: -max(abs(one.te_1) for one in pair))
    return [
        [
            parameter_words(pair[0].parameter),
            tolerance_words(pair[0].tolerance, pair[0].unit),
            *(
                " / ".join(f"{scale * getattr(one, key):+.2f}" for one in pair)
                for key, scale in (
                    ("unloaded_pp", 1e6),
                    ("te_1", 1e6),
                    ("s", 1e2),
                    ("t", 1e2),
                    ("pressure", 1e2),
                )
            ),
        ]
        for pair in pairs[:SHOWN]
    ]


def main() -> None:
    """Differentiate, draw, compare, and put the numbers into the page."""
    with single_threaded():
        dataset = contact_sensitivity(FILE, SETTINGS, jobs=1)
        sensitivity_figure(dataset).savefig(IMAGES / "contact_sensitivity.png", dpi=110)
        rows, page = sensitivity_rows(dataset), Page("tooth_contact")
        page.rows("What grows", largest(rows))
        page.rows("Drive side (each cell: derivative", comparison(rows))
        page.write()


if __name__ == "__main__":
    main()
