"""Friction torque of a tapered roller bearing by a named law, with its error bar."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.bearings.losses.catalogue import drag_torque, skf_torque
from gearlube_core.bearings.losses.geometry import BearingGeometry
from gearlube_core.bearings.losses.laws import (
    CATALOGUE_LAWS,
    DEFAULT_LAW,
    HEATINGS,
    LAWS,
    RACE_LAWS,
    ROLLING,
    USUAL_HEATING,
)
from gearlube_core.bearings.losses.physical_loss import LossSettings, physical_loss
from gearlube_core.bearings.losses.race_rolling import roller_film_model
from gearlube_core.bearings.losses.rib import (
    RIB_FRICTION_FACTOR,
    RIB_ROUGHNESS_FACTOR,
    RibParameters,
    rib_friction,
)
from gearlube_core.bearings.roller_loads import LARGEST_RATIO, ring_loads
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import of_kind
from gearlube_core.film_model.model import ROLLER, FilmModel
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import LubricantState

# Factors of the error bar, k = 2. A priori 2: the state of lubrication is not known. More where
# the misfits of measured bearings ask for it, see docs/bearing.md.
UNCALIBRATED = {one.name: one.factor for one in ROLLING} | {
    "palmgren": 3.0,
    "skf": 5.5,
    "solved_films": 5.5,
}
CALIBRATED = 1.25  # with a measured torque of the bearing
LARGEST_PRESSURE = 4e9  # Pa, static limit of rolling bearings with line contact
LARGEST_SPEED_FACTOR = 1500.0 * math.pi / 30.0  # m rad/s: n d_m of 1.5e6 mm/min
PARTS = ("rolling", "sliding", "rib", "drag", "hysteresis", "viscous", "load")


@dataclass(frozen=True, slots=True, kw_only=True)
class LossModel:
    """Law and oil supply by which `bearing_loss` computes the friction of a bearing.

    Parameters
    ----------
    law : str
        One of `laws.LAWS`.
    heating : str, optional
        Inlet heating of the raceways, one of `laws.HEATINGS`; default: the one that belongs to the
        law.
    inlet_layer : float
        Thickness of the oil at the inlet of the raceways, on both surfaces together [m]; 0:
        flooded.
    temperature_rise : float
        Temperature of the oil at the contacts above the given temperature [K].
    film_model : FilmModel, optional
        Of rollers, for the law "solved_films"; default: the one in the package.

    Examples
    --------
    >>> LossModel(law="biboulet_houpert", inlet_layer=5e-6).law
    'biboulet_houpert'
    """

    law: str = DEFAULT_LAW
    heating: str | None = None
    inlet_layer: float = 0.0
    temperature_rise: float = 0.0
    film_model: FilmModel | None = None

    def __post_init__(self) -> None:
        check_option("law", self.law, LAWS)
        if self.heating is not None:
            check_option("heating", self.heating, HEATINGS)
        check_within("inlet_layer", self.inlet_layer, 0.0, 1e-2, "m", "1 um is 1e-6 m.")
        check_within("temperature_rise", self.temperature_rise, 0.0, 100.0, "K")
        if self.law == "solved_films" and self.heating not in (None, "none"):
            raise ParameterError(
                "heating must be none with the law solved_films, whose films are heated by "
                f"themselves, got {self.heating}. Leave it out."
            )
        if self.film_model is not None:
            if self.law != "solved_films":
                raise ParameterError(
                    "A film model must come with the law solved_films, got "
                    f"{self.film_model.name} with {self.law}. Leave it out, or take that law."
                )
            of_kind(self.film_model, ROLLER, "film_model")
        if self.law in CATALOGUE_LAWS and (self.heating or self.inlet_layer):
            raise ParameterError(
                f"The law {self.law} takes no heating and no inlet layer, got "
                f"{self.heating or 'none'} and {self.inlet_layer:g} m. Leave them out, or take one "
                f"of {', '.join(RACE_LAWS)}."
            )


class BearingLoss(NamedTuple):
    """Friction of a bearing at one speed, load and temperature; SI."""

    torque: float  # at the shaft [N m]
    power: float  # [W]
    parts: dict[str, float]  # torque of each part that the law knows [N m]
    factor: float  # error bar, k = 2: the torque lies within torque/factor to torque factor [-]
    film_ratio: float  # smallest of the raceways, flooded; nan for a catalogue law [-]
    rib_film_ratio: float  # likewise at the rib [-]
    rib_friction: float  # likewise, coefficient of the most loaded roller [-]
    out_of_range: float  # share of the loaded contacts outside the range of the law [-]


def bearing_loss(
    geometry: BearingGeometry,
    oil: Lubricant,
    model: LossModel,
    *,
    speed: float,
    axial_load: float,
    radial_load: float,
    temperature: float,
) -> BearingLoss:
    """Return torque and power loss of a tapered roller bearing at one operating point.

    Parameters
    ----------
    geometry : BearingGeometry
    oil : Lubricant
    model : LossModel
    speed : float
        Speed of the shaft, not negative; the outer ring does not turn [rad/s].
    axial_load, radial_load : float
        Load on the whole bearing [N].
    temperature : float
        Temperature of the oil in the bearing [K].

    Raises
    ------
    ParameterError
        A number is outside the range of the law, the oil or the bearing.

    Notes
    -----
    The error bar is at least a factor of 2 (k = 2) for a bearing that was not calibrated, because
    the state of lubrication is not known. Laws that differ more from measured bearings have a wider
    one, see `UNCALIBRATED`. With `rolling_scale` from a measured torque it is 1.25 for the laws of
    the raceways. Friction and roughness of the rib widen it where the rib takes much of the torque.

    Examples
    --------
    >>> from gearlube_core.bearings.bearing_file import BearingFile
    >>> bearing = BearingFile.named("wingertszahn_2023").geometry()
    >>> loss = bearing_loss(bearing, Lubricant.named("fva_3"), LossModel(), speed=209.4,
    ...                     axial_load=6000.0, radial_load=0.0, temperature=323.15)
    >>> round(loss.torque, 1), loss.factor  # N m, error bar
    (2.7, 3.0)
    """
    check_condition(geometry, oil, model, speed, axial_load, radial_load, temperature)
    state = oil.state(temperature + model.temperature_rise)
    rows = geometry.rows
    F_a, F_r = axial_load / rows, radial_load / rows
    factor = UNCALIBRATED[model.law]
    nan = math.nan
    if model.law == "skf":
        rolling, sliding = skf_torque(speed, F_a, F_r, state.nu, geometry.dry_rollers())
        parts = {"rolling": rows * rolling, "sliding": rows * sliding}
        return _sum(parts, speed, factor, (nan, nan, nan, 0.0))
    if model.law == "palmgren":
        p = geometry.dry_rollers()
        # the load part vanishes without load, at the same speed
        whole = drag_torque(speed, F_a, 0.0, state.nu, p)
        viscous = drag_torque(speed, 0.0, 0.0, state.nu, p)
        parts = {"viscous": rows * viscous, "load": rows * (whole - viscous)}
        return _sum(parts, speed, factor, (nan, nan, nan, 0.0))
    loads = np.zeros(geometry.n_rollers)
    ring_loads(F_a, F_r, geometry.dry_rollers(), loads)
    settings = LossSettings(
        RACE_LAWS[model.law],
        HEATINGS[model.heating or USUAL_HEATING[model.law]],
        float(model.inlet_layer),
    )
    numbers = roller_film_model(model.law, model.film_model)
    row = geometry.parameters()
    found = physical_loss(row, settings, loads, float(speed), state, numbers)
    per = rows / speed if speed > 0.0 else 0.0
    parts = {
        "rolling": per * (found.inner + found.outer),
        "rib": per * found.rib,
        "drag": per * found.drag,
        "hysteresis": per * found.hysteresis,
    }
    if geometry.rolling_scale is not None:
        factor = CALIBRATED
    if found.rib > 0.0:
        share = parts["rib"] / sum(parts.values())
        load = row.rib_share * float(loads.max())
        error = _rib_error(row.rib, load, float(speed), state, share)
        factor = math.exp(math.hypot(math.log(factor), error))
    return _sum(
        parts,
        speed,
        factor,
        (found.film_ratio, found.rib_film_ratio, found.rib_friction, found.out_of_range),
    )


def _rib_error(
    rib: RibParameters, load: float, speed: float, oil: LubricantState, share: float
) -> float:
    """Return the logarithm of the factor (k = 2) on the torque that data of the rib leave open.

    `load` [N] is that of the most loaded roller end, `share` that of the rib in the torque [-].
    """
    mu = rib_friction(rib, load, speed, oil).coefficient
    upper = (
        rib._replace(boundary_friction=RIB_FRICTION_FACTOR * rib.boundary_friction),
        rib._replace(roughness=RIB_ROUGHNESS_FACTOR * rib.roughness),
    )
    changes = [rib_friction(one, load, speed, oil).coefficient / mu - 1.0 for one in upper]
    return math.hypot(*(math.log1p(share * change) for change in changes))


def _sum(
    parts: dict[str, float], speed: float, factor: float, rest: tuple[float, float, float, float]
) -> BearingLoss:
    torque = sum(parts.values())
    return BearingLoss(torque, torque * speed, parts, factor, *rest)


def check_condition(
    geometry: BearingGeometry,
    oil: Lubricant,
    model: LossModel,
    speed: float,
    axial_load: float,
    radial_load: float,
    temperature: float,
) -> None:
    """Raise ParameterError where a condition of `bearing_loss` is out of range."""
    most = LARGEST_SPEED_FACTOR / geometry.pitch_diameter
    rpm = 30.0 / math.pi
    cure = f"That is {most * rpm:.4g} rpm, 1.5e6 mm/min on the pitch diameter."
    check_within("speed", speed, 0.0, most, "rad/s", cure)
    cure = "A tapered roller bearing needs an axial load, of its pair or from outside."
    check_within("axial_load", axial_load, 1e-3, 1e8, "N", cure)
    check_within("radial_load", radial_load, 0.0, 1e8, "N", "6 kN is 6000 N.")
    oil.check_temperature(temperature)
    if model.temperature_rise:
        oil.check_temperature(
            temperature + model.temperature_rise, "temperature with temperature_rise"
        )
    tan = math.tan(geometry.outer_angle)
    if radial_load * tan > LARGEST_RATIO * axial_load:
        raise ParameterError(
            f"axial_load must be at least {radial_load * tan / LARGEST_RATIO:.4g} N to balance "
            f"radial_load {radial_load:g} N, got {axial_load:g} N: with less, fewer than half of "
            "the rollers carry load and the rings separate. Give more axial load."
        )
    loads = np.zeros(geometry.n_rollers)
    rows = geometry.rows
    ring_loads(axial_load / rows, radial_load / rows, geometry.dry_rollers(), loads)
    p = geometry.parameters()
    q = float(loads.max()) / p.length
    pressure = math.sqrt(q * p.reduced_modulus / (2.0 * math.pi * p.R_inner))
    if pressure > LARGEST_PRESSURE:
        share = (LARGEST_PRESSURE / pressure) ** 2
        raise ParameterError(
            "The load must leave the largest pressure on the inner race below "
            f"{1e-9 * LARGEST_PRESSURE:g} GPa, got {1e-9 * pressure:.3g} GPa from axial_load "
            f"{axial_load:g} N and radial_load {radial_load:g} N. Use at most {share:.2g} of this "
            "load."
        )
