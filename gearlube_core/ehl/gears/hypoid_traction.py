"""Traction of a flank's film with Newtonian, Eyring and thermal Eyring shear."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.friction.johnson_greenwood_1980 import thermal_eyring_film
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY


class FlankTraction(NamedTuple):
    """Coefficients of friction along sliding [-]."""

    newtonian: float
    eyring: float  # at the oil's temperature throughout
    heated: float  # Eyring, heated across the film, surfaces at the oil's temperature


@kernel
def heated_stress(
    p: np.ndarray, h: np.ndarray, eta: np.ndarray, slip: float, oil: FilmOil, beta: float
) -> np.ndarray:
    """Return the shear stress of a heated Eyring film where there is pressure, (n,) [Pa].

    beta(p) = beta (ln eta + 9.67)/(ln eta0 + 9.67)

    Parameters
    ----------
    p, h, eta
        Pressure [Pa], film [m], viscosity at the oil's temperature [Pa s], (n,).
    slip
        Sliding speed [m/s].
    oil
        With an Eyring stress.
    beta
        -d ln eta/dT of the oil at ambient pressure [1/K].

    Notes
    -----
    Source: [johnson_greenwood_1980]; [houpert_1985] for beta(p).
    """
    tau = np.zeros(p.size)
    reduced = math.log(oil.eta0) + ROELANDS_LOG_VISCOSITY
    tau0 = oil.shear.tau0
    for i in range(p.size):
        if p[i] > 0.0:
            log_eta = math.log(eta[i])
            beta_p = beta * (log_eta + ROELANDS_LOG_VISCOSITY) / reduced
            film = thermal_eyring_film(log_eta, beta_p, oil.conductivity, tau0, h[i], slip)
            tau[i] = film.stress_ratio * tau0
    return tau


def flank_traction(
    solution: FilmSolution, oil: FilmOil, sliding: tuple[float, float], beta: float
) -> FlankTraction:
    """Return the traction of a film along its sliding.

    mu = int tau dA/W,  tau = eta |dU|/h,  tau0 asinh(a s/sinh s) or that of a heated film

    Parameters
    ----------
    solution
        Film of the contact.
    oil
        With its Eyring stress.
    sliding
        Along x and y [m/s].
    beta
        -d ln eta/dT at ambient pressure [1/K].

    Notes
    -----
    Where there is no pressure the gap is left out: it shears oil at ambient pressure in films
    that are thicker. Surfaces that heat up, not contained here, take some per cent more.
    Source: `point_traction`, `heated_stress`.
    """
    slip = math.hypot(*sliding)
    if not slip > 0.0:
        return FlankTraction(0.0, 0.0, 0.0)
    x, y, p = solution.x, solution.y, solution.pressure
    shear = point_traction(x, y, p, solution.film, sliding, oil)
    loaded = p > 0.0
    eta, film = shear.viscosity[loaded], solution.film[loaded]
    share = (x[1] - x[0]) * (y[1] - y[0]) / solution.load
    return FlankTraction(
        share * float((eta * slip / film).sum()),
        share * float(shear.mean_stress[loaded].sum()),
        share * float(heated_stress(p[loaded], film, eta, slip, oil, beta).sum()),
    )
