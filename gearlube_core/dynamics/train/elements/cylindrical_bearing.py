"""A cylindrical roller bearing of a train."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

from gearlube_core.arrays import Array
from gearlube_core.bearings.cylinder_rings import PROFILE, CylinderRings, cylinder_rings
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


@dataclass(frozen=True, slots=True, kw_only=True)
class CylindricalBearing(RingBearing):
    """A cylindrical roller bearing between a body and its housing.

    Parameters
    ----------
    name, body, housing, arm, housing_x, housing_y, housing_z
        As of `BallBearing`.
    n_rollers : int
        Number of rollers, 3 to 40.
    roller_diameter, roller_length, pitch_diameter : float
        The length is that of the contact [m].
    laminae : int
        In which the length is divided; the time of a step grows with it.
    profile : float
        P(t) = profile D ln(1/(1 - (2 t/L)^2)) of either contact over the diameter; 0: straight.
    flange_stiffness, flange_gap, side : float, float, int
        Ribs as a spring along z behind a gap [N/m], [m]; side 1: against a displacement of the body
        along +z, -1: along -z, 0: both. Without stiffness the bearing is free along z.
    clearance, damping_time, f0, f1, axial_factor, youngs_modulus, poisson_ratio
        As of `BallBearing`; the moduli set the pressure alone.

    Notes
    -----
    The stiffness of laminae is the standard's, for steel. Laminae do not feel each other.

    References
    ----------
    [iso_16281]; drag [palmgren_1959]; damping_time as in [kraemer_1993].

    Examples
    --------
    >>> bearing = CylindricalBearing(
    ...     name="right", body="shaft", n_rollers=13, roller_diameter=9e-3, roller_length=9e-3,
    ...     pitch_diameter=47e-3, clearance=2e-5, f0=2.0, f1=3e-4,
    ... )
    >>> rings, gaps = bearing.rings()
    >>> gaps.size, round(1e6 * float(gaps[15]), 2)  # um, half of the clearance and the profile
    (31, 10.0)
    """

    n_rollers: Annotated[int, N_ELEMENTS._replace(text="Number of rollers")]
    roller_diameter: Annotated[float, DIAMETER._replace(text="Diameter of the rollers")]
    roller_length: Annotated[
        float, Number("m", 1e-3, 0.5, "13.6 mm is 0.0136 m.", shown="mm",
                      text="Length of the contact of a roller"),
    ]  # fmt: skip
    laminae: Annotated[
        int, Number("1", 1, 200, text="Laminae of a roller; the standard asks for 30 or more")
    ] = 31
    profile: Annotated[
        float, Number("1", 0.0, 0.01, text="Logarithmic profile of a roller over its diameter")
    ] = PROFILE
    flange_stiffness: Annotated[
        float, Number("N/m", 0.0, 1e12, shown="N/um", text="Stiffness of the ribs along z; 0: none")
    ] = 0.0
    flange_gap: Annotated[
        float, Number("m", -1e-3, 0.01, shown="um", text="Play along z before the ribs touch")
    ] = 0.0
    side: Annotated[
        int,
        Number("1", -1, 1, text="1: ribs stop the body towards +z, -1: towards -z, 0: both ways"),
    ] = 0
    kind: ClassVar = "cylindrical_bearing"
    interpreted: ClassVar = (Listed(RingBearingNumbers, (CylinderRings,), 5),)
    outputs: ClassVar = (
        *OUTPUTS,
        Output("line_load_max", "N/m", "largest load per length of a roller", 1e5),
    )

    def __post_init__(self) -> None:
        self.check_elements(self.n_rollers, self.roller_diameter)
        if self.laminae != int(self.laminae):
            raise ParameterError(
                f"laminae of {self.name} must be a whole number, got {self.laminae:g}."
            )

    def rings(self) -> tuple[CylinderRings, Array]:
        """Return the numbers between both rings, and the gap of each lamina [m]."""
        return cylinder_rings(
            self.n_rollers,
            self.roller_diameter,
            self.pitch_diameter,
            self.roller_length,
            self.contact_modulus,
            laminae=int(self.laminae),
            clearance=self.clearance,
            profile=self.profile,
            flange=self.flange_stiffness,
            flange_gap=self.flange_gap,
            side=self.side,
        )
