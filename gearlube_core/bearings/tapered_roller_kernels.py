"""Two opposed tapered roller bearings as a bearing type for models of shafts."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import RollerFilms, ShaftMotion, SolvedRaceways
from gearlube_core.bearings.losses.catalogue import (
    SMOOTHING_SPEED,
    drag_torque,
    skf_torque,
)
from gearlube_core.bearings.losses.laws import SKF
from gearlube_core.bearings.losses.rib import (
    RIB_END_RADIUS,
    RIB_SHARE_B,
    RIB_SHARE_C,
    RibParameters,
    rib_friction,
)
from gearlube_core.bearings.losses.rolling import hysteresis_power, liebrecht_drag
from gearlube_core.bearings.parameters import COS_TABLE, SIN_TABLE, BearingParameters
from gearlube_core.bearings.raceway_drag import (
    line_radii,
    raceway_drag,
    steady_load,
    steady_rollers,
)
from gearlube_core.bearings.roller_contact import contact_angle_terms, preload_approach
from gearlube_core.bearings.roller_loads import bearing_forces, roller_loads
from gearlube_core.bearings.roller_nodes import solved_raceway_drag
from gearlube_core.bearings.shaft_expansion import (
    expand_shaft_bearings,
    expanded_shaft_forces,
    shaft_bearing_energy,
)
from gearlube_core.film.point_film import film_geometry
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

_NEWTON_STEPS = 4  # to 1e-15 of the half cone for rollers that fit


@kernel
def shaft_bearing_forces(
    motion: ShaftMotion, f_ref: float, eta0: float, alpha: float, p: BearingParameters
) -> tuple[float, float, float, float, float, float, float]:
    """Return the forces of both opposed bearings on the shaft, and the power of the hysteresis.

    w_i = kn d^n + 0.009 n kn d^(n-1) d'/f_ref,  d = H - C + (r1 cos th + r2 sin th) cos L
    + s xa sin L,  F_r1 = -sum w cos th cos L,  F_r2 = -sum w sin th cos L,  F_a = -s sum w sin L.

    Parameters
    ----------
    motion : ShaftMotion
        Keep the cage angle within a few turns for accuracy.
    f_ref : float
        Reference frequency of the hysteresis, above zero [Hz].
    eta0, alpha : float
        Viscosity [Pa s] and pressure-viscosity coefficient [1/Pa] of the oil.
    p : BearingParameters
        The bearing on either side.

    Returns
    -------
    tuple of float
        F1_r1, F1_r2, F1_a of the side s = +1, F2_r1, F2_r2, F2_a of s = -1 [N]; power lost in the
        rollers, >= 0 [W].

    Notes
    -----
    The lost power covers the motion of the shaft and of the cage: with the potential V of
    `shaft_bearing_energy` at constant film, dV/dt = -F.v - T_c cage_speed - power, where T_c is
    `cage_torque`. Printed [mohammadpour_2015 (24)] has no side s; printed [mohammadpour_2015 (26)]
    halves the displacement, which is the option approach="as_printed". A NaN in any input gives NaN
    forces.

    References
    ----------
    [mohammadpour_2015 (24)]; `roller_loads.bearing_forces` has the rollers.
    """
    F1_r1, F1_r2, F1_a, lost_1 = bearing_forces(motion, f_ref, eta0, alpha, p, 1.0)
    F2_r1, F2_r2, F2_a, lost_2 = bearing_forces(motion, f_ref, eta0, alpha, p, -1.0)
    return F1_r1, F1_r2, F1_a, F2_r1, F2_r2, F2_a, lost_1 + lost_2


@kernel
def skf_drag(
    speed: float, axial_load: float, radial_load: float, nu: float, p: BearingParameters
) -> float:
    """Return the drag torque of one tapered roller bearing, with the sign of the speed.

    M = (M_rr + M_sl) w/sqrt(w^2 + w0^2)

    Parameters
    ----------
    speed : float
        Speed w of the shaft [rad/s].
    axial_load, radial_load : float
        Of the bearing, not negative [N].
    nu : float
        Kinematic viscosity of the oil [m2/s].
    p : BearingParameters
        Bearing.

    Returns
    -------
    float
        Torque that opposes the rotation when subtracted from the shaft [N m].

    Notes
    -----
    Rolling of the raceways and sliding of the rib, see `skf_torque`; without its drag term. The
    factor in w, with w0 = 1 rad/s, makes the torque smooth through zero speed.
    """
    rolling, sliding = skf_torque(abs(speed), axial_load, radial_load, nu, p)
    smooth = speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)
    return (rolling + sliding) * smooth


class RibDrag(NamedTuple):
    """Torques of the bearings, not negative [N m]."""

    rib: float
    hysteresis: float
    oil: float


@kernel
def roller_half_cone(k: float, sin_outer: float, cos_outer: float) -> float:
    """Return the tangent of half the cone angle of the rollers.

    tan b = k sin(a_o - b), so that rollers and races share one apex

    Parameters
    ----------
    k
        Roller diameter over pitch diameter [-].
    sin_outer, cos_outer
        Of the angle of the outer race a_o.
    """
    t = k * sin_outer / (1.0 + k * cos_outer)
    for _ in range(_NEWTON_STEPS):
        root = math.sqrt(1.0 + t * t)
        excess = t * root - k * (sin_outer - cos_outer * t)
        t -= excess / ((1.0 + 2.0 * t * t) / root + k * cos_outer)
    return t


@kernel
def rib_contact(p: BearingParameters) -> tuple[RibParameters, float]:
    """Return the contact of a roller end with the rib, and its load over that of the outer race.

    The contact angle is that of the outer race; the inner one has the angle that closes the apex.
    Without a contact angle there is no rib: all zeros.
    """
    if p.sin_contact <= 0.0:
        return RibParameters(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0.0
    t = roller_half_cone(
        2.0 * p.roller_radius / (p.inner_radius + p.outer_radius), p.sin_contact, p.cos_contact
    )
    cos_b = 1.0 / math.sqrt(1.0 + t * t)
    sin_b = t * cos_b
    sin_mean = p.sin_contact * cos_b - p.cos_contact * sin_b
    cos_mean = p.cos_contact * cos_b + p.sin_contact * sin_b
    sin_inner = sin_mean * cos_b - cos_mean * sin_b
    cos_inner = cos_mean * cos_b + sin_mean * sin_b
    relative = 1.0 - p.cage_ratio
    # a turn about the line of contact with the inner race; the rib slides with its height times it
    sliding = p.rib_height * relative * sin_mean / sin_b
    radius = p.inner_radius + 0.5 * p.roller_length * sin_inner + p.rib_height * cos_inner
    # a rib square to the race is a hollow cone whose normals meet in the apex
    distance = radius / sin_inner
    sphere = RIB_END_RADIUS * distance
    along = 1.0 / (1.0 / sphere - 1.0 / distance)
    R_e, side_flow = film_geometry(sphere, along, 0.5 * math.pi)
    rib = RibParameters(
        sliding,
        relative * radius - 0.5 * sliding,
        sphere,
        along,
        R_e,
        side_flow,
        p.rib_roughness,
        RIB_SHARE_B,
        RIB_SHARE_C,
        p.rib_friction,
        p.reduced_modulus,
    )
    return rib, 2.0 * sin_b * cos_b


@kernel
def rib_drag(
    motion: ShaftMotion, oil: LubricantState, p: BearingParameters, side: float = 0.0
) -> RibDrag:
    """Return the torques of the ribs, of the steel's hysteresis and of the oil on the rollers.

    Parameters
    ----------
    motion
        Of the shaft; its velocities play no part. At rest all torques are zero.
    oil
        Oil at the inlet temperature.
    p
        Either bearing; with a rib height or a contact angle of 0 there is no rib.
    side
        0: both bearings; +1 or -1: the one of that side alone.

    Notes
    -----
    Each roller end slides under its own load. The coefficient of friction is that of the mean load
    of the rollers in contact: it depends little on it, and is dear. The rib's torque carries the
    factor |w|/sqrt(w^2 + w0^2) with w0 = 1 rad/s, so that it passes through zero with the speed.
    Source: `rib_friction`, `hysteresis_power`, `liebrecht_drag`.
    """
    speed = abs(motion.speed)
    if speed == 0.0:
        return RibDrag(0.0, 0.0, 0.0)
    rollers = steady_rollers(motion, oil, p)
    R_inner, R_outer = line_radii(p)
    E = p.reduced_modulus
    ribbed = p.rib_height > 0.0 and p.sin_contact > 0.0  # else the contact is not read
    rib, share = rib_contact(p)
    on_rib = hysteresis = 0.0
    for bearing in range(2):
        here = 1.0 - 2.0 * bearing
        total = 0.0
        loaded = 0
        for i in range(int(p.n_rollers) if here * side >= 0.0 else 0):
            load = steady_load(rollers, here, i, p)
            if load <= 0.0:
                continue
            total += load
            loaded += 1
            q = load / p.roller_length
            hysteresis += hysteresis_power(load, q, R_inner, E, p.film_speed_radius)
            hysteresis += hysteresis_power(load, q, R_outer, E, p.film_speed_radius)
        if ribbed and loaded > 0:
            end = rib_friction(rib, share * total / loaded, speed, oil)
            on_rib += end.coefficient * share * total * rib.sliding_ratio
    on_rib *= speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)
    in_oil = (2.0 if side == 0.0 else 1.0) * liebrecht_drag(
        oil.eta0 / oil.nu,
        oil.nu,
        p.roller_length,
        2.0 * p.roller_radius,
        p.inner_radius + p.outer_radius,
        p.cage_ratio * speed / (2.0 * math.pi),
    )
    return RibDrag(on_rib, hysteresis, in_oil)


_SIN, _COS, _AXIAL_FACTOR, _INTERFERENCE = (
    BearingParameters._fields.index(name)
    for name in ("sin_contact", "cos_contact", "axial_factor", "interference")
)


class TaperedRollerParameters(BearingParameters):
    """Two opposed tapered roller bearings of one shaft; see `bearing_type.ShaftBearings`."""

    __slots__ = ()

    @kernel
    def expand_forces(
        self, motion: ShaftMotion, f_ref: float, oil: LubricantState, expansion: Array
    ) -> None:
        """Write the expansion of the forces about this motion."""
        expand_shaft_bearings(motion, f_ref, oil.eta0, oil.alpha, self, expansion)

    @kernel
    def expanded_forces(
        self, motion: ShaftMotion, expansion: Array
    ) -> tuple[float, float, float, float]:
        """Return the forces on the shaft [N] and the lost power [W] near the expansion."""
        return expanded_shaft_forces(motion, self, expansion)

    @kernel
    def shaft_forces(
        self, motion: ShaftMotion, f_ref: float, oil: LubricantState
    ) -> tuple[float, float, float, float, float, float, float]:
        """Return the forces of either bearing [N] and the lost power of both [W]."""
        return shaft_bearing_forces(motion, f_ref, oil.eta0, oil.alpha, self)

    @kernel
    def shaft_energy(self, motion: ShaftMotion, oil: LubricantState) -> float:
        """Return the elastic energy of both bearings [J]."""
        return shaft_bearing_energy(
            motion.r1,
            motion.r2,
            motion.axial,
            motion.cage_angle,
            motion.speed,
            oil.eta0,
            oil.alpha,
            self,
        )

    @kernel
    def bearing_loads(
        self, motion: ShaftMotion, f_ref: float, oil: LubricantState, side: float, rollers: Array
    ) -> tuple[float, float, float, float, float, float]:
        """Return the forces of one bearing; load of roller 0, largest and smallest load [N]."""
        roller_loads(motion, f_ref, oil.eta0, oil.alpha, self, side, rollers)
        count = int(self.n_rollers)
        largest = smallest = rollers[0]
        sum_cos = sum_sin = sum_all = 0.0
        for i in range(count):
            w = rollers[i]
            largest = max(largest, w)
            smallest = min(smallest, w)
            sum_cos += w * COS_TABLE[count, i]
            sum_sin += w * SIN_TABLE[count, i]
            sum_all += w
        cos_c, sin_c = math.cos(motion.cage_angle), math.sin(motion.cage_angle)
        return (
            -self.cos_contact * (sum_cos * cos_c - sum_sin * sin_c),
            -self.cos_contact * (sum_cos * sin_c + sum_sin * cos_c),
            -side * self.sin_contact * sum_all,
            rollers[0],
            largest,
            smallest,
        )

    @kernel
    def shaft_drag(
        self, speed: float, axial_load: float, radial_load: float, law: int, oil: LubricantState
    ) -> float:
        """Return the drag torque of one bearing [N m]."""
        if law == SKF:
            return skf_drag(speed, axial_load, radial_load, oil.nu, self)
        return drag_torque(speed, axial_load, radial_load, oil.nu, self)

    @kernel
    def raceway_torque(self, motion: ShaftMotion, law: int, oil: LubricantState) -> float:
        """Return the torque of the raceways of both bearings [N m]."""
        return raceway_drag(motion, law, oil, self)

    @kernel
    def solved_raceways(
        self, motion: ShaftMotion, oil: LubricantState, films: RollerFilms
    ) -> SolvedRaceways:
        """Return torque and films of the raceways of both bearings by solved films."""
        return solved_raceway_drag(motion, oil, self, films)

    @kernel
    def beside_raceways(self, motion: ShaftMotion, oil: LubricantState) -> float:
        """Return the torque of ribs, hysteresis and oil of both bearings [N m]."""
        ends = rib_drag(motion, oil, self)
        beside = ends.rib + ends.hysteresis + ends.oil
        return -beside if motion.speed < 0.0 else beside

    @kernel
    def write_derived(self, preload: float, out: Array) -> None:
        """Write what follows from contact angle and preload into its places."""
        sin_contact, cos_contact, axial_factor = contact_angle_terms(self.contact_angle)
        out[_SIN], out[_COS], out[_AXIAL_FACTOR] = sin_contact, cos_contact, axial_factor
        out[_INTERFERENCE] = preload_approach(preload, self.n_rollers, sin_contact, self.kn, self.n)

    def without_loss(self) -> TaperedRollerParameters:
        """Return the bearings without hysteresis."""
        return self._replace(loss=0.0)
