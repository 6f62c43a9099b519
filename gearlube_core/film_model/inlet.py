"""Oil and solids at the inlet of a contact, as the groups of a film model take them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.roelands_1966 import ROELANDS_KAPPA, ROELANDS_PRESSURE

_LAGUERRE = np.stack(np.polynomial.laguerre.laggauss(10), axis=1)  # points and weights


class FilmInlet(NamedTuple):
    """Groups that depend on oil and solids alone; all floats."""

    contact_modulus: float  # E* [Pa]
    eta0: float  # [Pa s]
    alpha: float  # of films [1/Pa]
    beta: float  # [1/K]
    tau0: float  # Eyring stress [Pa]; idle with an Eyring slope
    eyring_slope: float  # as of the contact, and so on
    limiting_stress: float  # [Pa]
    limiting_slope: float  # [-]
    oil_conductivity: float  # [W/(m K)]
    effusivity: float  # (k rho c)^(1/2) of the solids [W s^(1/2)/(m2 K)]
    log_ratio: float  # ln(eta0/kappa), kappa of Roelands
    Z: float  # of Roelands
    modulus: float
    modulus_slope: float
    modulus_turn: float
    slope_turn: float
    warmth: float  # as in `FilmGroups`, and so on
    conductivity: float
    capacity: float
    rate: float  # ln(eta0/E*), u and R_x in m/s and m
    heat: float  # ln(beta eta0/k), u in m/s


class PressedOil(NamedTuple):
    """An oil under pressure at the inlet's temperature."""

    log_ratio: float  # ln(eta/eta0) [-]
    decline: float  # -d ln eta/dT [1/K]
    stress: float  # Eyring stress [Pa]


@kernel
def _pressed(
    p: float,
    log_ratio: float,
    beta: float,
    Z: float,
    factor: tuple[float, float, float, float],
) -> tuple[float, float]:
    A, B, A_turn, B_turn = factor
    if A > 0.0:
        below = A + B * p
        return p / below, beta + p * (A_turn + B_turn * p) / (below * below)
    growth = math.exp(Z * math.log(1.0 + ROELANDS_PRESSURE * p))
    return log_ratio * (growth - 1.0), beta * growth


@kernel
def oil_under(p: float, inlet: FilmInlet) -> PressedOil:
    """Return the oil of an inlet under a pressure [Pa].

    ln(eta/eta0) = p/(A + B p), or ln(eta0/kappa) [(1 + 5.1e-9 p)^Z - 1] without A;
    Eyring stress 2 Lambda p/ln(eta/eta0), or the constant tau0 without Lambda

    Notes
    -----
    Source of the laws: [arana_2019 (30)]
    [roelands_1966] [houpert_1985]; of the stress: [bair_winer_1990].
    """
    factor = inlet.modulus, inlet.modulus_slope, inlet.modulus_turn, inlet.slope_turn
    ratio, decline = _pressed(p, inlet.log_ratio, inlet.beta, inlet.Z, factor)
    stress = inlet.tau0
    if inlet.eyring_slope > 0.0:
        stress = 2.0 * inlet.eyring_slope * p / ratio
    return PressedOil(ratio, decline, stress)


@kernel
def film_inlet(
    oil: Any,
    contact_modulus: float,
    slope: float,
    solid: tuple[float, float],
    volume_heat: float,
    limiting_stress: float,
    limiting_slope: float,
) -> FilmInlet:
    """Return the numbers of oil and solids.

    alpha = [integral of eta0/eta over p]^-1

    Parameters
    ----------
    oil
        `LubricantState` or a contact.
    contact_modulus
        E* [Pa].
    slope
        Of ln eta at ambient pressure by Roelands [1/Pa]; idle with a modulus.
    solid
        Conductivity [W/(m K)], heat capacity by volume [J/(m3 K)].
    volume_heat
        Heat capacity of the oil by volume [J/(m3 K)].
    limiting_stress, limiting_slope
        Of the oil at ambient pressure [Pa], and its slope with pressure [-].

    Notes
    -----
    The integral by ten points of Gauss and Laguerre: within 1e-3.
    """
    log_ratio = math.log(oil.eta0 / ROELANDS_KAPPA)
    Z = slope / (ROELANDS_PRESSURE * log_ratio)
    factor = oil.modulus, oil.modulus_slope, oil.modulus_turn, oil.slope_turn
    steep = 1.0 / oil.modulus if oil.modulus > 0.0 else slope
    thin = 0.0
    for i in range(_LAGUERRE.shape[0]):
        x = _LAGUERRE[i, 0]
        thin += _LAGUERRE[i, 1] * math.exp(
            x - _pressed(x / steep, log_ratio, oil.beta, Z, factor)[0]
        )
    alpha = steep / thin
    return FilmInlet(
        contact_modulus,
        oil.eta0,
        alpha,
        oil.beta,
        oil.tau0,
        oil.eyring_slope,
        limiting_stress,
        limiting_slope,
        oil.conductivity,
        math.sqrt(solid[0] * solid[1]),
        log_ratio,
        Z,
        oil.modulus,
        oil.modulus_slope,
        oil.modulus_turn,
        oil.slope_turn,
        math.log(oil.beta * oil.temperature),
        math.log(oil.conductivity / solid[0]),
        math.log(volume_heat / solid[1]),
        math.log(oil.eta0 / contact_modulus),
        math.log(oil.beta * oil.eta0 / oil.conductivity),
    )


@kernel
def model_inlet(oil: Any, solid: Any, limiting_slope: float) -> FilmInlet:
    """Return oil and solids as the film model takes them, from `LubricantState` and solid.

    The limiting slope is that of the film's shear stress over pressure [-]; 0: none.
    """
    of_solid = solid.conductivity, solid.density * solid.heat_capacity
    return film_inlet(
        oil, solid.contact_modulus, oil.slope, of_solid, oil.volume_heat, 0.0, limiting_slope
    )


@kernel
def contact_inlet(contact: Any) -> FilmInlet:
    """Return the inlet of a contact: `FilmContact`, or another tuple with the same names."""
    c = contact
    of_solid = c.solid_conductivity, c.solid_heat_capacity
    return film_inlet(
        c,
        c.contact_modulus,
        c.alpha,
        of_solid,
        c.heat_capacity,
        c.limiting_stress,
        c.limiting_slope,
    )


@kernel
def inlet_cooling(speed: float, inlet: FilmInlet) -> float:
    """Return the factor by which heat at the inlet thins a film, 3.94/(3.94 + Lt^0.62) [-].

    Source: [murch_wilson_1975], as of `grubin_1949`.
    """
    return 3.94 / (3.94 + math.exp(0.62 * (inlet.heat + 2.0 * math.log(speed))))
