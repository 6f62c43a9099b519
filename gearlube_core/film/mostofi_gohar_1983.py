"""Film thickness of a roller on a race with entraining and squeeze motion.

[mostofi_gohar_1983] in the form printed as [mohammadpour_2015 (27)]. Kernels only. The
Notes of `central_film` explain the conventions.
"""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

COEFFICIENT = 13.924  # [-], [mohammadpour_2015 (27)]
LOAD_EXPONENT = -0.045  # [-], (27)
SPEED_EXPONENT = 0.647  # [-], (27)
MATERIAL_EXPONENT = 0.46  # [-], (27)
SQUEEZE_SHARE = 0.75  # [-], (27)
SQUEEZE_RATE = 132.0  # [-], (27)
SQUEEZE_FACTOR_MIN = 0.05  # 1, clip: [mohammadpour_2015 (27)] turns negative for v/u > 0.0022
SQUEEZE_FACTOR_MAX = 1.0  # 1, limit of [mohammadpour_2015 (27)] for v/u -> -infinity


@kernel
def squeeze_factor(v: float, u: float) -> float:
    """Return the squeeze factor of the film, clipped to its positive range.

    q = 1 - 0.75 exp(132 v / u), within [0.05, 1].

    Parameters
    ----------
    v : float
        Rate of change of the film thickness dH/dt [m/s].
    u : float
        Mean entraining speed, above zero [m/s].

    Returns
    -------
    float
        q [-]; 1/4 without squeeze.

    Notes
    -----
    Unclipped, q is negative for v/u > 0.0022. [mohammadpour_2015 (27)] writes the
    squeeze speed as dH/d(alpha); the derivative is with respect to time.

    Examples
    --------
    >>> squeeze_factor(0.0, 2.0)
    0.25
    """
    q = 1.0 - SQUEEZE_SHARE * math.exp(SQUEEZE_RATE * v / u)
    if q < SQUEEZE_FACTOR_MIN:
        return SQUEEZE_FACTOR_MIN
    if q > SQUEEZE_FACTOR_MAX:
        return SQUEEZE_FACTOR_MAX
    return q


@kernel
def dimensionless_groups(
    w: float, u: float, eta0: float, alpha: float, r: float, E_r: float
) -> tuple[float, float, float]:
    """Return the load, speed and material groups of the roller film.

    W = w / (Er r^2),  U = eta0 u / (Er r),  G = alpha Er.

    Parameters
    ----------
    w, u, eta0, alpha, r, E_r : float
        As in `central_film`.

    Returns
    -------
    tuple of float
        W, U, G [-].

    Notes
    -----
    Mohammadpour et al. 2015 print W and U multiplied by Er below [mohammadpour_2015 (27)], which is
    not dimensionless; see `dimensionless_groups_as_printed`.
    """
    return w / (E_r * r * r), eta0 * u / (E_r * r), alpha * E_r


@kernel
def dimensionless_groups_as_printed(
    w: float, u: float, eta0: float, alpha: float, r: float, E_r: float
) -> tuple[float, float, float]:
    """Return the groups as printed below [mohammadpour_2015 (27)]: w Er/r^2, eta0 u Er/r, alpha Er.

    The first two carry the unit Pa^2 and give films of many metres. Kept to show the misprint
    (Mohammadpour et al. 2015); no model uses it.
    """
    return w * E_r / (r * r), eta0 * u * E_r / r, alpha * E_r


@kernel
def central_film(
    w: float, u: float, v: float, eta0: float, alpha: float, r: float, E_r: float
) -> float:
    """Return the central film thickness between a roller and a race.

    H = r 13.924 W^-0.045 U^0.647 G^0.46 (1 - 0.75 exp(132 v/u)).

    Parameters
    ----------
    w : float
        Load of the roller, above zero [N].
    u : float
        Mean of the two surface speeds relative to the contact [m/s].
    v : float
        Rate of change of the film thickness [m/s].
    eta0 : float
        Viscosity at ambient pressure [Pa s].
    alpha : float
        Pressure-viscosity coefficient [1/Pa].
    r : float
        Roller radius [m].
    E_r : float
        pi E'/2 with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [Pa].

    Returns
    -------
    float
        H [m]; zero at u = 0.

    Notes
    -----
    The source leaves open whether u in the speed group is the mean or the sum of the surface
    speeds. The mean is used, as in the line and point contact films it is compared with. For the
    bearing of [mohammadpour_2015 Table A2], at 500 N and 50 to 700 rad/s, H is then 24 to
    32 % below the central film of [dowson_toyoda_1979], which knows no end leakage; the sum
    would put it 6 to 19 % above. The squeeze factor is clipped, see `squeeze_factor`.

    References
    ----------
    [mostofi_gohar_1983]; [mohammadpour_2015 (27)], with its groups made dimensionless.
    """
    if u <= 0.0:
        return 0.0
    W, U, G = dimensionless_groups(w, u, eta0, alpha, r, E_r)
    shape = W**LOAD_EXPONENT * U**SPEED_EXPONENT * G**MATERIAL_EXPONENT
    return r * COEFFICIENT * shape * squeeze_factor(v, u)
