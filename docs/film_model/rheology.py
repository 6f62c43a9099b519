"""The axle over the range of the oil's rheology: python -m docs.film_model.rheology.

Mesh efficiency over the Eyring stress, by formula and solved, and where a limiting stress of the
oil, which neither has, would bind. About a minute. Writes a section of docs/film_model_axle.md.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from docs.film_model.compare import axle_of, found
from docs.page import Page
from drivetrain.axle_file.read_axle import read_axle
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.samples import DOMAIN, axle_contacts
from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.friction.flank_data import contact_geometry
from gearlube_core.friction.flank_laws import Consistent
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.units import kmh_to_ms

OIL = "mohammadpour_2015"
STRESSES = np.array([2.0, 3.0, 5.0, 7.0, 10.0])  # MPa
SPEEDS = np.array([20.0, 60.0, 100.0])  # km/h
TORQUES = np.array([100.0])  # N.m
LIMITS = np.array([0.035, 0.05])  # limiting stress over pressure [-]
CONTACTS, SEED = 1500, 206
_SMOOTH = 1e-8  # m, of flanks without asperities in touch


class Efficiency(NamedTuple):
    """Of the mesh, over Eyring stress, speed and torque [%]."""

    formula: Array
    solved: Array
    bound: Array


def efficiencies() -> Efficiency:
    """Return the efficiency of the mesh at 95 degC."""
    road = read_axle("mohammadpour_2015").driveline.road_load
    pinion = np.array([road.pinion_speed(kmh_to_ms(speed)) for speed in SPEEDS])
    by = {
        (film, stress): found(axle_of(film, stress), TORQUES, pinion, np.array([95.0]))
        for film in ("formula", "solved")
        for stress in STRESSES
    }

    def of(film: str, key: str) -> Array:
        return np.array([by[film, stress][key][0] for stress in STRESSES])

    name = "mesh_efficiency_percent"
    return Efficiency(of("formula", name), of("solved", name), of("solved", "bound_percent"))


def frictions(oil_name: str) -> tuple[Array, Array, Array]:
    """Return coefficients of the film's friction over the axle's contacts, and their weights.

    Solved and by formula, each (stresses, contacts) [-]; weights, load times sliding speed,
    (contacts,). Contacts of the model's domain alone. The coefficient is the mean shear stress
    over the mean pressure.
    """
    oil = read_oil(oil_name).lubricant
    table = shipped_mesh_table(FilmPlan().mesh_table)
    contacts = axle_contacts(CONTACTS, SEED, table, [oil], DOMAIN)
    solid = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
    law = Consistent()(gear_flanks(_SMOOTH), solid)
    numbers = FilmModel.named("hypoid_flank").copied_numbers()

    def both(c: FilmContact, stress: float) -> tuple[float, float]:
        state = lubricant_state(
            replace(oil, eyring_stress=1e6 * stress).parameters(), c.temperature
        )
        geometry = contact_geometry(c.R_x, c.R_y, c.entrainment_angle, solid.contact_modulus)
        flank = law.flank_state(c.load, c.entrainment_speed, c.sliding_speed, geometry, state)
        film = solved_film(numbers, c._replace(tau0=1e6 * stress, eyring_slope=0.0))
        return film.friction_coefficient, flank.viscous_friction / c.load

    found = np.array([[both(c, stress) for c in contacts] for stress in STRESSES])
    weights = np.array([c.load * c.sliding_speed for c in contacts])
    return found[..., 0], found[..., 1], weights


def shares(friction: Array, weights: Array) -> Array:
    """Return the share of the friction loss with mean stress above a limit, (stresses, limits)."""
    loss = friction * weights
    return np.stack(
        [(loss * (friction > limit)).sum(axis=1) / loss.sum(axis=1) for limit in LIMITS], axis=1
    )


def efficiency_rows(made: Efficiency) -> list[list[str]]:
    """Return the efficiencies by formula and by solved films."""
    rows = []
    for j, speed in enumerate(SPEEDS):
        for k, torque in enumerate(TORQUES):
            at = f"{speed:g} km/h, {torque:g} N·m"
            solved = zip(made.solved[:, j, k], made.bound[:, j, k], strict=True)
            rows.append([f"{at}: formula", *(f"{one:.2f}" for one in made.formula[:, j, k])])
            rows.append([f"{at}: solved", *(f"{one:.2f} ± {bound:.2f}" for one, bound in solved)])
    return rows


def limit_rows(by_oil: dict[str, tuple[Array, Array, Array]]) -> list[list[str]]:
    """Return where a limiting stress would bind [%]."""
    rows = []
    for name, (solved, formula, weights) in by_oil.items():
        for words, friction in (("solved", solved), ("formula", formula)):
            made = 100.0 * shares(friction, weights)
            for n, limit in enumerate(LIMITS):
                cells = (f"{one:.0f}" for one in made[:, n])
                rows.append([f"{name}, {words}: limit {limit:g} p", *cells])
    return rows


def main() -> None:
    """Compute all and write it."""
    made = efficiencies()
    by_oil = {OIL: frictions(OIL)}
    page = Page("film_model_axle")
    page.rows("efficiency of the mesh [%], 95 °C", efficiency_rows(made))
    page.rows("share of the flanks' friction loss with", limit_rows(by_oil))
    page.write()


if __name__ == "__main__":
    main()
