"""Kinds of contacts that a film model is made for, and what the machinery needs of each."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from gearlube.studies.film_model import line_samples, samples
from gearlube.studies.film_model.draws import Box, Limits
from gearlube.studies.film_model.solve import Solved, contact_oil, contact_solid, solve_contact
from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.thermal import (
    ThermalLineSolution,
    ThermalSettings,
    thermal_line_on_grid,
)
from gearlube_core.film_model.groups import (
    FilmContact,
    FilmGroups,
    contact_groups,
    contact_parts,
    reference_film,
    semi_minor_axis,
)
from gearlube_core.film_model.inlet import inlet_cooling
from gearlube_core.film_model.line_contact import (
    LineContact,
    line_contact_groups,
    line_parts,
    line_reference_film,
)
from gearlube_core.film_model.model import FLANK, LINE, ROLLER
from gearlube_core.film_model.reference_friction import line_reference_friction, reference_friction
from gearlube_core.film_model.rolling import (
    RollerContact,
    reference_rolling_friction,
    rolling_groups,
    rolling_line,
    solved_rolling,
)
from gearlube_core.film_model.solved_film import SolvedFilm, solved_film, solved_line
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.oil.lubricant import Lubricant

_TOLERANCE = 1e-6
_HEAT = ThermalSettings(tolerance=1e-2, max_turns=35)

Contact = Any  # FilmContact or LineContact


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactKind:
    """One kind of contact: how it is drawn, solved and evaluated.

    Parameters
    ----------
    name
        As in `FilmModel.kind`.
    words
        Description kept as provenance.
    visited
        Name of the set of contacts that a machine visits.
    contact
        Class of the contact, a NamedTuple of floats.
    nodes, second
        Nodes of the grid, and of a second one for the error of the first.
    domain, trained
        Limits of the domain, and of the training, which goes a little farther.
    box
        Plain numbers that the domain is drawn from.
    box_contact, box_contacts, edge_contacts, visits
        Draws, as `samples.box_contact` and the following; `visits` gets the names of the machines.
    solve, groups
        A contact's film on a grid, and its groups.
    reference_film, reference_friction
        What the model corrects: film [m] of a contact, and friction [-] of a contact with a film.
    predict
        Film and friction by the numbers of a model.
    smooth
        As of `fit_process`; lines in slow sliding depend on their pressure spikes, thin ellipses on
        the grid.
    """

    name: str
    words: str
    visited: str
    contact: type
    nodes: tuple[int, int]
    second: tuple[int, int]
    domain: Limits
    trained: Limits
    box: Box
    box_contact: Callable[[Box, Array], Contact]
    box_contacts: Callable[..., list[Contact]]
    edge_contacts: Callable[[Box, int, int], list[Contact]]
    visits: Callable[[int, int, Sequence[str], Sequence[Lubricant], Limits], list[Contact]]
    solve: Callable[[Contact, tuple[int, int]], Solved]
    groups: Callable[[Contact], FilmGroups]
    reference_film: Callable[[Contact], float]
    reference_friction: Callable[[Contact, float], float]
    predict: Callable[[Array, Contact], SolvedFilm]
    smooth: bool = True

    @property
    def training(self) -> tuple[str, str, str]:
        """Return the names of the sets that a fit learns from."""
        return "box", self.visited, "edge"

    @property
    def to_limit(self) -> float:
        """Return the way from the grid to the limit of fine grids, over that to the second grid.

        Of second order in the spacing: 4/3 where the second grid is twice as fine, -1/3 where it is
        half as fine.
        """
        ratio = (self.nodes[0] - 1.0) / (self.second[0] - 1.0)
        return 1.0 / (1.0 - ratio * ratio)


def _flank_film(contact: FilmContact) -> float:
    place, inlet = contact_parts(contact)
    return reference_film(contact.load, contact.entrainment_speed, place, inlet)


def _flank_friction(contact: FilmContact, film: float) -> float:
    place, inlet = contact_parts(contact)
    p = place.pressure_coefficient * contact.load ** (1.0 / 3.0)
    across = contact.entrainment_speed * place.cos_psi
    semi_axis = semi_minor_axis(contact.load, p, place)
    return reference_friction(film, p, across, contact.sliding_speed, semi_axis, contact.R_x, inlet)


def _axle_contacts(
    count: int, seed: int, tables: Sequence[str], oils: Sequence[Lubricant], limits: Limits
) -> list[FilmContact]:
    return samples.axle_contacts(count, seed, shipped_mesh_table(tables[0]), oils, limits)


def _line_film(contact: LineContact) -> float:
    inlet, u = line_parts(contact)[1], contact.entrainment_speed
    film = line_reference_film(contact.line_load, u, contact.R, inlet)
    return film * inlet_cooling(u, inlet)


def _line_friction(contact: LineContact, film: float) -> float:
    inlet = line_parts(contact)[1]
    p = line_mean_pressure(contact.line_load, contact.R, contact.contact_modulus)
    u, slip, half_width = contact.entrainment_speed, contact.sliding_speed, 0.5 * contact.line_load
    return line_reference_friction(film, p, u, slip, half_width / p, contact.R, inlet)


def _roller_film(contact: RollerContact) -> float:
    return _line_film(rolling_line(contact))


def _roller_friction(contact: RollerContact, film: float) -> float:
    # that of rolling, which does not take the film
    inlet = line_parts(rolling_line(contact))[1]
    return reference_rolling_friction(contact.line_load, contact.speed, contact.R, inlet)


HYPOID_FLANK = ContactKind(
    name=FLANK,
    words="elliptical, entrainment and sliding at angles: hypoid flank",
    visited="axle",
    contact=FilmContact,
    nodes=(129, 33),
    second=(257, 65),
    domain=samples.DOMAIN,
    trained=samples.TRAINED,
    box=samples.HYPOID_BOX,
    box_contact=samples.box_contact,
    box_contacts=samples.box_contacts,
    edge_contacts=samples.edge_contacts,
    visits=_axle_contacts,
    solve=solve_contact,
    groups=contact_groups,
    reference_film=_flank_film,
    reference_friction=_flank_friction,
    predict=solved_film,
    smooth=False,
)


def _solve_line_contact(contact: LineContact, nodes: tuple[int, int]) -> Solved:
    """Return the thermal film of a line contact; `converged` is whether it was found.

    Parameters
    ----------
    contact
        Its limiting stress is left out.
    nodes
        Across the line, and 1.

    Raises
    ------
    ParameterError
        The contact is out of the solver's range.
    """
    return _solved(contact, nodes, _sliding_friction)


def line_problem(contact: LineContact) -> LineProblem:
    """Return the problem of a contact."""
    u, slip = contact.entrainment_speed, contact.sliding_speed
    return LineProblem(
        lubricant=contact_oil(contact),
        radius=contact.R,
        line_load=contact.line_load,
        reduced_modulus=2.0 * contact.contact_modulus,
        speed_1=u - 0.5 * slip,
        speed_2=u + 0.5 * slip,
    )


def _solved(
    contact: LineContact, nodes: tuple[int, int], friction: Callable[[ThermalLineSolution], float]
) -> Solved:
    begin = time.process_time()
    solid = contact_solid(contact)
    settings = LineSettings(nodes=nodes[0], tolerance=_TOLERANCE)
    warm = thermal_line_on_grid(line_problem(contact), (solid, solid), settings, _HEAT)
    film = warm.film
    return Solved(
        film.central_film,
        film.minimum_film,
        friction(warm),
        film.maximum_pressure,
        warm.max_temperature - contact.temperature,
        math.nan,  # not asked for
        float(warm.converged),
        time.process_time() - begin,
    )


def _sliding_friction(warm: ThermalLineSolution) -> float:
    return warm.film.friction_coefficient


HELICAL_LINE = ContactKind(
    name=LINE,
    words="line, entrainment and sliding across it: helical and spur flanks",
    visited="pair",
    contact=LineContact,
    nodes=(513, 1),
    second=(1025, 1),
    domain=line_samples.LINE_DOMAIN,
    trained=line_samples.LINE_TRAINED,
    box=line_samples.LINE_BOX,
    box_contact=line_samples.line_box_contact,
    box_contacts=line_samples.line_box_contacts,
    edge_contacts=line_samples.line_edge_contacts,
    visits=line_samples.pair_contacts,
    solve=_solve_line_contact,
    groups=line_contact_groups,
    reference_film=_line_film,
    reference_friction=_line_friction,
    predict=solved_line,
    smooth=False,
)


def _solve_roller_contact(contact: RollerContact, nodes: tuple[int, int]) -> Solved:
    """Return the thermal film of a roller on its race; its friction is that of rolling, 2 F/w.

    F = int h/2 dp/dx dx, the force of the film on either surface per length, from one relative
    radius ahead of the contact on; the rest as in `_solve_line_contact`.
    """
    return _solved(rolling_line(contact), nodes, _rolling_friction)


def _rolling_friction(warm: ThermalLineSolution) -> float:
    # rollers and races end about one relative radius from the contact: no oil is rolled beyond it
    film, problem = warm.film, warm.film.problem
    beyond = 12.0 * problem.lubricant.eta0 * problem.entrainment_speed
    return 2.0 * (film.rolling_force - beyond) / problem.line_load


BEARING_ROLLER = ContactKind(
    name=ROLLER,
    words="line in pure rolling, friction that of rolling: rollers on races",
    visited="bearing",
    contact=RollerContact,
    nodes=(513, 1),
    second=(1025, 1),
    domain=line_samples.ROLLER_DOMAIN,
    trained=line_samples.ROLLER_TRAINED,
    box=line_samples.ROLLER_BOX,
    box_contact=line_samples.roller_box_contact,
    box_contacts=line_samples.roller_box_contacts,
    edge_contacts=line_samples.roller_edge_contacts,
    visits=line_samples.roller_contacts,
    solve=_solve_roller_contact,
    groups=rolling_groups,
    reference_film=_roller_film,
    reference_friction=_roller_friction,
    predict=solved_rolling,
)

KINDS = {kind.name: kind for kind in (HYPOID_FLANK, HELICAL_LINE, BEARING_ROLLER)}
_OF_TYPE = {kind.contact: kind for kind in KINDS.values()}


def kind_named(name: str) -> ContactKind:
    """Return a kind of contact by its name; a ParameterError says which there are."""
    check_option("contact", name, tuple(KINDS))
    return KINDS[name]


def kind_of(contact: Contact) -> ContactKind:
    """Return the kind of a contact."""
    return _OF_TYPE[type(contact)]
