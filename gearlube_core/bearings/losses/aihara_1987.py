"""Rolling force and inlet heating of tapered roller bearings, Aihara 1987."""

from __future__ import annotations

from gearlube_core.film.status import IN_RANGE
from gearlube_core.kernels.jit import kernel


@kernel
def aihara_force(
    R: float, line_load: float, reduced_modulus: float, eta0: float, alpha: float, speed: float
) -> tuple[float, int]:
    """Return the rolling force of a roller on a race per surface and length, without heating.

    F = 176 (R^2/alpha) (G U)^0.658 W^0.31/(2 R),  U = eta0 u/(E' R),  G = alpha E',
    W = q/(E' R)

    Parameters and returns as in `biboulet_houpert_force`.

    Notes
    -----
    The source gives the rolling moment of a length of roller, fitted to about 200 bearings under
    axial load; divided by 2 R it is the force of either surface. It writes R for the radius of the
    roller, W = 2 F_a/(D l z sin(a) E'), which is q/(E' R) of each roller; with R of either contact
    in its place the sum of both races changes by less than 1 %. It knows no radial load.
    Source: [aihara_1987 (27)]
    """
    size = reduced_modulus * R
    GU = alpha * eta0 * speed / R
    W = line_load / size
    return 176.0 * (R * R / alpha) * GU**0.658 * W**0.31 / (2.0 * R), IN_RANGE


@kernel
def aihara_heating(heating_number: float) -> float:
    """Return the factor by which inlet heating lowers the rolling force.

    phi = 1/(1 + 0.29 Lt^0.78)

    Parameters
    ----------
    heating_number
        Lt = eta0 beta u^2/K, see `groups.inlet_heating_number` [-].

    Notes
    -----
    Made for the rolling force.
    Source: [aihara_1987]
    """
    return 1.0 / (1.0 + 0.29 * heating_number**0.78)


@kernel
def aihara_rib_torque(axial_load: float, height: float, mu: float, cos_half_cone: float) -> float:
    """Return the torque of the rib on the inner ring, e mu cos(b) F_a [N m].

    Parameters
    ----------
    axial_load
        F_a [N].
    height
        e, of the rib contact above the race of the inner ring [m].
    mu
        Coefficient of friction at the rib [-].
    cos_half_cone
        Cosine of b, half the cone angle of the rollers [-].

    Notes
    -----
    Holds for a common apex of rollers and races. `rib.rib_friction` finds the same from the sliding
    speed, within 1/cos(b).
    Source: [aihara_1987 (11)]
    """
    return height * mu * cos_half_cone * axial_load
