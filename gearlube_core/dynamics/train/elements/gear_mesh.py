"""Mesh of two gears of any kind, from few numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.train.element import Listed
from gearlube_core.dynamics.train.elements.gear_mesh_kernels import GearMeshKernels, Line, Member
from gearlube_core.dynamics.train.elements.orbit import check_distance
from gearlube_core.dynamics.train.gear_geometry import (
    PitchPoint,
    Vector,
    fitting_angle,
    planets_fit,
)
from gearlube_core.dynamics.train.gear_pair import AZIMUTH, GearPair, worded
from gearlube_core.dynamics.train.part import GROUND, AxisPlace, Body, Element
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_body import BACKLASH
from gearlube_core.number import Number, Output

_SAME = 1e-6  # relative, of numbers of one gear in two meshes
_PHASE = 0.01  # of a mesh cycle, as in `planets_fit`
_ROUNDING = 1e-7  # rad
_ROUNDED = 1e-3  # of a mean of numbers written with four digits


class _Wheel(NamedTuple):
    """Key that separates the gears of a body, and the hand."""

    body: str
    teeth: int
    arm: float  # [m]
    right_hand: bool


@dataclass(frozen=True, kw_only=True)
class GearMesh(GearPair, Element):
    """Mesh of two gears on any two bodies: spur, helical, internal, bevel, hypoid.

    The line of action follows from the pitch point, the load from stations across the face: tilt
    of the bodies moves it along the face. Each flank has its own direction, load and phase.

    Parameters beside those of `GearPair`
    -------------------------------------
    name, first, second : str
        Of the mesh, and of the bodies with gear 1, which is external, and gear 2.
    carrier : str
        Body with which the pitch point turns, as around a sun; `ground` where it stands.
    stations : int
        Across the face.
    stiffness : float, optional
        Mean along the normal of the teeth [N/m]; default: `iso_stiffness` of the pair.
    stiffness_waves : tuple of float
        Cosine and sine of each harmonic of the stiffness over its mean, in turn.
    station_stiffness : tuple of tuple of float
        That of each station over the mean of all, a row over a mesh cycle; instead of waves.
    gap : tuple of tuple of float
        Unloaded gap [m] of each station, from low z or the apex on, or of all: one number, or a row
        over a mesh cycle. Gear errors and modifications belong here, deflections do not.
    damping : float
        While teeth touch, along their normal [N s/m].
    backlash : float
        Normal, the whole gap [m].
    friction : float
        Coefficient of all sliding [-].
    keyed_angle : float
        Of a tooth of gear 1 at the start, from x towards y [rad]; it sets the phase of the mesh.
    tooth_thickness : float
        Share of the pitch of gear 1 on the working pitch circle [-].
    steps_per_mesh_period : float
        Integrator steps, where stiffness or gap change.

    Notes
    -----
    The mesh cycle of a flank begins where that of gear 1 passes the pitch point. The same tables
    serve both flanks, each in the sense in which it meshes when it drives.
    Friction acts at a mean distance from the pitch point, as in the tooth loss factor of
    ISO/TR 14179-2, and along the teeth.

    Examples
    --------
    >>> mesh = GearMesh(name="mesh", first="pinion", second="wheel", teeth_1=20, teeth_2=40,
    ...                 normal_module=5e-3, face_width=0.05, backlash=1e-4)
    >>> round(1e-6 * mesh.numbers().stiffness)  # N/um
    961
    """

    name: str
    first: str
    second: str
    carrier: str = GROUND
    stations: Annotated[int, Number("1", 1, 99, text="Stations across the face")] = 1
    stiffness: Annotated[
        float | None,
        Number(
            "N/m", 1e3, 1e13, text="Mean normal stiffness; left out: that of ISO 6336-1",
            shown="N/um",
        ),
    ] = None  # fmt: skip
    stiffness_waves: tuple[float, ...] = ()
    station_stiffness: tuple[tuple[float, ...], ...] = ()
    gap: tuple[tuple[float, ...], ...] = ()
    damping: Annotated[float, Number("N.s/m", 0.0, 1e9, text="Damping while teeth touch")] = 0.0
    backlash: Annotated[float, BACKLASH._replace(text="Normal backlash, the whole gap", shown="um")]
    friction: Annotated[float, Number("1", 0.0, 0.5, text="Coefficient of friction")] = 0.0
    keyed_angle: Annotated[
        float, worded(AZIMUTH, "Angle of a tooth of gear 1 at the start, x towards y")
    ] = 0.0
    tooth_thickness: Annotated[
        float, Number("1", 0.2, 0.8, text="Tooth over pitch of gear 1, on the pitch circle")
    ] = 0.5
    steps_per_mesh_period: Annotated[
        float, Number("1", 4.0, 4096.0, text="Integrator steps, where stiffness or gap change")
    ] = 24.0
    kind: ClassVar = "gear_mesh"
    interpreted: ClassVar = (Listed(GearMeshKernels, (), 8),)
    on: ClassVar = ("first", "second", "carrier")
    states: ClassVar = (
        Output("rotation", "m", "approach of the drive flanks by rotation", 1e-5, "um"),
    )
    losses: ClassVar = ("friction", "mesh_damping")
    outputs: ClassVar = (
        Output("dte", "m", "dynamic transmission error along the normal", 1e-5, "um"),
        Output("stiffness", "N/m", "mesh stiffness", 1e8),
        Output("separated", "1", "1 while no flanks touch"),
        Output("coast_contact", "1", "1 while coast flanks touch"),
        Output("frequency", "Hz", "mesh frequency", 1e3),
        Output("friction", "W", "power lost in friction now", 100.0),
        Output("load", "N", "normal load of the drive flanks less that of the coast flanks", 1e3),
        *(Output(f"force.{c}", "N", f"force along {c} on gear 1", 1e3) for c in "xyz"),
        Output("tilt", "rad", "misalignment of the flanks, gear 1 against gear 2", 1e-5),
        Output("share.low", "1", "load of the first station over the mean of all"),
        Output("share.high", "1", "load of the last station over the mean of all"),
    )
    events: ClassVar = (
        Output("event.drive_flank", "1", "deflection of the drive flanks over 1 um"),
        Output("event.coast_flank", "1", "deflection of the coast flanks over 1 um"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.stiffness_waves) % 2:
            raise ParameterError(
                f"stiffness_waves of {self.name} must have a cosine and a sine of each harmonic, "
                f"got {len(self.stiffness_waves)} numbers. Give 0 for the one that is not there."
            )
        swing = sum(map(abs, self.stiffness_waves))
        check_within(f"sum of stiffness_waves of {self.name}", swing, 0.0, 0.95)
        self._check_station_stiffness()
        if len(self.gap) not in (0, 1, self.stations) or not all(self.gap):
            raise ParameterError(
                f"gap of {self.name} must have one row, or one for each of the {self.stations} "
                f"stations, with at least one number each; got {len(self.gap)} rows."
            )
        for row in self.gap:
            for one in row:
                check_within(f"gap of {self.name}", one, -1e-2, 1e-2, "m", "100 um is 1e-4 m.")
        for wrong, what in (
            (self.carrier != GROUND and not self.parallel, "a carrier"),
            (self.stations > 1 and self.offset, "more than one station"),
        ):
            if wrong:
                raise ParameterError(
                    f"{self.name} has axes that are not parallel, or offset, for which {what} is "
                    "not possible. Leave it out."
                )

    def _check_station_stiffness(self) -> None:
        """Raise ParameterError unless the stations have rows whose mean is 1, or none."""
        rows = self.station_stiffness
        if not rows:
            return
        if self.stiffness_waves or len(rows) != self.stations or not all(rows):
            raise ParameterError(
                f"station_stiffness of {self.name} must have a row for each of the {self.stations} "
                f"stations, with at least one number each, and no stiffness_waves beside it; got "
                f"{len(rows)} rows. Leave one of both out."
            )
        for one in (number for row in rows for number in row):
            check_within(f"station_stiffness of {self.name}", one, -1e3, 1e3)
        means = [sum(row) / len(row) for row in rows]
        check_within(f"least mean of station_stiffness of {self.name}", min(means), 0.0, 1e3)
        mean = sum(means) / len(means)
        check_within(
            f"mean of station_stiffness of {self.name}", mean, 1.0 - _ROUNDED, 1 + _ROUNDED
        )

    def steady(self) -> GearMesh:
        """Return the mesh with the mean stiffness of each station."""
        means = tuple((sum(row) / len(row),) for row in self.station_stiffness)
        return replace(self, stiffness_waves=(), station_stiffness=means)

    def sizes(self) -> tuple[int, ...]:
        """Return the numbers of stations and of harmonics."""
        return self.stations, self._waves()

    def _waves(self) -> int:
        longest = max((len(row) for row in (*self.gap, *self.station_stiffness)), default=1)
        return max(len(self.stiffness_waves) // 2, longest // 2)

    def numbers(self) -> GearMeshKernels:
        """Return the constants of the kernels."""
        one, two = (_member(point) for point in self.pitch_points())
        s = 1.0 if self.drives_forward else -1.0
        turned = self.teeth_1 * (self.keyed_angle - self.azimuth)
        thick = math.pi * self.tooth_thickness
        return GearMeshKernels(
            one,
            two,
            one.drive.m_z / one.drive.h_z,
            self.iso_stiffness if self.stiffness is None else float(self.stiffness),
            float(self.damping),
            float(self.backlash),
            float(self.friction),
            self.sliding_arm,
            s * self.teeth_1,
            s * turned + thick,
            -s * turned + thick,
            float(self.steps_per_mesh_period),
        )

    def memory(self) -> Array:
        """Return places of the stations, then their stiffness and gaps with their waves."""
        n, waves = self.stations, self._waves()
        places = (np.arange(n) + 0.5 - 0.5 * n) * self.face_width / n
        stiffness = [_series(row, waves) for row in self.station_stiffness]
        if not stiffness:
            alike = _series((1.0,), waves)
            alike[1 : 1 + len(self.stiffness_waves)] = self.stiffness_waves
            stiffness = n * [alike]
        rows = self.gap if len(self.gap) == n else n * (self.gap or ((0.0,),))
        return np.concatenate([places, *stiffness, *(_series(row, waves) for row in rows)])

    def between_axes(self) -> list[AxisPlace]:
        """Return the bodies of gears on parallel axes that stand, and where gear 2 is."""
        stands = self.parallel and self.carrier == GROUND
        return [AxisPlace(self.first, self.second, self.centres)] if stands else []

    def fits(self, bodies: Sequence[Body], elements: Sequence[Element]) -> None:
        """Raise ParameterError where gears of the train do not fit each other.

        Meshes that share a gear must agree about it, gears on a carrier must touch, and planets of
        one sun and ring must fit between their teeth.
        """
        others = [one for one in elements if isinstance(one, GearMesh) and one is not self]
        shared = [
            (other, mine, its)
            for other in others
            for mine in self._wheels()
            for its in other._wheels()
            if mine[:3] == its[:3]
        ]
        for other, mine, its in shared:
            self._check_shared(other, mine, its)
        if self.carrier != GROUND:
            check_distance(elements, self.name, self.first, self.second, self.carrier, self.centres)
        planets = [self, *(other for other in others if self._beside(other))]
        if self.ring and len(planets) > 1:
            self._check_planets(planets, others)

    def _check_shared(self, other: GearMesh, mine: _Wheel, its: _Wheel) -> None:
        """Raise ParameterError unless one gear is the same in two meshes."""
        gear = f"the gear of {mine.body} with {mine.teeth} teeth"
        degree = math.degrees(1.0)
        for what, unit, scale in (
            ("normal_module", "mm", 1e3), ("normal_pressure_angle", "deg", degree),
            ("helix_angle", "deg", degree),
        ):  # fmt: skip
            one, another = scale * getattr(self, what), scale * getattr(other, what)
            if not math.isclose(one, another, rel_tol=_SAME):
                raise ParameterError(
                    f"{gear} must have one {what}, got {one:g} {unit} in {self.name} and "
                    f"{another:g} {unit} in {other.name}. Correct one, or give the arms of two "
                    "gears."
                )
        if self.helix_angle > 0.0 and mine.right_hand != its.right_hand:
            raise ParameterError(
                f"{gear} must have one hand, got both, in {self.name} and {other.name}. Correct "
                "right_hand."
            )
        if self.parallel and other.parallel and self._waves() and other._waves():
            self._check_teeth(other, gear, mine)

    def _check_teeth(self, other: GearMesh, gear: str, wheel: _Wheel) -> None:
        """Raise ParameterError unless one gear has its teeth at the same angle in two meshes."""
        pitch = 2.0 * math.pi / wheel.teeth
        mine, its = (one._tooth_angle(wheel.body) for one in (self, other))
        turned = (mine - its + 0.5 * pitch) % pitch - 0.5 * pitch
        if abs(turned) <= _PHASE * pitch:
            return
        gain = (1.0 if other.ring else -1.0) * wheel.teeth / other.teeth_1
        keyed = other.keyed_angle + turned * (1.0 if other.first == wheel.body else gain)
        mine, its = _degrees(mine, wheel.teeth), _degrees(its, wheel.teeth)
        raise ParameterError(
            f"{gear} must have its teeth at one angle, got {mine:.6g} deg in {self.name} and "
            f"{its:.6g} deg in {other.name}, {math.degrees(abs(turned)):.4g} deg apart of a pitch "
            f"of {math.degrees(pitch):.4g} deg: the phases of these meshes contradict each other. "
            f"Give {other.name} a keyed_angle of {_degrees(keyed, other.teeth_1):.8g} deg, in a "
            "train file keyed_angle_deg."
        )

    def _tooth_angle(self, body: str) -> float:
        """Return the angle of a tooth of the gear on a body at the start [rad]."""
        if self.first == body:
            return self.keyed_angle
        return fitting_angle(
            self.teeth_1, self.teeth_2, self.keyed_angle, self.azimuth, internal=self.ring,
            second_azimuth=self.azimuth_2,
        )  # fmt: skip

    def _beside(self, other: GearMesh) -> bool:
        """Return whether another mesh has the same ring, or sun, on the same carrier."""
        return (self.ring, self.second, self.carrier) == (other.ring, other.second, other.carrier)

    def _check_planets(self, rings: Sequence[GearMesh], others: Sequence[GearMesh]) -> None:
        """Raise ParameterError unless all planets of this ring's fit its sun too."""
        for ring in rings[1:]:
            for sun in others:
                if sun.ring or sun.second != ring.first or sun.carrier != ring.carrier:
                    continue
                if not any(
                    (one.first, one.second) == (sun.first, self.first)
                    for one in others
                    if not one.ring
                ):
                    continue
                if not planets_fit(sun.teeth_1, self.teeth_2, (self.azimuth, ring.azimuth)):
                    apart = math.degrees(ring.azimuth - self.azimuth) % 360.0
                    step = 360.0 / (sun.teeth_1 + self.teeth_2)
                    raise ParameterError(
                        f"planets {self.first} and {ring.first} must stand a multiple of "
                        f"{step:.6g} deg apart, 360 deg over the {sun.teeth_1} + {self.teeth_2} "
                        f"teeth of {sun.first} and {self.second}, got {apart:.6g} deg: their teeth "
                        "do not fit. Correct an azimuth or the numbers of teeth."
                    )

    def _wheels(self) -> tuple[_Wheel, _Wheel]:
        return (
            _Wheel(self.first, self.teeth_1, self.arm_1, self.right_hand),
            _Wheel(self.second, self.teeth_2, self.arm_2, self.right_hand == self.ring),
        )


def _member(point: PitchPoint) -> Member:
    r, e, t = point.place, point.along_face, point.along_tooth
    drive, coast = (
        Line(*_floats(n, np.cross(r, n), np.cross(e, n))) for n in (point.drive, point.coast)
    )
    return Member(drive, coast, Line(*_floats(t, np.cross(r, t), e)))


def _degrees(angle: float, teeth: int) -> float:
    """Return an angle below one pitch [deg]; a whole pitch, but for rounding, is 0."""
    return round(math.degrees((angle + _ROUNDING) % (2.0 * math.pi / teeth) - _ROUNDING), 6) + 0.0


def _floats(*vectors: Vector) -> list[float]:
    return [float(one) + 0.0 for vector in vectors for one in vector]


def _series(row: Sequence[float], waves: int) -> Array:
    """Return mean and waves of numbers at equal distances over a cycle, shape (1 + 2 waves,)."""
    found, n = np.zeros(1 + 2 * waves), len(row)
    spectrum = np.fft.rfft(row) / n
    found[0] = spectrum[0].real
    for j in range(1, spectrum.size):
        twice = 1.0 if 2 * j == n else 2.0
        found[2 * j - 1], found[2 * j] = twice * spectrum[j].real, -twice * spectrum[j].imag
    return found
