"""Rolling force and starvation of a line contact, Biboulet and Houpert 2010."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

IN_RANGE = 0  # within the range that the law was fitted for, as far as it is known
OUT_OF_RANGE = 1  # computed, but outside that range
LOAD_RANGE, MATERIAL_RANGE = (0.2, 200.0), (4.0, 16.0)  # of M and L below


@kernel
def biboulet_houpert_force(
    R: float, line_load: float, reduced_modulus: float, eta0: float, alpha: float, speed: float
) -> tuple[float, int]:
    """Return the rolling force of a flooded line contact per surface and length.

    F = E' R 1.42 (U W)^(1/2)/[1 + (0.966 M^(1/2))^10]^(1/10)
    U = 2 eta0 u/(E' R),  W = q/(E' R),  M = W/U^(1/2)

    Parameters
    ----------
    R
        Relative radius of curvature [m].
    line_load
        q [N/m], positive.
    reduced_modulus
        E' = 2 E* [Pa].
    eta0
        Viscosity at the inlet and ambient pressure [Pa s].
    alpha
        Pressure-viscosity coefficient [1/Pa]; only for the range.
    speed
        Rolling speed u, the mean of the two surface speeds [m/s], positive.

    Returns
    -------
    tuple of float and int
        F [N/m] on each of the two surfaces; the contact loses 2 F u per length. Status 1 outside
        the range of the fit.

    Notes
    -----
    Fitted to solutions for M from 0.2 to 200 and L = alpha E' U^(1/4) from 4 to 16, isothermal,
    Newtonian, flooded. For large loads F is 1.47 E' R U^(3/4), free of load and of alpha.
    Source: [biboulet_houpert_2010]
    """
    size = reduced_modulus * R
    U = 2.0 * eta0 * speed / size
    W = line_load / size
    M = W / math.sqrt(U)
    L = alpha * reduced_modulus * math.sqrt(math.sqrt(U))
    force = size * 1.42 * math.sqrt(U * W) / (1.0 + (0.966 * math.sqrt(M)) ** 10.0) ** 0.1
    within = LOAD_RANGE[0] <= M <= LOAD_RANGE[1] and MATERIAL_RANGE[0] <= L <= MATERIAL_RANGE[1]
    return force, IN_RANGE if within else OUT_OF_RANGE


@kernel
def biboulet_houpert_starvation(layer: float, film: float) -> float:
    """Return the share of the flooded rolling force that is left under a thin inlet layer.

    (S^2 + 162.8 S)/(S^2 + 193.1 S + 1257),  S = layer/film

    Parameters
    ----------
    layer
        Thickness of the oil at the inlet, both surfaces together [m]; 0 stands for flooded.
    film
        Smallest film of the flooded contact [m].

    Returns
    -------
    float
        0 to 1 [-].

    Notes
    -----
    Source: [biboulet_houpert_2010 (44)]
    """
    if layer <= 0.0:
        return 1.0
    S = layer / film
    return (S * S + 162.8 * S) / (S * S + 193.1 * S + 1257.0)
