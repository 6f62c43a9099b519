"""A ball bearing of a train: deep groove or angular contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.ball_rings import BallRings, ball_rings
from gearlube_core.checks import check_within
from gearlube_core.dynamics.train.element import Listed
from gearlube_core.dynamics.train.elements.ring_bearing import (
    DIAMETER,
    N_ELEMENTS,
    OUTPUTS,
    RingBearing,
    RingBearingNumbers,
)
from gearlube_core.errors import ParameterError
from gearlube_core.number import Number, Output

_GROOVE = Number("1", 0.501, 0.75, "0.52 is usual.")


@dataclass(frozen=True, slots=True, kw_only=True)
class BallBearing(RingBearing):
    """A ball bearing between a body and its housing; a preloaded pair is two of them.

    Parameters
    ----------
    name, body, housing : str
        The housing is "ground" or another body.
    arm : float
        Middle of the bearing along z from the centre of the body [m].
    housing_x, housing_y, housing_z : float
        Middle of the bearing from the centre of the housing [m].
    n_balls : int
        Number of balls, 3 to 40.
    ball_diameter, pitch_diameter : float
        [m]
    inner_groove, outer_groove : float
        Groove radius of either ring over the ball diameter [-].
    contact_angle : float
        0 for deep grooves [rad].
    side : int
        +1: a displacement of the body along +z loads an angular contact, -1: one along -z.
    clearance : float
        Internal radial clearance of the mounted bearing, of the diameter [m]; negative presses.
    offset : float
        How far the body is mounted to its loaded side, which preloads a pair [m].
    tilt_arm : {"pitch_circle", "groove_centres"}
        Where a tilt moves the inner groove along the axis.
    damping_time : float
        t: each contact has a damper of t times its present stiffness [s].
    f0, f1, axial_factor : float
        Of the drag by viscosity and f1 max(Y F_a, F_r) dm by load, see `catalogue.drag_torque` [-].
    youngs_modulus, poisson_ratio : float
        Of rings and balls [Pa], [-].

    Notes
    -----
    Hertz contacts of massless balls: good below some 1e6 mm/min of speed times mean diameter.
    The moment of loads on the cage goes to both rings, so that energy and moments balance.

    References
    ----------
    [iso_16281]; [de_mul_1989]; drag [palmgren_1959]; damping_time as in [kraemer_1993].

    Examples
    --------
    >>> bearing = BallBearing(
    ...     name="left", body="shaft", n_balls=7, ball_diameter=11.5e-3, pitch_diameter=43.5e-3,
    ...     inner_groove=0.52, outer_groove=0.53, f0=2.0, f1=3e-4, axial_factor=3.0,
    ... )
    >>> round(1e-9 * bearing.rings()[0].stiffness, 2)  # c_p, 1e9 N/m^1.5
    10.55
    """

    n_balls: Annotated[int, N_ELEMENTS._replace(text="Number of balls")]
    ball_diameter: Annotated[float, DIAMETER._replace(text="Diameter of the balls")]
    inner_groove: Annotated[
        float, _GROOVE._replace(text="Groove radius of the inner ring over the ball diameter")
    ]
    outer_groove: Annotated[
        float, _GROOVE._replace(text="Groove radius of the outer ring over the ball diameter")
    ]
    contact_angle: Annotated[
        float,
        Number("rad", 0.0, math.radians(70.0), "40 deg is 0.698 rad.", shown="deg",
               text="Contact angle of the unloaded bearing without clearance; 0: deep groove"),
    ] = 0.0  # fmt: skip
    side: Annotated[
        int,
        Number("1", -1, 1, text="1: a displacement along +z loads an angular contact, -1: one "
               "along -z"),
    ] = 1  # fmt: skip
    offset: Annotated[
        float,
        Number("m", -1e-3, 1e-3, "10 um is 1e-5 m.", shown="um",
               text="How far the body is mounted to its loaded side, for a preload"),
    ] = 0.0  # fmt: skip
    tilt_arm: Literal["pitch_circle", "groove_centres"] = "pitch_circle"
    kind: ClassVar = "ball_bearing"
    interpreted: ClassVar = (Listed(RingBearingNumbers, (BallRings,), 5),)
    outputs: ClassVar = (
        *OUTPUTS,
        Output("contact_angle_min", "rad", "least contact angle under load", 0.1, "deg"),
        Output("contact_angle_max", "rad", "largest contact angle under load", 0.1, "deg"),
    )

    def __post_init__(self) -> None:
        self.check_elements(self.n_balls, self.ball_diameter)
        if self.side == 0:
            raise ParameterError(f"side of {self.name} must be 1 or -1, got 0.")
        distance = (self.inner_groove + self.outer_groove - 1.0) * self.ball_diameter
        most = 1.9 * distance * math.cos(self.contact_angle)
        cure = "Clearance cannot exceed what the grooves leave to the balls."
        check_within(f"clearance of {self.name}", self.clearance, -1e-4, most, "m", cure)

    def rings(self) -> tuple[BallRings, Array]:
        """Return the numbers between both rings; balls have no laminae."""
        found = ball_rings(
            self.n_balls,
            self.ball_diameter,
            self.pitch_diameter,
            self.inner_groove,
            self.outer_groove,
            self.contact_modulus,
            contact_angle=self.contact_angle,
            clearance=self.clearance,
            side=self.side,
            offset=self.offset,
            tilt_on_grooves=self.tilt_arm == "groove_centres",
        )
        return found, np.empty(0)
