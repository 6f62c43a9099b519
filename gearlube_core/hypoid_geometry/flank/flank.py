"""One flank of one member over its tooth height and face width."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.flank.correction import NO_CORRECTION, Bends, FlankCorrection
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion, cut_state
from gearlube_core.hypoid_geometry.flank.machine_frames import Curve, gear_cut, pinion_cut
from gearlube_core.hypoid_geometry.flank.surface_point import march, regularity, sample_surface
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

Role = Literal["pinion", "gear"]
Side = Literal["drive", "coast"]

# gear convex on pinion concave drives the wheel forward (docs/conventions.md)
CURVES: dict[tuple[Role, Side], Curve] = {
    ("gear", "drive"): "convex",
    ("gear", "coast"): "concave",
    ("pinion", "drive"): "concave",
    ("pinion", "coast"): "convex",
}
_START_GRID = (9, 17)  # stations of the coarse grid that starts every other search


@dataclass(frozen=True, slots=True)
class ToothRegion:
    """Region of a tooth in the axial section of its blank: uniform depth, parallel cones.

    s runs from the root line (0) to the tip (1) over `root_depth` + `addendum`, t from toe (0) to
    heel (1) over the face width.
    """

    inner_cone_distance: float  # m
    outer_cone_distance: float
    pitch_angle: float  # rad
    apex_axial: float  # m, pitch apex along the work axis from the work point
    root_depth: float  # m, root line under the pitch cone
    addendum: float  # m

    @property
    def whole_height(self) -> float:
        """From root line to tip [m]."""
        return self.root_depth + self.addendum

    @property
    def face_width(self) -> float:
        """From toe to heel along the pitch cone [m]."""
        return self.outer_cone_distance - self.inner_cone_distance

    def cone_distance(self, t: Array) -> Array:
        """Return the cone distance [m] at face position t."""
        return self.inner_cone_distance + t * (self.outer_cone_distance - self.inner_cone_distance)

    def height(self, s: Array) -> Array:
        """Return the height over the pitch cone [m] at profile position s."""
        return s * (self.addendum + self.root_depth) - self.root_depth

    def section(self, s: Array, t: Array) -> tuple[Array, Array]:
        """Return radius and axial position [m] at (s, t)."""
        distance, height = self.cone_distance(t), self.height(s)
        sine, cosine = math.sin(self.pitch_angle), math.cos(self.pitch_angle)
        radius = distance * sine + height * cosine
        return radius, self.apex_axial + distance * cosine - height * sine

    def position(self, radius: Array, axial: Array) -> tuple[Array, Array]:
        """Return (s, t) of places in the axial section; outside 0 to 1 beyond the tooth."""
        sine, cosine = math.sin(self.pitch_angle), math.cos(self.pitch_angle)
        axial = axial - self.apex_axial
        distance = radius * sine + axial * cosine
        height = radius * cosine - axial * sine
        width = self.outer_cone_distance - self.inner_cone_distance
        return (height + self.root_depth) / (self.root_depth + self.addendum), (
            distance - self.inner_cone_distance
        ) / width


@dataclass(frozen=True, slots=True)
class FlankSample:
    """A flank at places of shape (...): position, outward normal, curvature.

    Parameters
    ----------
    r, normal, tangent_1, tangent_2 : ndarray of shape (..., 3)
        Point [m] and unit vectors [-] in the fixed frame, member at rotation zero; the normal
        points out of the tooth, tangent_1 follows the blade edge.
    curvature : ndarray of shape (..., 2, 2)
        Shape operator in the tangents [1/m], dn = -K dr.
    regularity : ndarray of shape (...)
        Positive on a sound flank, negative beyond a fold (undercut).
    """

    r: Array
    normal: Array
    tangent_1: Array
    tangent_2: Array
    curvature: Array
    regularity: Array


@dataclass(frozen=True)
class Flank:
    """One flank of one member.

    Parameters
    ----------
    motion : CuttingMotion
    outward : float
        +1 or -1: makes r_u x r_th point out of the tooth.
    start : ndarray of shape (3,)
        u [m], th, ph [rad] where the blade's path passes the mean reference point. On a form-cut
        flank; a generated flank runs a little below, as the point is not a pitch point.
    region : ToothRegion
    role : {"pinion", "gear"}
    side : {"drive", "coast"}
    teeth : int
    correction : FlankCorrection
        Material taken off the surface that the motion cuts. Points, normals and curvatures are
        those of the cut surface; `removal` and `removal_bend` stand beside them.
    """

    motion: CuttingMotion
    outward: float
    start: Array
    region: ToothRegion
    role: Role
    side: Side
    teeth: int
    correction: FlankCorrection = NO_CORRECTION

    @classmethod
    def from_file(cls, file: HypoidGearFile, role: Role, side: Side) -> Flank:
        """Return a flank of a gear file.

        Raises
        ------
        ParameterError
            When the cutter does not reach the tooth; the message says what would.
        """
        flank = cls.as_cut(file, role, side)
        flank._start_grid  # noqa: B018  fails here, with its cure, rather than at first use
        return flank

    @classmethod
    def as_cut(cls, file: HypoidGearFile, role: Role, side: Side) -> Flank:
        """Return a flank as `from_file` does, without a look whether it fills the tooth.

        Three times as quick; good where cutting parameters are known.
        """
        check_option("role", role, ("pinion", "gear"))
        check_option("side", side, ("drive", "coast"))
        curve = CURVES[role, side]
        cut = (pinion_cut if role == "pinion" else gear_cut)(file, curve)
        start = np.array([0.0, cut.cutter_angle, cut.cradle_angle])
        region = tooth_region(file.blank(), role)
        return cls(
            motion=cut.motion,
            outward=_outward(cut.motion, start, curve),
            start=start,
            region=region,
            role=role,
            side=side,
            teeth=(file.pinion if role == "pinion" else file.gear).teeth,
            correction=file.correction(role, side),
        )

    @property
    def axis(self) -> Array:
        """Unit vector of the member's axis, shape (3,)."""
        return np.array(self.motion.work_axis)

    @property
    def axis_point(self) -> Array:
        """Point of the member's axis [m], shape (3,)."""
        return np.array(self.motion.work_point)

    def position(self, r: Array) -> tuple[Array, Array]:
        """Return profile and face position s, t [-] of points (..., 3) [m], rotation zero."""
        r = r - self.axis_point
        axial = r @ self.axis
        radius = np.linalg.norm(r - axial[..., None] * self.axis, axis=-1)
        return self.region.position(radius, axial)

    def removal(self, r: Array) -> Array:
        """Return what corrections take away along the normal [m] at points (..., 3) [m]."""
        if self.correction.is_none:
            return np.zeros(r.shape[:-1])
        return self._bends(r).value

    def removal_slope(self, sample: FlankSample) -> Array:
        """Return the derivatives of the removal along the tangents [-], (..., 2).

        With them the outward normal n becomes n + grad m, but for its length.
        """
        if self.correction.is_none:
            return np.zeros((*sample.r.shape[:-1], 2))
        up, along, _, _ = self._directions(sample.r)
        m = self._bends(sample.r)
        slope = m.by_h[..., None] * up + m.by_l[..., None] * along
        return np.stack(
            [np.einsum("...i,...i->...", slope, t) for t in (sample.tangent_1, sample.tangent_2)],
            axis=-1,
        )

    def _bends(self, r: Array) -> Bends:
        region = self.region
        return self.correction.bends(*self.position(r), region.whole_height, region.face_width)

    def _directions(self, r: Array) -> tuple[Array, Array, Array, Array]:
        """Return unit vectors up the tooth, along the pitch cone, around the axis; the radius."""
        own = r - self.axis_point
        radial = own - (own @ self.axis)[..., None] * self.axis
        radius = np.linalg.norm(radial, axis=-1)
        radial = radial / radius[..., None]
        sine, cosine = math.sin(self.region.pitch_angle), math.cos(self.region.pitch_angle)
        up, along = cosine * radial - sine * self.axis, sine * radial + cosine * self.axis
        return up, along, np.cross(self.axis, radial), radius

    def removal_bend(self, sample: FlankSample) -> Array:
        """Return the second derivatives of the removal in the tangents [1/m], (..., 2, 2).

        They add to the curvature of the gap, as -K does. With heights h and face positions l as
        functions of the place, and the cut surface's own curvature K:
        m_ij = m_ab d_i a d_j b + m_a d_i d_j a + (grad m . n) K_ij
        """
        if self.correction.is_none:
            return np.zeros_like(sample.curvature)
        up, along, around, radius = self._directions(sample.r)
        sine, cosine = math.sin(self.region.pitch_angle), math.cos(self.region.pitch_angle)
        m = self._bends(sample.r)
        tangents = np.stack([sample.tangent_1, sample.tangent_2], axis=-2)

        def product(a: Array, b: Array) -> Array:
            of_a, of_b = (np.einsum("...ai,...i->...a", tangents, one) for one in (a, b))
            return np.asarray(of_a[..., :, None] * of_b[..., None, :])

        def weighted(weight: Array, matrix: Array) -> Array:
            return np.asarray(weight[..., None, None] * matrix)

        mixed = product(up, along)
        turn = weighted((cosine * m.by_h + sine * m.by_l) / radius, product(around, around))
        slope = m.by_h[..., None] * up + m.by_l[..., None] * along
        lean = np.einsum("...i,...i->...", slope, sample.normal)
        return (
            weighted(m.by_hh, product(up, up))
            + weighted(m.by_ll, product(along, along))
            + weighted(m.by_hl, mixed + np.swapaxes(mixed, -1, -2))
            + turn
            + weighted(lean, sample.curvature)
        )

    def parameters(self, s: Array, t: Array) -> Array:
        """Return u [m], th, ph [rad] at profile positions s and face positions t, (..., 3).

        NaN where the cutter leaves no flank.
        """
        s, t = np.broadcast_arrays(np.asarray(s, float), np.asarray(t, float))
        radius, axial = self.region.section(s, t)
        coarse, (rows, columns) = self._start_grid, _START_GRID
        i = np.clip(np.rint(s * (rows - 1)), 0, rows - 1).astype(int)
        j = np.clip(np.rint(t * (columns - 1)), 0, columns - 1).astype(int)
        found = march(self.motion, radius.ravel(), axial.ravel(), coarse[i, j].reshape(-1, 3))
        return found.reshape(*s.shape, 3)

    def sample(self, s: Array, t: Array) -> FlankSample:
        """Return points, normals and curvatures at profile positions s, face positions t."""
        return self.sample_parameters(self.parameters(s, t))

    def sample_parameters(self, parameters: Array) -> FlankSample:
        """Return points, normals and curvatures at cutting parameters of shape (..., 3)."""
        shape = parameters.shape[:-1]
        out = sample_surface(self.motion, self.outward, parameters.reshape(-1, 3))
        out[:, 15] *= self._sound
        curvature = out[:, [12, 13, 13, 14]].reshape(*shape, 2, 2)
        r, normal, tangent_1, tangent_2 = (
            out[:, 3 * k : 3 * k + 3].reshape(*shape, 3) for k in range(4)
        )
        return FlankSample(r, normal, tangent_1, tangent_2, curvature, out[:, 15].reshape(shape))

    def grid(self, s: Array, t: Array) -> FlankSample:
        """Return the flank on the grid of profile positions s (m,) and face positions t (n,)."""
        return self.sample(*np.meshgrid(s, t, indexing="ij"))

    def turned(self, angle: float) -> Rotation:
        """Return the rotation of the member by `angle` [rad] about its axis."""
        return Rotation.from_rotvec(angle * self.axis)

    @cached_property
    def _sound(self) -> float:
        """Sign of the regularity where the flank is sound: at its reference point."""
        return math.copysign(1.0, regularity(cut_state(self.motion, *self.start)))

    @cached_property
    def _start_grid(self) -> Array:
        """Starts on a coarse grid, each found from its neighbour, (m, n, 3)."""
        rows, columns = _START_GRID
        s, t = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
        radius, axial = self.region.section(s, t)
        found = np.full((rows, columns, 3), np.nan)
        middle = columns // 2
        order = [(i, j) for j in _outwards(middle, columns) for i in _outwards(rows // 2, rows)]
        for i, j in order:
            near = [
                found[a, b]
                for a, b in ((i, j - 1), (i, j + 1), (i - 1, j), (i + 1, j))
                if 0 <= a < rows and 0 <= b < columns and np.isfinite(found[a, b, 0])
            ]
            start = near[0] if near else self.start
            found[i, j] = march(self.motion, radius[[i], [j]], axial[[i], [j]], start[None])[0]
        if not np.isfinite(found[rows // 2, middle, 0]):
            raise ParameterError(
                f"The {self.role}'s cutter leaves no {self.side} flank at the middle of the tooth. "
                "Check its machine settings against the mean point (reference_plane_distance)."
            )
        # below an undercut, a search may start from the lowest place that has a flank
        for i in range(rows - 2, -1, -1):
            missing = np.isnan(found[i, :, 0])
            found[i, missing] = found[i + 1, missing]
        return found


def tooth_region(blank: HypoidBlank, role: Role) -> ToothRegion:
    """Return where the member's tooth lies in its axial section."""
    member = blank.pinion if role == "pinion" else blank.gear
    apex = blank.pinion_apex[0] if role == "pinion" else blank.gear_apex[2]
    return ToothRegion(
        inner_cone_distance=member.outer_cone_distance - member.face_width,
        outer_cone_distance=member.outer_cone_distance,
        pitch_angle=member.pitch_angle,
        apex_axial=float(apex),
        root_depth=blank.whole_depth - member.addendum,
        addendum=member.addendum,
    )


def _outwards(middle: int, count: int) -> list[int]:
    return sorted(range(count), key=lambda k: (abs(k - middle), k))


def _outward(motion: CuttingMotion, start: Array, curve: Curve) -> float:
    """Return the sign with which the normal leaves the tooth.

    The tooth lies inside the circle of inside blades (convex flank), outside that of the others.
    """
    still = motion._replace(index_ratio=0.0, roll_ratio=0.0)
    u, th, _ = start
    state = cut_state(still._replace(generated=0.0), u, th, 0.0)
    radial = np.array(state.r) - np.array(motion.cutter_centre)
    leaves_circle = float(np.array(state.normal) @ radial) > 0.0
    return 1.0 if leaves_circle == (curve == "convex") else -1.0
