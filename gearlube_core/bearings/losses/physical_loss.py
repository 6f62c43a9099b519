"""Losses of a tapered roller bearing, summed over its rollers."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.losses.race_rolling import race_rolling
from gearlube_core.bearings.losses.rib import RibParameters, rib_friction
from gearlube_core.bearings.losses.rolling import hysteresis_power, liebrecht_drag, rolling_power
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_starvation
from gearlube_core.film_model.inlet import model_inlet
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


class LossParameters(NamedTuple):
    """One row of a tapered roller bearing; all floats, SI."""

    n_rollers: float  # integral [-]
    length: float  # of a roller [m]
    diameter: float  # of a roller at its middle [m]
    pitch: float  # diameter through the middles of the rollers [m]
    cage_ratio: float  # cage speed over shaft speed [-]
    mean_ratio: float  # mean surface speed of the raceways over shaft speed [m]
    R_inner: float  # relative radius at the inner race [m]
    R_outer: float  # relative radius at the outer race [m]
    inner_share: float  # load of the inner race over that of the outer, cos(2 b) [-]
    rib_share: float  # load of the rib over that of the outer race, sin(2 b) [-]
    reduced_modulus: float  # E' [Pa]
    roughness: float  # of the raceways, composite rms [m]
    rolling_scale: float  # measured over computed rolling torque; 1: not calibrated
    rib: RibParameters
    solid: SolidParameters  # of rollers and races


class LossSettings(NamedTuple):
    """How the raceways are computed."""

    law: int  # of RACE_LAWS
    heating: int  # of HEATINGS
    inlet_layer: float  # oil at the inlet of the raceways [m]; 0: flooded


class PhysicalLoss(NamedTuple):
    """Losses of one row; all floats, SI, no negative number."""

    inner: float  # rolling on the inner race [W]
    outer: float  # rolling on the outer race [W]
    rib: float  # [W]
    drag: float  # [W]
    hysteresis: float  # [W]
    film_ratio: float  # smallest of the raceways, flooded [-]
    rib_film_ratio: float  # smallest [-]
    rib_friction: float  # of the most loaded roller [-]
    rib_share: float  # of the load on asperities, largest [-]
    out_of_range: float  # share of the loaded contacts outside the range of the law [-]


@kernel
def physical_loss(
    b: LossParameters,
    settings: LossSettings,
    loads: Array,
    speed: float,
    oil: LubricantState,
    film_model: Array,
) -> PhysicalLoss:
    """Return the losses of one row of a tapered roller bearing.

    P = sum over rollers and races of 2 F u l + rib + drag + hysteresis

    Parameters
    ----------
    b
        Numbers of the roller bearing.
    settings
        Law, heating, inlet layer.
    loads : ndarray, shape (>= n_rollers,)
        Q of each roller on the outer race [N]; 0 without contact.
    speed
        Of the shaft, not negative [rad/s].
    oil
        At the temperature of the inlet.
    film_model : ndarray
        Numbers of the film model of rollers, written into; empty without the law of solved films.

    Returns
    -------
    PhysicalLoss
        All zero at rest.

    Notes
    -----
    Each contact is heated once and starved once, F = F_flooded phi s. The drag torque counts at the
    shaft.
    """
    inner = outer = rib = hysteresis = mu = share = out = 0.0
    film_ratio = rib_ratio = math.inf
    if speed <= 0.0:
        return PhysicalLoss(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    u = b.mean_ratio * speed
    inlet = model_inlet(oil, b.solid, 0.0)
    contacts = 0
    most = 0.0
    for i in range(int(b.n_rollers)):
        Q_outer = loads[i]
        if Q_outer <= 0.0:
            continue
        for race in range(2):
            Q = Q_outer if race == 0 else b.inner_share * Q_outer
            R = b.R_outer if race == 0 else b.R_inner
            q = Q / b.length
            E = b.reduced_modulus
            found = race_rolling(
                settings.law, settings.heating, R, q, u, oil, b.solid, inlet, film_model
            )
            starved = biboulet_houpert_starvation(settings.inlet_layer, found.film)
            power = rolling_power(found.force * starved, u, b.length)
            if race == 0:
                outer += power
            else:
                inner += power
            hysteresis += hysteresis_power(Q, q, R, E, u)
            film_ratio = min(film_ratio, found.film / b.roughness)
            contacts += 1
            out += found.outside
        end = rib_friction(b.rib, b.rib_share * Q_outer, speed, oil)
        rib += end.power
        rib_ratio = min(rib_ratio, end.film_ratio)
        share = max(share, end.asperity_share)
        if Q_outer > most:
            most = Q_outer
            mu = end.coefficient
    if contacts == 0:
        film_ratio = rib_ratio = 0.0
    turns = b.cage_ratio * speed / (2.0 * math.pi)
    drag = speed * liebrecht_drag(oil.eta0 / oil.nu, oil.nu, b.length, b.diameter, b.pitch, turns)
    return PhysicalLoss(
        b.rolling_scale * inner,
        b.rolling_scale * outer,
        rib,
        drag,
        hysteresis,
        film_ratio,
        rib_ratio,
        mu,
        share,
        out / max(contacts, 1),
    )
