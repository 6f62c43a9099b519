"""Rolling force of a line contact, Goksem and Hargreaves 1978."""

from __future__ import annotations

from gearlube_core.film.status import IN_RANGE
from gearlube_core.kernels.jit import kernel


@kernel
def goksem_hargreaves_force(
    R: float, line_load: float, reduced_modulus: float, eta0: float, alpha: float, speed: float
) -> tuple[float, int]:
    """Return the rolling force of a line contact per surface and length.

    F = 4.318 (R/alpha) (G U)^0.658 W^0.0126,  U = eta0 u/(E' R),  G = alpha E',  W = q/(E' R)

    Parameters and returns as in `biboulet_houpert_force`.

    Notes
    -----
    Flooded and isothermal. The range of the fit is not known here; the status is always 0.
    Source: [goksem_hargreaves_1978]
    """
    size = reduced_modulus * R
    GU = alpha * eta0 * speed / R
    W = line_load / size
    return 4.318 * (R / alpha) * GU**0.658 * W**0.0126, IN_RANGE
