"""The options of `gearlube contact` that write the animation of flank films."""

from __future__ import annotations

from pathlib import Path

from gearlube.cli.oil_option import oil_kelvin
from gearlube.plotting.drawn_tooth import DrawnTooth
from gearlube.studies.contact.figures.flank_films import animate_films
from gearlube.studies.contact.flank_films import (
    PAPERS_AXLE,
    SPEED_RANGE,
    FilmRequest,
    axle_around,
    flank_films,
)
from gearlube.studies.contact.run import ContactResults
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.shipped import shipped_mesh_table
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.units import rpm_to_rads

_DEGC = 90.0


def film_request(
    rpm: float | None, oil: str | None, degc: float | None, axle: str | None = None
) -> FilmRequest | None:
    """Return what is asked for, None without a speed; errors name the options.

    Wrong axle files are found here, before the contact is analysed.
    """
    if rpm is None:
        for option, value in (("--axle", axle), ("--oil", oil), ("--oil-temperature", degc)):
            if value is not None:
                raise ParameterError(
                    f"{option} {value} is only for --films-rpm, which is missing. Give both, or "
                    "none: without films the contact is dry."
                )
        return None
    check_within("--films-rpm", rpm, *SPEED_RANGE, "rpm")
    around = axle_around(axle or PAPERS_AXLE, shipped_mesh_table(PAPERS_AXLE))
    lubricant = around.oil if oil is None else read_oil(oil).lubricant
    degc = _DEGC if degc is None else degc
    return FilmRequest(
        speed=rpm_to_rads(rpm),
        oil=lubricant,
        oil_temperature=oil_kelvin(degc, lubricant),
        axle=axle or PAPERS_AXLE,
    )


def write_films(results: ContactResults, request: FilmRequest, folder: Path) -> Path:
    """Write the animation of an analysis into its folder; return the file."""
    films = flank_films(results.contact, results.mesh_table, request)
    return animate_films(films, DrawnTooth.of_dataset(results.contact), folder)
