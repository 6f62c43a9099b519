"""A law of flank friction of another package, in one file: one coefficient, and a film of its own.

Nothing else names it. To import this file is to register the law, so tests do it in a process of
their own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.line_film import LineFilmLaw, power_law_line_film
from gearlube_core.friction.flank_data import FlankState
from gearlube_core.friction.flank_friction import FlankFriction
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number

# a formula of another package: the film of rigid cylinders, Martin 1916, 4.9 eta u R/w
MARTIN = LineFilmLaw(coefficient=4.9, speed=1.0, material=0.0, load=-1.0)
LINE_LENGTH = 0.02  # m, over which a flank carries its load


@dataclass(frozen=True, kw_only=True)
class Coulomb(FlankFriction, name="coulomb", text="f = mu F, all of it viscous; film of Martin"):
    """f = mu F, all of it viscous; film of Martin."""

    film_load = (1e-9, 1e-3)
    mu: Annotated[
        float,
        Number(
            "1", 0.0, 0.5, text="Coefficient of the flank friction", source="a guess", factor=1.3
        ),
    ] = 0.04

    def __call__(self, surface: SurfaceParameters, solid: SolidParameters) -> CoulombFlank:
        """Return the law for the kernels."""
        return CoulombFlank(self.mu, surface.sigma, 2.0 * solid.contact_modulus)


class CoulombFlank(NamedTuple):
    """What the kernels take; all floats, SI."""

    mu: float
    sigma: float
    reduced_modulus: float

    @kernel
    def flank_state(self, load, entrainment_speed, sliding_speed, geometry, oil):
        F = max(load, 1.0)
        film = power_law_line_film(
            MARTIN,
            geometry.R_e,
            oil.eta0,
            oil.alpha,
            abs(entrainment_speed),
            F / LINE_LENGTH,
            self.reduced_modulus,
        )
        return FlankState(film, film / self.sigma, self.mu * load, 0.0, self.mu, 0.0, 1e9)
