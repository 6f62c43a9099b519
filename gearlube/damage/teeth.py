"""Data of the meshing teeth for a damage run, and the teeth of an axle."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from drivetrain.axle_file.axle_file import CarAxle
from gearlube.damage.permissible_film import permissible_ratio
from gearlube.plotting.drawn_tooth import GEAR_TOOTH, ToothWords
from gearlube.report.numbers import number_text
from gearlube_core.contact.solid import Solid
from gearlube_core.dynamics.hypoid_axle.flank_states import flank_states
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.friction.flank_states import FlankStates
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.rating.bevel_mesh import BevelMesh
from gearlube_core.rating.gears import Gears, LoadFactors, StrengthRating
from gearlube_core.rating.iso_10300 import bevel_rating
from gearlube_core.rating.spectrum import DutyBins, Rate
from gearlube_core.units import ZERO_CELSIUS

_AXLE = (
    "Pressure, temperature and wear are those of the Hertz ellipse, cut off at the edges of the "
    "tooth. Where an edge itself presses, the true pressure is higher.",
    "Flanks of hypoid gears slide everywhere: no place is without wear.",
    "Without film.bulk_resistance_k_w in the axle file the flanks are as warm as the oil.",
)


BEVEL_FACE = 1.65  # of bevel gears, light check, one overhung
Row = tuple[str, ...]  # of the summary


class Beside(NamedTuple):
    """The standard's results for a life besides pitting and breakage."""

    rows: list[Row]
    outside: tuple[str, ...]  # limits that are exceeded, in words
    notes: tuple[tuple[str, str], ...]  # headline and detail of findings


class Teeth(NamedTuple):
    """Teeth that mesh, of an axle or of a pair: all that a damage run takes of them."""

    name: str
    ratio: float  # teeth of the gear over those of the pinion [-]
    oil: Lubricant
    solid: Solid  # of both flanks
    film: str  # "formula" or "solved"
    torques: tuple[float, float]  # least and largest of the pinion that the model takes [N.m]
    cure: str  # what to do beyond
    solved_torque: float  # up to which the contact is solved [N.m]
    states: Callable[[float, float, float], FlankStates]  # of torque, speed, oil temperature
    # by a standard, of the flank that a torque loads; takes what `cylindrical_rating` takes
    rating: Callable[[float], Callable[..., StrengthRating]] | None
    standard: str  # with edition and method
    drawn: ToothWords
    drawn_size: tuple[float, float]  # along and up [m]
    limits: tuple[str, ...]  # what the solved numbers leave out
    # film ratio without micropitting, of torque and bulk temperature of the test gear
    permissible: Callable[[float, float], float]
    face: Callable[[DutyBins], float]  # K_H beta where none is given
    withheld: str = ""  # why nothing is rated
    key: str = ""  # a hash of what decides the states, of a pair
    beside: Callable[[DutyBins, Gears | None, LoadFactors], Beside] = lambda *given: Beside(
        [], (), ()
    )

    def rate(self, gears: Gears, factors: LoadFactors) -> Rate | None:
        """Return the standard's rating over torque, speed, temperature; None: it is withheld."""
        rating = self.rating
        if rating is None:
            return None
        nu = float(self.oil.state(ZERO_CELSIUS + 40.0).nu)

        def rated(torque: float, speed: float, temperature: float) -> StrengthRating:
            return rating(torque)(
                gears=gears, factors=factors, pinion_torque=abs(torque), pinion_speed=speed,
                cycles=(1.0, 1.0), oil_viscosity=nu,
            )  # fmt: skip

        return rated


def safety_row(
    name: str, value: str, limit: str, safety: float, required: str, good: str, by: str
) -> Row:
    """Return a row of the summary whose verdict follows from the safety."""
    verdict = good if safety >= 1.0 else "fails"
    return name, value, limit, number_text(safety), required, verdict, by


def axle_teeth(car: CarAxle, blank: HypoidBlank | None) -> Teeth:
    """Return the teeth of an axle.

    Parameters
    ----------
    car
        Axle of an axle file; its mesh table has the places of contact on the tooth.
    blank
        Of the gears, for ISO 10300; None: no rating by the standard.

    Examples
    --------
    >>> import gearlube as gl
    >>> teeth = axle_teeth(gl.read_axle("mohammadpour_2015"), None)
    >>> round(float(teeth.states(100.0, 200.0, 353.15).pressure.max() / 1e9), 2)  # GPa
    1.01
    """
    axle, limits = car.axle, torque_limits(car.axle)
    meshes = [] if blank is None else [
        BevelMesh.of_blank(blank, flank=side) for side in ("drive", "coast")
    ]  # fmt: skip
    return Teeth(
        name=car.name,
        ratio=float(axle.mesh.ratio),
        oil=axle.oil,
        solid=axle.solid,
        film=axle.film,
        torques=(limits.pinion_low, limits.pinion_high),
        cure=limits.cure,
        solved_torque=float(np.abs(axle.mesh.torque).max()),
        states=lambda torque, speed, temperature: flank_states(
            axle, torque=torque, speed=speed, temperature=temperature
        ),
        rating=(lambda torque: partial(bevel_rating, meshes[int(torque < 0.0)]))
        if meshes
        else None,
        standard="ISO 10300-2, -3:2023, method B1",
        drawn=GEAR_TOOTH,
        drawn_size=axle.mesh.tooth_size or (1.0, 1.0),
        limits=_AXLE,
        permissible=partial(permissible_ratio, axle),
        face=lambda bins: BEVEL_FACE,
    )
