"""Rewrite a section of docs/tooth_contact.md: python -m docs.tooth_contact.sensitivity.

Differentiates the shipped pair's contact.
"""

from __future__ import annotations

from docs.page import Page
from gearlube.studies.contact.sensitivity import (
    SensitivityRow,
    parameter_words,
    sensitivity_rows,
    tolerance_words,
)
from gearlube_core.hypoid_contact.sensitivity.analysis import (
    SensitivitySettings,
    contact_sensitivity,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.storage.process_pool import single_threaded

FILE = HypoidGearFile.named("mohammadpour_2015")
SETTINGS = SensitivitySettings(torque=50.0)
SHOWN = 6


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
    """Differentiate and put the numbers into the page."""
    with single_threaded():
        dataset = contact_sensitivity(FILE, SETTINGS, jobs=1)
        rows, page = sensitivity_rows(dataset), Page("tooth_contact")
        page.rows("What grows", largest(rows))
        page.write()


if __name__ == "__main__":
    main()
