"""Rolling force of a line contact, Zhou and Hoeprich 1991."""

from __future__ import annotations

from gearlube_core.film.status import IN_RANGE
from gearlube_core.kernels.jit import kernel


@kernel
def zhou_hoeprich_force(
    R: float, line_load: float, reduced_modulus: float, eta0: float, alpha: float, speed: float
) -> tuple[float, int]:
    """Return the rolling force of a line contact per surface and length.

    F = 29.2 (R/alpha) (G U)^0.648 W^0.246,  U = eta0 u/(E' R),  G = alpha E',  W = q/(E' R)

    Parameters and returns as in `biboulet_houpert_force`. alpha is the pressure-viscosity
    coefficient of the oil, not the contact angle.

    Notes
    -----
    The range of the fit is not known here; the status is always 0. The law gives about half of
    the force of a flooded film as Reynolds' equation has it (docs/bearing.md).
    Source: [zhou_hoeprich_1991 (17)]
    """
    size = reduced_modulus * R
    GU = alpha * eta0 * speed / R
    W = line_load / size
    return 29.2 * (R / alpha) * GU**0.648 * W**0.246, IN_RANGE
