"""Mixed friction of one lubricated flank: film, asperities, traction, temperature."""

from __future__ import annotations

import math

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.point_film import central_film_thickness
from gearlube_core.friction.flank_data import ContactGeometry, FlankState
from gearlube_core.friction.mixed_friction import SPEED_FLOOR, mixed_friction
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

LOAD_FLOOR = 1.0e-3  # N, film and pressure of an unloaded flank are those at this floor


@kernel
def flank_friction(
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
) -> FlankState:
    """Return film, friction and temperature of one flank contact.

    consistent:  f_v = mu (F - W_a),  f_b = tau_l0 A_a + gamma W_a,  0 <= W_a <= F
    others as in `mixed_friction`

    Parameters
    ----------
    load
        Normal load F [N]; not positive: no friction.
    entrainment_speed
        Mean surface speed (u_1 + u_2)/2 [m/s], either sign.
    sliding_speed
        Relative surface speed dU [m/s], either sign.
    geometry
        Contact geometry at this position of mesh.
    lubricant
        Lubricant at oil temperature.
    surface
        Roughness of the pair.
    solid
        Elastic and thermal data of the pair.
    form
        CONSISTENT = 0, AS_PRINTED = 1, PRINTED_TRACTION = 2 or ZHOU_HOEPRICH_SHARE = 3.

    Returns
    -------
    FlankState
        Friction forces are magnitudes; they oppose sliding.

    Notes
    -----
    Range: that of `central_film_thickness`, `plateau_stress_ratio` and `asperity_load`.
    The printed form counts the asperity load in both terms and drops asperities at a film ratio
    of 3, where its polynomials jump. In every form mu lies between zero and the isothermal Eyring
    value, W_a is at most F, and the boundary term carries tanh(|dU|/1 mm/s), so that friction
    passes through zero with sliding speed; the paper states none of these. Greenwood and Tripp's
    law with the usual constants carries at most 32 MPa, some per cent of the load, also where there
    is no film; the shares of Zhou and Hoeprich and of Arana carry all of the load there.
    Source: [mohammadpour_2015 (11)], and the parts for the terms and their misprints.
    """
    h = central_film_thickness(
        geometry.R_e,
        geometry.side_flow,
        lubricant.eta0,
        lubricant.alpha,
        max(abs(entrainment_speed), SPEED_FLOOR),
        max(load, LOAD_FLOOR),
        2.0 * solid.contact_modulus,
    )
    return friction_of_film(
        h, load, entrainment_speed, sliding_speed, geometry, lubricant, surface, solid, form
    )


@kernel
def friction_of_film(
    film_thickness: float,
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
) -> FlankState:
    """Return film, friction and temperature of one flank with the film of another formula.

    Parameters
    ----------
    film_thickness
        Central film [m], above zero also without load and at rest; see LOAD_FLOOR and SPEED_FLOOR.

    Others, result and notes as in `flank_friction`.
    """
    F = max(load, 0.0)
    F_film = max(F, LOAD_FLOOR)
    speed = max(abs(entrainment_speed), SPEED_FLOOR)
    R_e, h = geometry.R_e, film_thickness
    p = geometry.pressure_coefficient * math.exp(math.log(F_film) / 3.0)
    friction = mixed_friction(
        F, F_film, p, h, speed, abs(sliding_speed), R_e, F_film / p, lubricant, surface, solid, form
    )
    return FlankState(
        h,
        friction.film_ratio,
        friction.viscous_friction,
        friction.boundary_friction,
        friction.friction_coefficient,
        friction.temperature_rise,
        p,
    )
