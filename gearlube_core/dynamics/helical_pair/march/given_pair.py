"""From what gear file and oil give, and what a user chooses, to constants of the march: kernels.

All go in and out as flattened NamedTuples, so that Python and a native FMU call the same code.
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import (
    FLANK_SIGMA_OVER_BETA,
    FLANK_XI_BETA_SIGMA,
    SurfaceParameters,
)
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.dynamics.helical_pair.march.flanks import FlankConstants, MarchConstants
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import damping_factor
from gearlube_core.dynamics.helical_pair.supports import coupling_limit, replaced_bearing
from gearlube_core.dynamics.ranges import RangeLimits
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.helical_geometry.gear_body import SupportStiffness
from gearlube_core.kernels.flat_tuples import tuple_from_array, tuple_to_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantParameters

ARANA = 2.0  # friction form, see `MarchConstants`


class GivenBody(NamedTuple):
    """One gear and its bearings, shaft ends included."""

    mass: float  # [kg]
    inertia: float  # about a diameter [kg m2]
    polar_inertia: float  # [kg m2]
    first: SupportStiffness
    second: SupportStiffness


class GivenPair(NamedTuple):
    """Constants that only gear file and line mesh decide."""

    plane: ContactPlane
    effective_mass: float  # of the relative rotation along the line of action [kg]
    coast_phase: float  # see `FlankConstants`
    turn_cos: float
    turn_sin: float
    lines: float
    phases: float
    stations: float
    teeth: float  # of the pinion
    pinion: GivenBody
    gear: GivenBody
    solid: SolidParameters
    torque_low: float  # pinion torques at the ends of the line mesh [N.m]
    torque_high: float


class GivenOil(NamedTuple):
    """An oil, and the ranges of its data and of all formulas."""

    parameters: LubricantParameters
    ranges: RangeLimits  # the torque's are those of the pair instead


class MarchChoices(NamedTuple):
    """Choices of a user for any gear file, without the replaced bearings."""

    friction_form: float  # see `MarchConstants`
    friction_coefficient: float  # [-]
    boundary_friction: float  # of Arana's share [-]
    share_exponent: float  # likewise
    roughness_rms: float  # [m]
    backlash: float  # [m]
    mesh_damping_ratio: float  # [-]
    support_damping_ratio: float  # [-]
    held: float  # 1: axial motion and tilt are held; 0: free
    line_work: float  # see `FlankConstants`
    friction_updates_per_mesh_period: float
    film: float  # the same
    film_limiting_slope: float  # the same


@kernel
def gives_no_energy(bearing: SupportStiffness) -> bool:
    """Return whether the couplings of a bearing are small enough beside its stiffness."""
    return abs(bearing.K_x_theta_y) <= coupling_limit(bearing.K_xx, bearing.K_theta_y) and abs(
        bearing.K_y_theta_x
    ) <= coupling_limit(bearing.K_yy, bearing.K_theta_x)


@kernel
def replaced_body(
    body: GivenBody, radial: float, axial: float, distance: float
) -> tuple[bool, GivenBody]:
    """Return whether it gives no energy, and the body on other bearings, see `replaced_bearing`."""
    first = replaced_bearing(body.first, 1.0, radial, axial, distance)
    second = replaced_bearing(body.second, -1.0, radial, axial, distance)
    sound = gives_no_energy(first) and gives_no_energy(second)
    return sound, GivenBody(body.mass, body.inertia, body.polar_inertia, first, second)


@kernel
def replace_bearings(
    given: Array, radial: float, axial: float, distance: float, replaced: Array
) -> bool:
    """Write the pair on other bearings; return False where their couplings would give energy away.

    Parameters
    ----------
    given : ndarray
        A `GivenPair` as flat array.
    radial, axial, distance
        See `gear_file_march.ReplacedBearings`.
    replaced : ndarray
        The changed `GivenPair`, written.
    """
    pair: GivenPair = tuple_from_array(given, GivenPair)
    sound_pinion, pinion = replaced_body(pair.pinion, radial, axial, distance)
    sound_gear, gear = replaced_body(pair.gear, radial, axial, distance)
    tuple_to_array(
        GivenPair(
            pair.plane,
            pair.effective_mass,
            pair.coast_phase,
            pair.turn_cos,
            pair.turn_sin,
            pair.lines,
            pair.phases,
            pair.stations,
            pair.teeth,
            pinion,
            gear,
            pair.solid,
            pair.torque_low,
            pair.torque_high,
        ),
        replaced,
    )
    return sound_pinion and sound_gear


@kernel
def write_constants(given: Array, oil: Array, choices: Array, constants: Array) -> None:
    """Write MarchConstants from GivenPair, GivenOil and MarchChoices, all flattened."""
    pair: GivenPair = tuple_from_array(given, GivenPair)
    of_oil: GivenOil = tuple_from_array(oil, GivenOil)
    chosen: MarchChoices = tuple_from_array(choices, MarchChoices)
    flanks = FlankConstants(
        pair.plane,
        damping_factor(chosen.mesh_damping_ratio, pair.effective_mass, pair.plane.cos_b),
        chosen.backlash,
        pair.coast_phase,
        pair.turn_cos,
        pair.turn_sin,
        chosen.line_work,
        pair.lines,
        pair.phases,
        pair.stations,
    )
    ranges = of_oil.ranges
    tuple_to_array(
        MarchConstants(
            flanks,
            pair.teeth,
            chosen.friction_form,
            chosen.friction_coefficient if chosen.friction_form == 0.0 else 0.0,
            chosen.friction_updates_per_mesh_period,
            chosen.film,
            chosen.film_limiting_slope,
            SurfaceParameters(
                chosen.roughness_rms,
                FLANK_XI_BETA_SIGMA,
                FLANK_SIGMA_OVER_BETA,
                chosen.share_exponent if chosen.friction_form == ARANA else 0.0,
                chosen.boundary_friction,
            ),
            pair.solid,
            of_oil.parameters,
            RangeLimits(
                pair.torque_low,
                pair.torque_high,
                ranges.film_load_low,
                ranges.film_load_high,
                ranges.film_material_low,
                ranges.film_material_high,
                ranges.traction_low,
                ranges.traction_high,
                ranges.temperature_low,
                ranges.temperature_high,
                ranges.pressure_low,
                ranges.pressure_high,
            ),
        ),
        constants,
    )
