"""Geometry of a bevel or hypoid pair for its rating, and its virtual cylindrical gears."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Literal, NamedTuple

from gearlube_core.checks import check_within
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.blank.pitch_cones import PitchCones
from gearlube_core.number import Checked, Number, Positive
from gearlube_core.rating.pairs import MM, Pair, both

_METRES = "Give metres, not millimetres."


@dataclass(frozen=True, kw_only=True)
class BevelMesh(Checked):
    """Geometry of a bevel or hypoid pair that a rating needs, in the terms of ISO 23509.

    Parameters
    ----------
    cones, face_width
        Pitch cones at the mean point; b2, of the gear.
    addendum, dedendum
        h_am, h_fm of pinion and gear at mid-face [m].
    effective_angle
        alpha_e of this flank; its pressure angle is that of the blades beside the limit pressure
        angle.
    thickness_shift, tool_radius
        x_sm of pinion and gear; rho_a0 of the cutters' edges, in normal modules [-].
    cutter_radius, effective_width
        r_c0; None: not known, K_F0 is 1. Share of the face in contact; solved, or 0.85.
    flank
        "drive" or "coast". Coast takes the formulas with the other sign of the limit pressure
        angle, which is not checked against the source.
    profile_crowning
        Profile crowning: "low" or "high".

    Examples
    --------
    >>> import gearlube as gl
    >>> mesh = gl.rating.BevelMesh.of_blank(gl.HypoidGearFile.named("mohammadpour_2015").blank())
    >>> round(mesh.virtual.contact_ratio, 2), round(mesh.addendum_shift, 2)
    (1.13, 0.49)
    """

    cones: PitchCones
    face_width: Annotated[float, Positive("m", _METRES)]
    addendum: Pair
    dedendum: Pair
    effective_angle: Annotated[float, Number("rad", 0.1, 0.8, "20 deg is 0.349 rad.")] = 0.349066
    thickness_shift: Pair = (0.0, 0.0)
    tool_radius: Pair = (0.25, 0.25)
    cutter_radius: Annotated[float | None, Positive("m", "Give metres.")] = None
    effective_width: Annotated[float, Number("1", 0.3, 1.0, "0.85 if not known.")] = 0.85
    flank: Literal["drive", "coast"] = "drive"
    profile_crowning: Literal["low", "high"] = "low"

    def __post_init__(self) -> None:
        Checked.__post_init__(self)
        for name, heights in (("addendum", self.addendum), ("dedendum", self.dedendum)):
            for role, height in zip(("pinion", "gear"), heights, strict=True):
                what = f"{name} of the {role} in normal modules"
                check_within(what, height / self.cones.normal_module, 0.0, 4.0, "", _METRES)

    @classmethod
    def of_blank(cls, blank: HypoidBlank, **given: Any) -> BevelMesh:
        """Return the mesh of a blank with perpendicular axes; other fields as given."""
        pinion, gear = blank.pinion, blank.gear
        cones = PitchCones(
            pinion_teeth=pinion.teeth, gear_teeth=gear.teeth, offset=blank.offset,
            shaft_angle=0.5 * math.pi,
            pinion_pitch_angle=pinion.pitch_angle, gear_pitch_angle=gear.pitch_angle,
            pinion_mean_cone_distance=pinion.mean_cone_distance,
            gear_mean_cone_distance=gear.mean_cone_distance,
            pinion_spiral_angle=abs(pinion.spiral_angle),
            gear_spiral_angle=abs(gear.spiral_angle),
        )  # fmt: skip
        return cls(**{
            "cones": cones, "face_width": gear.face_width,
            "addendum": (pinion.addendum, gear.addendum),
            "dedendum": (blank.pinion_dedendum, blank.gear_dedendum), **given,
        })  # fmt: skip

    @property
    def limit_angle(self) -> float:
        """alpha_lim as this flank sees it [rad]."""
        return self.cones.limit_pressure_angle * (1.0 if self.flank == "drive" else -1.0)

    @property
    def pressure_angle(self) -> float:
        """alpha_n of this flank [rad]."""
        return self.effective_angle + self.limit_angle

    @property
    def addendum_shift(self) -> float:
        """x_hm of the pinion [-], by the addenda."""
        return 0.5 * (self.addendum[0] - self.addendum[1]) / self.cones.normal_module

    @property
    def diameters(self) -> Pair:
        """d_m of pinion and gear [mm]."""
        return 2.0 * MM * self.cones.pinion_pitch_radius, 2.0 * MM * self.cones.gear_pitch_radius

    @property
    def spirals(self) -> Pair:
        """beta_m of pinion and gear [rad]."""
        return self.cones.pinion_spiral_angle, self.cones.gear_spiral_angle

    @cached_property
    def virtual(self) -> VirtualGears:
        """Virtual cylindrical gears and their contact lines; source [iso_10300_1]."""
        c, module = self.cones, MM * self.cones.normal_module
        deltas = c.pinion_pitch_angle, c.gear_pitch_angle
        beta = 0.5 * sum(self.spirals)
        alpha = math.atan(math.tan(self.effective_angle) / math.cos(beta))
        base = math.asin(math.sin(beta) * math.cos(self.effective_angle))
        d = both(lambda one, delta: one / math.cos(delta), self.diameters, deltas)
        d_a = both(lambda one, h: one + 2.0 * MM * h, d, self.addendum)
        pitch = math.pi * module * math.cos(alpha) / math.cos(beta)
        reach = both(lambda a, e: math.sqrt(a * a - (e * math.cos(alpha)) ** 2), d_a, d)
        path = 0.5 * (sum(reach) - sum(d) * math.sin(alpha))
        # width in contact, in the plane of the virtual gears
        half = 0.5 * c.offset_angle
        skew = math.tan(math.atan(math.sin(deltas[1]) * math.tan(c.axial_offset_angle)) - half)
        width = MM * self.face_width * self.effective_width / math.cos(half)
        width = (width - path * math.cos(alpha) * math.tan(half)) / (1.0 - skew * math.tan(half))
        check_within(
            "contact width of the virtual gears", width, 1e-2, 1e5, "mm", "Widen the face."
        )
        overlap = width * math.sin(beta) / (math.pi * module)
        length, sharing = _contact_lines(
            self, base, skew / math.cos(alpha), width, path, pitch, overlap
        )
        tangent = math.tan(beta) * math.sin(self.effective_angle)
        radii = c.pinion_mean_cone_distance, c.gear_mean_cone_distance
        curved = sum(both(lambda R, delta: 1.0 / (MM * R * math.tan(delta)), radii, deltas))
        curved *= math.cos(self.spirals[0]) * math.cos(self.spirals[1]) / math.cos(c.offset_angle)
        lift = math.tan(self.pressure_angle) - math.tan(self.limit_angle)
        lift = math.cos(self.pressure_angle) * lift + math.tan(c.offset_angle) * tangent
        return VirtualGears(
            module, beta, base, alpha, d, d_a, both(lambda one: one * math.cos(beta) / module, d),
            path / pitch, overlap, width / self.effective_width, length, sharing, tangent,
            abs(lift / curved) / (1.0 + tangent**2),
        )  # fmt: skip


class VirtualGears(NamedTuple):
    """Virtual cylindrical gears of method B1; mm, rad."""

    module: float  # normal
    helix: float
    base_helix: float
    transverse_angle: float
    diameter: Pair
    tip_diameter: Pair
    teeth: Pair
    contact_ratio: float
    overlap_ratio: float
    face_width: float
    line_length: float  # of the middle contact line
    sharing: float  # Z_LS
    line_tangent: float  # of the contact line's inclination in the pitch plane
    radius: float  # relative, normal to the contact line


def _contact_lines(
    g: BevelMesh, base: float, shear: float, width: float, path: float, pitch: float, overlap: float
) -> tuple[float, float]:
    """Return the length of the middle contact line [mm] and Z_LS.

    Lines at tip, middle and root stand pitch cos(base) apart and are cut off where the zone of
    action ends; their ends bear less where the face is wider than the contact.
    """
    lean, cos = math.tan(base), math.cos(base)
    slope = shear + lean
    largest = 0.5 * cos * (path + width * abs(slope))

    def line(f: float) -> float:
        middle = f * cos + lean * (f * math.sin(base) + 0.5 * width)
        if abs(slope) < 1e-9:  # straight bevel gears: lines along the face
            bare = width if abs(f) < 0.5 * path else 0.0
        else:
            first = (middle + 0.5 * (path + width * shear)) / slope
            last = (middle - 0.5 * (path - width * shear)) / slope
            bare = abs(min(max(first, 0.0), width) - min(max(last, 0.0), width)) / cos
        inner = math.sqrt(max(1.0 - (f / largest) ** 2, 0.0))
        return bare * (1.0 - inner * (1.0 - math.sqrt(g.effective_width)))

    late = (pitch - 0.5 * path) * cos * max(1.0 - overlap, 0.0)
    power = 3.0 if g.profile_crowning == "low" else 1.5
    places = (pitch * cos - late, -late, -pitch * cos - late)
    areas = [max(line(f) * (1.0 - abs(f / largest) ** power), 0.0) for f in places]
    return line(-late), math.sqrt(areas[1] / sum(areas))
