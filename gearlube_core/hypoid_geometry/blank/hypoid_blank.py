"""Hypoid gear blank: pitch cones, mean point and tooth direction in the fixed frame of the pair."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.number import Number, check_fields

_METRES = "Give metres, not millimetres."
TEETH, FACE_WIDTH = Number("1", 3, 400), Number("m", 1e-4, 1.0, _METRES)


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberBlank:
    """One member's blank: pitch cone, spiral angle and tooth height data.

    Parameters
    ----------
    teeth : int
        Number of teeth [-].
    face_width, outer_cone_distance : float
        Along the pitch cone generator [m].
    pitch_angle, spiral_angle : float
        Half angle of the pitch cone and mean spiral angle [rad].
    pitch_apex, face_apex : float
        Distance of the apex beyond the crossing point [m]; negative: before it.
    """

    teeth: Annotated[int, TEETH]
    face_width: Annotated[float, FACE_WIDTH]
    outer_cone_distance: Annotated[float, Number("m", 1e-4, 2.0, _METRES)]
    pitch_angle: Annotated[float, Number("rad", 0.01, 1.56, "Give radians.")]
    spiral_angle: Annotated[float, Number("rad", -1.2, 1.2, "Give radians.")]
    pitch_apex: Annotated[float, Number("m", -1.0, 1.0, _METRES)]
    face_apex: Annotated[float, Number("m", -1.0, 1.0, _METRES)]

    def __post_init__(self) -> None:
        check_fields(self)
        if not self.outer_cone_distance > self.face_width:
            raise ParameterError(
                f"outer_cone_distance must exceed face_width {self.face_width:g} m, "
                f"got {self.outer_cone_distance:g} m. Swap them or check the units."
            )

    @property
    def mean_cone_distance(self) -> float:
        """Cone distance at mid-face [m]."""
        return self.outer_cone_distance - 0.5 * self.face_width

    @property
    def mean_pitch_radius(self) -> float:
        """Pitch radius at mid-face [m]."""
        return self.mean_cone_distance * math.sin(self.pitch_angle)

    @property
    def addendum(self) -> float:
        """Addendum of a uniform-depth blank [m]: (face apex - pitch apex) sin(pitch angle)."""
        return (self.face_apex - self.pitch_apex) * math.sin(self.pitch_angle)


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidBlank:
    """Blank of a hypoid pair with perpendicular axes, and its geometry at the mean point.

    Frame (see docs/conventions.md): origin at the crossing point on the gear axis, gear axis = z
    with the gear body towards +z, pinion axis parallel to x at y = +offset, pinion body towards +x.

    Parameters
    ----------
    pinion, gear : MemberBlank
    offset : float
        Distance of the axes [m].
    name, source : str
        Where the data come from.
    clearance : float, optional
        Bottom clearance [m]; neither table prints it. Without it `root_clearance` completes it.

    References
    ----------
    [mohammadpour_2015 Table A1]; [karagiannis_2012 Table 1].
    """

    pinion: MemberBlank
    gear: MemberBlank
    offset: Annotated[float, Number("m", 0.0, 0.5, _METRES)]
    name: str
    source: str
    clearance: float | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        if self.clearance is not None:
            check_within("clearance", self.clearance, 0.0, self.working_depth, "m", _METRES)

    @property
    def ratio(self) -> float:
        """Teeth ratio gear / pinion [-]; the final drive ratio."""
        return self.gear.teeth / self.pinion.teeth

    @property
    def working_depth(self) -> float:
        """Sum of the addenda of a uniform-depth blank [m]."""
        return self.pinion.addendum + self.gear.addendum

    @property
    def root_clearance(self) -> float:
        """Bottom clearance [m]: as given, else completed as 0.125 of the working depth.

        0.125 is the clearance factor k_c of [iso_23509 annex C] (its samples F.2 to F.4).
        """
        return 0.125 * self.working_depth if self.clearance is None else self.clearance

    @property
    def whole_depth(self) -> float:
        """Working depth and clearance [m]; the same for both members of a uniform-depth pair."""
        return self.working_depth + self.root_clearance

    @property
    def pinion_dedendum(self) -> float:
        """Dedendum of the pinion [m]: the gear's addendum and the clearance."""
        return self.gear.addendum + self.root_clearance

    @property
    def gear_dedendum(self) -> float:
        """Dedendum of the gear [m]: the pinion's addendum and the clearance."""
        return self.pinion.addendum + self.root_clearance

    @property
    def mean_normal_module(self) -> float:
        """Normal module at mid-face of the gear [m]."""
        return (
            2.0 * self.gear.mean_pitch_radius * math.cos(self.gear.spiral_angle) / self.gear.teeth
        )

    @property
    def pinion_axis(self) -> Array:
        """Unit vector of positive (driving) pinion rotation, shape (3,)."""
        return np.array([-1.0, 0.0, 0.0])

    @property
    def gear_axis(self) -> Array:
        """Unit vector of positive (driven) gear rotation, shape (3,)."""
        return np.array([0.0, 0.0, 1.0])

    @property
    def pinion_apex(self) -> Array:
        """Apex of the pinion's pitch cone [m], shape (3,)."""
        return np.array([-self.pinion.pitch_apex, self.offset, 0.0])

    @property
    def gear_apex(self) -> Array:
        """Apex of the gear's pitch cone [m], shape (3,)."""
        return np.array([0.0, 0.0, -self.gear.pitch_apex])

    def mean_point(self) -> Array:
        """Return the mid-face point of the gear pitch cone where the pinion's cone touches it.

        The common normal of two touching cones meets both axes: the gear cone normal leaves its
        axis at z_n = z + r tan(pitch angle) and must reach the pinion axis (y = offset, z = 0).

        Returns
        -------
        ndarray of shape (3,) [m]
        """
        delta = self.gear.pitch_angle
        r = self.gear.mean_pitch_radius
        z = self.gear_apex[2] + self.gear.mean_cone_distance * math.cos(delta)
        z_normal = z + r * math.tan(delta)
        sine = self.offset * math.tan(delta) / z_normal
        check_within("offset tan(gear pitch angle) / z_n", sine, -1.0, 1.0, cure="Reduce offset.")
        theta = math.asin(sine)
        return np.array([r * math.cos(theta), r * math.sin(theta), z])

    def pitch_normal(self) -> Array:
        """Return the unit normal of the pitch plane at the mean point, from gear root to tip."""
        generator = self.gear_generator()
        outward = np.cross(np.cross(self.gear_axis, self.mean_point()), generator)
        return outward / np.linalg.norm(outward)

    def gear_generator(self) -> Array:
        """Return the unit vector along the gear's pitch cone, apex to mean point, shape (3,)."""
        line = self.mean_point() - self.gear_apex
        return line / np.linalg.norm(line)
