"""States of flanks through their engagement, in steady running at one load."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.friction.mixed_friction import asperity_contact
from gearlube_core.kernels.jit import kernel


class BearingStates(NamedTuple):
    """The bearings of an axle: first and second of the pinion, then of the gear; shape (4, ...)."""

    radial: Array  # load [N]
    axial: Array  # [N]
    rollers: Array  # load of each roller, (4, most rollers), 0 beyond the last [N]
    film: Array  # thinnest of the raceways by solved films; 0 without them [m]


class FlankStates(NamedTuple):
    """Flanks at N states of their engagement; arrays of shape (N,), SI units.

    A state is the Hertz ellipse of a pair of flanks at a phase, or a strip of a contact line.
    """

    phase: Array  # mesh periods: of ellipses from the middle of the pair's window, rising
    load: Array  # normal [N], above 0
    pressure: Array  # largest of Hertz [Pa]
    line_load: Array  # over a unit of length of the contact line, in the middle [N/m]
    semi_minor: Array  # half width of the contact [m]
    semi_major: Array  # of the ellipse, which knows no edge of the tooth; half of a strip [m]
    film_ratio: Array  # central film over composite roughness [-]
    friction: Array  # force [N]
    asperity_share: Array  # of the load; 1 where the law of friction does not know it [-]
    outside: Array  # 0: film and friction are of the model of solved films, 1: of formulas
    sliding: Array  # of the pinion's flank over the gear's, with the part along the line [m/s]
    pinion_speed: Array  # of the flanks across the line of contact, relative to it [m/s]
    gear_speed: Array
    table_pressure: Array  # highest pressure of the mesh table, with that of edges [Pa]
    place: Array  # (N, 2): on the drawn tooth, along and up from its lower left corner [m]
    major: Array  # (N, 2): how a metre along the line is drawn there [-]
    share_of_time: float  # that a phase stands for, of a mesh period [-]
    bulk: float  # temperature of the flanks' bulk [K]
    carried: float  # torque of the teeth at the pinion [N.m]
    bearings: BearingStates | None  # None: not known
    strips: bool = False  # of contact lines, no ellipses

    @property
    def heat(self) -> Array:
        """Greatest friction power over area [W/m2]."""
        return self.friction * self.sliding * self.pressure / self.load

    @property
    def friction_power(self) -> float:
        """Mean of all pairs over a mesh period [W]."""
        return float((self.friction * self.sliding).sum() * self.share_of_time)


@kernel
def asperity_shares(
    load: Array,
    pressure: Array,
    film_ratio: Array,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
) -> Array:
    """Return the shares of loads that asperities carry [-], see `asperity_contact`.

    Loads are those of contacts [N], or of lines per length [N/m]; pressures are the mean [Pa].
    """
    shares = np.empty(load.size)
    for i in range(load.size):
        F = load[i]
        carried, _ = asperity_contact(F, F / pressure[i], film_ratio[i], surface, solid, form)
        shares[i] = carried / F
    return shares
