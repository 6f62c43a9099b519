"""Two gears of any kind that mesh, from few numbers."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Annotated

from gearlube_core.dynamics.train.gear_geometry import (
    Gear,
    PitchPoint,
    contact_ratio,
    pitch_points,
    working_pitch,
)
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_body import POSITION
from gearlube_core.helical_geometry.iso_6336_stiffness import mesh_stiffness_of_teeth
from gearlube_core.number import Number, check_fields

_METRES = "Give metres, not millimetres."
_TEETH = Number("1", 3, 10_000)
_HELIX = Number("rad", 0.0, math.radians(60.0), "Give radians.", shown="deg")
_CONE = Number("rad", 0.0, math.radians(89.0), "Give radians.", shown="deg")
_ARM = POSITION._replace(shown="mm")
AZIMUTH = Number("rad", -2.0 * math.pi, 2.0 * math.pi, "Give radians.", shown="deg")


def worded(number: Number, text: str, shown: str = "") -> Number:
    """Return a number with what it is and, where another one, the unit in files."""
    return number._replace(text=text, shown=shown or number.shown)


@dataclass(frozen=True, kw_only=True)
class GearPair:
    """Spur, helical, internal, bevel or hypoid gears.

    Parameters
    ----------
    name : str
    teeth_1, teeth_2 : int
        Gear 1 is external.
    normal_module : float
        [m], of bevel gears at mid-face.
    face_width : float
        [m]
    normal_pressure_angle, helix_angle : float
        [rad], of bevel gears the mean spiral angle of gear 1.
    helix_angle_2 : float, optional
        Where gear 2 has another one, as of hypoid gears [rad].
    right_hand : bool
        Whether gear 1 is right-handed; an external gear 2 is then left-handed, a ring not.
    ring : bool
        Whether gear 2 is internal.
    drives_forward : bool
        Whether the drive flank of gear 1 pushes with rotation about +z.
    cone_angle_1, cone_angle_2 : float
        Pitch cone angles of bevel gears, whose axes z lead from the apex to the heel [rad].
    centre_distance : float, optional
        Of gears on parallel axes with profile shift [m].
    azimuth : float
        Of the pitch point on gear 1, from x towards y [rad].
    azimuth_2 : float, optional
        The same on gear 2, in the axes of its body; default: opposite, on a ring the same [rad].
    arm_1, arm_2 : float
        Mid-face along z from the centre of each body [m].

    Notes
    -----
    Directions, hand and azimuth: docs/conventions.md. Mean cone angles and spiral angles of both
    gears fix shaft angle and offset of hypoid gears.

    Examples
    --------
    >>> pair = GearPair(name="pair", teeth_1=20, teeth_2=40, normal_module=5e-3, face_width=0.05)
    >>> pair.radii, round(pair.contact_ratio, 3), round(1e-6 * pair.iso_stiffness)  # m; N/um
    ((0.05, 0.1), 1.635, 961)
    """

    name: str
    teeth_1: Annotated[int, worded(_TEETH, "Teeth of gear 1")]
    teeth_2: Annotated[int, worded(_TEETH, "Teeth of gear 2")]
    normal_module: Annotated[
        float, Number("m", 1e-4, 1.0, _METRES, text="Normal module, at mid-face", shown="mm")
    ]
    face_width: Annotated[
        float, Number("m", 1e-4, 10.0, _METRES, text="Common face width", shown="mm")
    ]
    normal_pressure_angle: Annotated[
        float,
        Number(
            "rad", math.radians(10.0), math.radians(35.0), "Give radians.",
            text="Normal pressure angle", shown="deg",
        ),
    ] = math.radians(20.0)  # fmt: skip
    helix_angle: Annotated[
        float,
        worded(_HELIX, "Helix angle, or mean spiral angle of gear 1"),
    ] = 0.0
    helix_angle_2: Annotated[
        float | None,
        worded(_HELIX, "That of gear 2, as of hypoid gears; left out: the same"),
    ] = None
    right_hand: bool = False
    ring: bool = False
    drives_forward: bool = True
    cone_angle_1: Annotated[float, worded(_CONE, "Pitch cone angle of gear 1")] = 0.0
    cone_angle_2: Annotated[float, worded(_CONE, "Pitch cone angle of gear 2")] = 0.0
    centre_distance: Annotated[
        float | None,
        Number(
            "m", 1e-3, 10.0, _METRES,
            text="Working centre distance; left out: that without profile shift", shown="mm",
        ),
    ] = None  # fmt: skip
    azimuth: Annotated[
        float, worded(AZIMUTH, "Direction from the axis of gear 1 to the pitch point, x towards y")
    ] = 0.0
    azimuth_2: Annotated[
        float | None,
        worded(AZIMUTH, "That from the axis of gear 2; left out: opposite, for a ring the same"),
    ] = None
    arm_1: Annotated[float, worded(_ARM, "Mid-face along z, from the centre of body 1")] = 0.0
    arm_2: Annotated[float, worded(_ARM, "Mid-face along z, from the centre of body 2")] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        for given, what in ((self.ring, "ring"), (self.centre_distance, "centre_distance")):
            if given and not self.parallel:
                raise ParameterError(
                    f"{self.name} must not have {what} beside cone angles or helix_angle_2, which "
                    "cross the axes. Leave one out."
                )
        if self.ring and self.teeth_2 <= self.teeth_1:
            raise ParameterError(
                f"teeth_2 of {self.name}, a ring, must be above the {self.teeth_1} teeth of gear "
                f"1, got {self.teeth_2}. Gear 1 is the one inside."
            )
        self._working()

    @property
    def parallel(self) -> bool:
        """Whether the axes are parallel."""
        same = self.helix_angle_2 in (None, self.helix_angle)
        return same and self.cone_angle_1 == self.cone_angle_2 == 0.0

    @property
    def offset(self) -> bool:
        """Whether the axes are neither parallel nor meet in a point."""
        return self.helix_angle_2 not in (None, self.helix_angle)

    @property
    def radii(self) -> tuple[float, float]:
        """Radii of the working pitch circles at mid-face [m]."""
        first, second, _ = self._working()
        return first.radius, second.radius

    @property
    def centres(self) -> complex:
        """Place of the axis of gear 2 against that of gear 1, of parallel axes, x + i y [m]."""
        first, second = self.radii
        return cmath.rect(first - second if self.ring else first + second, self.azimuth)

    @property
    def contact_ratio(self) -> float:
        """Transverse contact ratio of teeth with addenda of one module, without shift [-]."""
        first, second = self._reference()
        return contact_ratio(
            first, second, self.normal_module, self.normal_pressure_angle, internal=self.ring
        )

    @property
    def iso_stiffness(self) -> float:
        """Mean stiffness along the normal of the teeth [N/m], see `mesh_stiffness_of_teeth`."""
        cones = math.cos(self.cone_angle_1), math.cos(self.cone_angle_2)
        teeth = self.teeth_1 / cones[0], math.inf if self.ring else self.teeth_2 / cones[1]
        return self.face_width * mesh_stiffness_of_teeth(
            teeth, self.normal_pressure_angle, self.helix_angle, max(self.contact_ratio, 1.0)
        )

    @property
    def sliding_arm(self) -> float:
        """Mean distance of contact from the pitch point along the path of contact [m].

        p_bt/2 (1 - e + e1^2 + e2^2) with e1 = e2: the tooth loss factor of ISO/TR 14179-2.
        """
        first, _, pressure = self._working()
        tan = math.tan(pressure) / math.cos(first.helix_angle)
        pitch = 2.0 * math.pi * first.radius / self.teeth_1 / math.hypot(1.0, tan)
        e = min(max(self.contact_ratio, 1.0), 2.0)
        return 0.5 * pitch * (1.0 - e + 0.5 * e * e)

    def pitch_points(self) -> tuple[PitchPoint, PitchPoint]:
        """Return the pitch point of both gears with its directions."""
        first, second, pressure = self._working()
        return pitch_points(
            first, second, pressure, right_hand=self.right_hand, forward=self.drives_forward,
            internal=self.ring,
        )  # fmt: skip

    def _reference(self) -> tuple[Gear, Gear]:
        """Return both gears without profile shift."""
        helix = self.helix_angle
        helix_2 = helix if self.helix_angle_2 is None else self.helix_angle_2
        across = self.azimuth if self.ring else self.azimuth + math.pi
        azimuth_2 = across if self.azimuth_2 is None else self.azimuth_2
        half = 0.5 * self.normal_module
        radius_1, radius_2 = half * self.teeth_1 / math.cos(helix), half * self.teeth_2
        return (
            Gear(radius_1, self.azimuth, self.arm_1, helix, self.cone_angle_1),
            Gear(radius_2 / math.cos(helix_2), azimuth_2, self.arm_2, helix_2, self.cone_angle_2),
        )

    def _working(self) -> tuple[Gear, Gear, float]:
        """Return both gears at the pitch point, and the normal pressure angle there [rad]."""
        first, second = self._reference()
        if self.centre_distance is None:
            return first, second, self.normal_pressure_angle
        found = working_pitch(
            self.teeth_1, self.teeth_2, self.normal_module, self.normal_pressure_angle,
            self.helix_angle, self.centre_distance, internal=self.ring,
        )  # fmt: skip
        return (
            first._replace(radius=found.first_radius, helix_angle=found.helix_angle),
            second._replace(radius=found.second_radius, helix_angle=found.helix_angle),
            found.pressure_angle,
        )
