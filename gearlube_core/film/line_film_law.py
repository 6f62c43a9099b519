"""Film of a line contact as a power law of speed, material and load."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel


class LineFilmLaw(NamedTuple):
    """Coefficient and exponents of the dimensionless groups [-]."""

    coefficient: float
    speed: float
    material: float
    load: float


@kernel
def power_law_line_film(
    law: LineFilmLaw,
    R: float,
    eta0: float,
    alpha: float,
    entrainment_speed: float,
    line_load: float,
    reduced_modulus: float,
) -> float:
    """Return C R U^s G^m W'^l [m]; arguments as in `dowson_toyoda_1979.line_film_thickness`.

    U = eta0 u/(E' R),  G = alpha E',  W' = w/(E' R),  u = (u_1 + u_2)/2
    """
    stiffness = reduced_modulus * R
    return (
        law.coefficient
        * R
        * math.exp(
            law.speed * math.log(eta0 * entrainment_speed / stiffness)
            + law.material * math.log(alpha * reduced_modulus)
            + law.load * math.log(line_load / stiffness)
        )
    )
