"""Shear stress on the two surfaces of a line film: kernels."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import cooling_at
from gearlube_core.oil.film_oil import FilmOil, limiting_stress, stress_ratio
from gearlube_core.oil.sheared_film import mid_stress


@kernel
def fill_mean_stress(
    p: np.ndarray,
    p_slope: np.ndarray,
    h: np.ndarray,
    void: np.ndarray,
    eta: np.ndarray,
    sliding: float,
    oil: FilmOil,
    tau: np.ndarray,
) -> None:
    """Fill the shear stress at mid-film.

    tau_m = eta (u2 - u1)/h, or that of the shear law, tau0 asinh(a s/sinh s) for Eyring's;
    tau0 is the local one, `stress_ratio`; at most tau_limit + slope p in amount

    Parameters
    ----------
    p, p_slope, h, void, eta
        Pressure [Pa], its slope along x [Pa/m], film [m], void share [-], viscosity [Pa s], (n,).
    sliding
        u2 - u1 [m/s].
    oil
        Constants of the oil's laws.
    tau
        Filled, (n,) [Pa].

    Notes
    -----
    The limit acts on the traction alone: where it is met the film slips at the limiting stress,
    and flow by pressure through an oil that stiff is negligible beside what is carried. Where the
    film is broken the stress is that of the share of the gap that holds oil.
    Source: [jamali_2015 (3.29a)] [jamali_2015 (3.31)]; [johnson_tevaarwerk_1977] for the limit.
    """
    for i in range(p.size):
        newtonian = eta[i] * sliding / h[i]
        stress = newtonian
        tau0 = oil.shear.tau0
        if oil.eyring_slope > 0.0:
            cooling = cooling_at(oil.viscosity, p[i], math.log(eta[i] / oil.eta0))
            tau0 *= stress_ratio(oil, p[i], cooling)[0]
        if tau0 > 0.0:
            sigma = 0.5 * h[i] * p_slope[i] / tau0
            stress = tau0 * mid_stress(oil.shear, sigma, newtonian / tau0)
        limit = limiting_stress(oil, p[i])
        tau[i] = (1.0 - void[i]) * math.copysign(min(abs(stress), limit), stress)
