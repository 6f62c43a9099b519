"""Films in motion against the quasi-steady film model: python -m docs.film_model.transient.

Five engagements of the shipped axle are marched in time. Beside each stand steady films on the same
grid, and the film model. A minute of processor time; kept in docs/film_model/transient.csv, an
engagement that is there is not solved again. Films in time are isothermal, as the steady ones that
they are compared with here; heat is the same for both.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import NamedTuple

import numpy as np

from docs.page import ROOT, Page
from gearlube.studies.film_model.samples import flank_contact_of
from gearlube.studies.films.hypoid.flank import HypoidFlank, hypoid_flank
from gearlube_core.arrays import Array
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.gears.hypoid_cycle import march_flank, steady_films
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.storage.atomic_file import write_text

TABLE = Path(__file__).with_name("transient.csv")
WORK = ROOT / "build" / "film_model_transient"  # marches, to go on from
NODES, STEPS, STEADY = (129, 33), 48, 9
_RPM_PER_KMH = 22.95
MODEL = FilmModel.named("hypoid_flank")


class Engagement(NamedTuple):
    """An operating point of the axle."""

    speed: float  # of the vehicle [km/h]
    torque: float  # on the pinion [N.m]
    degc: float  # of the oil

    @property
    def words(self) -> str:
        """Return the point in words."""
        return f"{self.speed:g} km/h, {self.torque:g} N·m, {self.degc:g} °C".replace("-", "−")


ENGAGEMENTS = (
    Engagement(20.0, 100.0, 95.0),
    Engagement(60.0, 40.0, 95.0),
    Engagement(100.0, 20.0, 60.0),
    Engagement(100.0, 300.0, 120.0),
    Engagement(80.0, -40.0, 80.0),
)
# films [m], load [N], phase [mesh periods]; solved friction is heated across the film, with cool
# flanks; the model's with all heat
COLUMNS = (
    "phase", "load", "film_in_time", "film_steady", "film_model", "friction_in_time",
    "friction_steady", "friction_model", "outside", "converged",
)  # fmt: skip
_IN_TIME = ("central_film", "traction_heated", "converged")


def solved(point: Engagement) -> Array:
    """Return the films of one engagement, shape (STEADY, len(COLUMNS))."""
    case = HypoidCase.named("mohammadpour_2015").varied(
        {
            "pinion_speed_rpm": _RPM_PER_KMH * point.speed,
            "pinion_torque_n_m": point.torque,
            "oil_temperature_degc": point.degc,
            "load": "static",
            "solver.nodes_minor": NODES[0],
            "solver.nodes_major": NODES[1],
        }
    )
    flank = hypoid_flank(case)
    film, settings, beta = flank.film, case.settings(), flank.oil.beta
    times = np.linspace(film.cycle.time[0], film.cycle.time[-1], STEADY)
    WORK.mkdir(parents=True, exist_ok=True)
    marched = march_flank(
        film,
        STEPS,
        beta,
        settings=settings,
        checkpoint=WORK / f"{point.speed:g}_{point.torque:g}_{point.degc:g}.npz",
        throw=False,
    )
    steady = steady_films(film, times, beta, settings=settings, throw=False)
    numbers, rows = MODEL.copied_numbers(), []
    for n, t in enumerate(times):
        now, contact = film.cycle.at(float(t)), _contact(flank, float(t))
        model = solved_film(numbers, contact)
        in_time = {key: np.interp(t, marched["time"], marched[key]) for key in _IN_TIME}
        good = steady["converged"][n] * in_time["converged"]
        rows.append(
            (
                now.phase,
                now.load,
                in_time["central_film"],
                steady["central_film"][n],
                model.central_film,
                in_time["traction_heated"],
                steady["traction_heated"][n],
                model.friction_coefficient,
                model.outside,
                good,
            )
        )
    return np.array(rows)


def _contact(flank: HypoidFlank, at: float) -> FilmContact:
    now, oil = flank.film.cycle.at(at), flank.parameters.oil
    return flank_contact_of(
        now.load,
        (now.R_x, now.R_y),
        np.array(now.entrainment),
        np.array(now.sliding),
        oil,
        flank.oil.temperature,
        (oil.eyring_stress, 0.0),
    )


def kept() -> dict[Engagement, Array]:
    """Return all engagements; those that are not in the table are solved and kept."""
    found: dict[Engagement, Array] = {}
    if TABLE.exists():
        with TABLE.open(newline="", encoding="utf-8") as stream:
            rows = np.array(list(csv.reader(stream))[1:], dtype=float)
        for point in ENGAGEMENTS:
            mine = (rows[:, :3] == np.array(point)).all(axis=1)
            if mine.any():
                found[point] = rows[mine, 3:]
    for point in ENGAGEMENTS:
        if point not in found:
            found[point] = solved(point)
            write_text(_as_csv(found), TABLE)
    return {point: found[point] for point in ENGAGEMENTS}


def _as_csv(found: dict[Engagement, Array]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow((*Engagement._fields, *COLUMNS))
    for point, rows in found.items():
        for row in rows:
            writer.writerow([f"{one:g}" for one in point] + [f"{one:.6g}" for one in row])
    return text.getvalue()


def columns(rows: Array) -> dict[str, Array]:
    """Return the columns of an engagement by name."""
    return dict(zip(COLUMNS, rows.T, strict=True))


def motion(rows: Array) -> tuple[Array, Array]:
    """Return film and friction in motion over those at rest [-]."""
    c = columns(rows)
    return c["film_in_time"] / c["film_steady"], c["friction_in_time"] / c["friction_steady"]


def put(page: Page, found: dict[Engagement, Array]) -> None:
    """Put in what motion changes."""
    cells, off = [], []
    for point, rows in found.items():
        load, row = columns(rows)["load"], [point.words]
        for one in motion(rows):
            mean = float((one * load).sum() / load.sum())
            row += [f"{one.min():.3f}", f"{one.max():.3f}", f"{mean:.3f}"]
        cells.append(row)
        held = load > 0.5 * load.max()
        off.append([100.0 * float(np.abs(one[held] - 1.0).max()) for one in motion(rows)])
    page.rows("in motion over at rest", cells)
    page.fill(
        "Where the pair carries more than half of its largest load, motion changes the film by at "
        "most {} % and the friction by at most {} %.",
        *(f"{one:.1f}" for one in np.max(off, axis=0)),
    )


def main() -> None:
    """Solve what is missing; write table and page."""
    found = kept()
    page = Page("film_model_axle")
    put(page, found)
    page.write()


if __name__ == "__main__":
    main()
