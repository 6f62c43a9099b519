"""Point contacts of given Moes groups, for the tests of the film solver."""

from __future__ import annotations

import math
from typing import Any

from gearlube_core.ehl.lubricant import EhlLubricant, ehl_lubricant
from gearlube_core.ehl.problem import PointContactProblem, elliptical_contact

RADIUS = 0.01  # m
REDUCED_MODULUS = 2.26e11  # Pa
ALPHA = 2e-8  # 1/Pa
ETA0 = 0.04  # Pa s


def moes_contact(
    M: float,
    L: float,
    *,
    nodes: tuple[int, int],
    radius_ratio: float = 1.0,
    angle: float = 0.0,
    lubricant: EhlLubricant | None = None,
    **domain: Any,
) -> PointContactProblem:
    """Return the contact with load M and material L of Moes; L = 0 is isoviscous."""
    material = ALPHA * REDUCED_MODULUS
    U = 0.5 * (L / material) ** 4 if L > 0.0 else 1e-11
    speed = U * REDUCED_MODULUS * RADIUS / ETA0
    load = M * (2.0 * U) ** 0.75 * REDUCED_MODULUS * RADIUS**2
    if lubricant is None:
        lubricant = ehl_lubricant(eta0=ETA0, alpha=ALPHA if L > 0.0 else 0.0)
    return elliptical_contact(
        R_x=RADIUS,
        R_y=RADIUS * radius_ratio,
        entrainment=(speed * math.cos(angle), speed * math.sin(angle)),
        load=load,
        contact_modulus=0.5 * REDUCED_MODULUS,
        lubricant=lubricant,
        nodes=nodes,
        **domain,
    )


def moes_film(problem: PointContactProblem, film: float) -> float:
    """Return H = h/R (2 U)^(-1/2)."""
    speed = math.hypot(*problem.entrainment)
    U = problem.lubricant.eta0 * speed / (REDUCED_MODULUS * RADIUS)
    return film / RADIUS / math.sqrt(2.0 * U)
