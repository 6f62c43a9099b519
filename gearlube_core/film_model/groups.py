"""Dimensionless groups of one elliptical contact with a thermal Eyring film."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlube_core.contact.hertz import ellipticity, hertz_coefficients
from gearlube_core.film.point_film import central_film_thickness, film_geometry
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE, ROELANDS_KAPPA, ROELANDS_PRESSURE

LEAST_LOAD = 1e-3  # N, film and pressure of an unloaded contact are those at this load
LEAST_SPEED = 1e-6  # m/s, the same of a resting one
_TINY = 1e-300  # m/s, of sliding
_STEEPEST = 1e-3  # least cos(psi)


class FilmContact(NamedTuple):
    """One elliptical contact of equal solids and its oil at the inlet; all floats, SI.

    Build it with `film_contact`, or fill it where the numbers of the ellipse are known.
    """

    load: float  # [N]
    contact_modulus: float  # E* [Pa]
    R_x: float  # relative radius along the minor axis of the ellipse [m]
    R_y: float  # along the major axis [m]
    ellipticity: float  # major over minor semi-axis [-]
    pressure_coefficient: float  # mean Hertz pressure over load^(1/3) [Pa/N^(1/3)]
    entrainment_speed: float  # mean surface speed [m/s]
    entrainment_angle: float  # from the minor axis, 0 to pi/2 [rad]
    sliding_speed: float  # [m/s]
    sliding_angle: float  # from entrainment, positive away from the minor axis [rad]
    eta0: float  # viscosity at ambient pressure [Pa s]
    alpha: float  # pressure-viscosity coefficient [1/Pa]
    beta: float  # -d ln eta0/dT [1/K]
    tau0: float  # Eyring stress [Pa]
    limiting_stress: float  # of the oil at ambient pressure [Pa]; with the slope 0: none
    limiting_slope: float  # its slope with pressure [-]
    temperature: float  # of oil and solids at the inlet [K]
    conductivity: float  # of the oil [W/(m K)]
    heat_capacity: float  # of the oil by volume, density times specific [J/(m3 K)]
    solid_conductivity: float  # [W/(m K)]
    solid_heat_capacity: float  # by volume [J/(m3 K)]


class FilmGroups(NamedTuple):
    """Groups that fix a film; all dimensionless [-], logarithms natural."""

    pressure: float  # ln(p_mean/E*)
    ellipse: float  # ln(a_y/a_x)
    psi: float  # entrainment from the minor axis [rad]
    slide_roll: float  # ln(sliding/entrainment)
    delta: float  # sliding from entrainment [rad], -pi/2 to pi/2
    viscosity: float  # ln(eta0/kappa), kappa of Roelands
    exponent: float  # ln Z of Roelands
    stress: float  # ln(tau0/E*)
    rate: float  # ln(kappa u/(E* R_x))
    peclet: float  # ln(u R_x rho c/k) of the solids
    cooling: float  # ln S0 of Houpert
    warmth: float  # ln[E*/(rho c (T0 - 138))], rho c of the solids
    conductivity: float  # ln(k oil/k solids)
    capacity: float  # ln(rho c oil/rho c solids)
    heat: float  # ln(beta eta0 u^2/k) of the oil
    thickness: float  # [h R_x/a_x^2]^(1/2): reference film over what the solids flatten


N_GROUPS = len(FilmGroups._fields)


@kernel
def film_contact(
    load: float,
    contact_modulus: float,
    R_x: float,
    R_y: float,
    entrainment: tuple[float, float],
    sliding: tuple[float, float],
    oil: tuple[float, float, float, float, float, float],
    limit: tuple[float, float],
    temperature: float,
    solid: tuple[float, float],
) -> FilmContact:
    """Return a contact from its radii and its velocities along the axes of the ellipse.

    Parameters
    ----------
    load, contact_modulus
        [N], E* [Pa].
    R_x, R_y
        Relative radii along the minor and the major axis, R_x <= R_y [m].
    entrainment, sliding
        Mean surface velocity and difference of the surface velocities along both axes [m/s]; any
        direction.
    oil
        eta0 [Pa s], alpha [1/Pa], beta [1/K], tau0 [Pa], conductivity [W/(m K)], heat capacity by
        volume [J/(m3 K)].
    limit
        Limiting stress at ambient pressure [Pa] and its slope with pressure [-]; (0, 0): none.
    temperature
        [K].
    solid
        Conductivity [W/(m K)], heat capacity by volume [J/(m3 K)].

    Notes
    -----
    A film is the same when an axis is turned round, and when all sliding is turned round: the
    solids are alike.
    """
    u, v = entrainment
    along = sliding[0] if u >= 0.0 else -sliding[0]
    across = sliding[1] if v >= 0.0 else -sliding[1]
    psi = math.atan2(abs(v), abs(u))
    slip = math.hypot(along, across)
    delta = math.atan2(across, along) - psi if slip > 0.0 else 0.0
    k = ellipticity(max(R_x, R_y) / min(R_x, R_y))
    return FilmContact(
        load,
        contact_modulus,
        R_x,
        R_y,
        k,
        hertz_coefficients(R_x, R_y, contact_modulus)[2],
        math.hypot(u, v),
        psi,
        slip,
        delta,
        oil[0],
        oil[1],
        oil[2],
        oil[3],
        limit[0],
        limit[1],
        temperature,
        oil[4],
        oil[5],
        solid[0],
        solid[1],
    )


class FilmPlace(NamedTuple):
    """What depends on the place of a contact on the flank alone; all floats."""

    R_x: float  # [m]
    side_flow: float  # factor of the reference film [-]
    pressure_coefficient: float  # mean Hertz pressure over load^(1/3) [Pa/N^(1/3)]
    psi: float  # entrainment from the minor axis [rad]
    cos_psi: float  # not below 1e-3
    delta: float  # sliding from entrainment, -pi/2 to pi/2 [rad]
    ellipticity: float  # a_y/a_x
    ellipse: float  # ln(a_y/a_x)
    rate: float  # ln[kappa/(E* R_x)], u in m/s
    peclet: float  # ln(R_x rho c/k) of the solids, u in m/s


class FilmInlet(NamedTuple):
    """What depends on oil and solids alone; all floats."""

    contact_modulus: float  # E* [Pa]
    eta0: float  # [Pa s]
    alpha: float  # [1/Pa]
    beta: float  # [1/K]
    tau0: float  # [Pa]
    limiting_stress: float  # [Pa]
    limiting_slope: float  # [-]
    oil_conductivity: float  # [W/(m K)]
    effusivity: float  # (k rho c)^(1/2) of the solids [W s^(1/2)/(m2 K)]
    Z: float  # of Roelands
    viscosity: float  # as in `FilmGroups`, and so on
    exponent: float
    stress: float
    cooling: float
    warmth: float
    conductivity: float
    capacity: float
    heat: float  # ln(beta eta0/k), u in m/s


@kernel
def film_place(
    R_x: float,
    R_y: float,
    psi: float,
    delta: float,
    ellipticity: float,
    pressure_coefficient: float,
    contact_modulus: float,
    solid_conductivity: float,
    solid_heat_capacity: float,
) -> FilmPlace:
    """Return the numbers of a place; arguments as the fields of `FilmContact`.

    Sliding angles are folded to -pi/2 to pi/2: the solids are alike.
    """
    return FilmPlace(
        R_x,
        film_geometry(R_x, R_y, 0.0)[1],
        pressure_coefficient,
        psi,
        max(abs(math.cos(psi)), _STEEPEST),
        delta - math.pi * math.floor(delta / math.pi + 0.5),
        ellipticity,
        math.log(ellipticity),
        math.log(ROELANDS_KAPPA / (contact_modulus * R_x)),
        math.log(R_x * solid_heat_capacity / solid_conductivity),
    )


@kernel
def film_inlet(
    contact_modulus: float,
    eta0: float,
    alpha: float,
    beta: float,
    tau0: float,
    limiting_stress: float,
    limiting_slope: float,
    temperature: float,
    conductivity: float,
    heat_capacity: float,
    solid_conductivity: float,
    solid_heat_capacity: float,
) -> FilmInlet:
    """Return the numbers of oil and solids; arguments as the fields of `FilmContact`.

    ln(eta/kappa) = ln(eta0/kappa) (1 + 5.1e-9 p)^Z [(T - 138)/(T0 - 138)]^(-S0),
    Z = alpha/[5.1e-9 ln(eta0/kappa)],  S0 = beta (T0 - 138)/ln(eta0/kappa)

    Notes
    -----
    Source of the law: [roelands_1966]; [houpert_1985].
    """
    ratio = math.log(eta0 / ROELANDS_KAPPA)
    Z = alpha / (ROELANDS_PRESSURE * ratio)
    above = temperature - GLASS_TEMPERATURE
    return FilmInlet(
        contact_modulus,
        eta0,
        alpha,
        beta,
        tau0,
        limiting_stress,
        limiting_slope,
        conductivity,
        math.sqrt(solid_conductivity * solid_heat_capacity),
        Z,
        ratio,
        math.log(Z),
        math.log(tau0 / contact_modulus),
        math.log(beta * above / ratio),
        math.log(contact_modulus / (solid_heat_capacity * above)),
        math.log(conductivity / solid_conductivity),
        math.log(heat_capacity / solid_heat_capacity),
        math.log(beta * eta0 / conductivity),
    )


@kernel
def contact_inlet(contact: Any) -> FilmInlet:
    """Return the inlet of a contact: `FilmContact`, or another tuple with the same names."""
    c = contact
    return film_inlet(
        c.contact_modulus,
        c.eta0,
        c.alpha,
        c.beta,
        c.tau0,
        c.limiting_stress,
        c.limiting_slope,
        c.temperature,
        c.conductivity,
        c.heat_capacity,
        c.solid_conductivity,
        c.solid_heat_capacity,
    )


@kernel
def contact_parts(contact: FilmContact) -> tuple[FilmPlace, FilmInlet]:
    """Return place and inlet of a contact."""
    c = contact
    place = film_place(
        c.R_x,
        c.R_y,
        c.entrainment_angle,
        c.sliding_angle,
        c.ellipticity,
        c.pressure_coefficient,
        c.contact_modulus,
        c.solid_conductivity,
        c.solid_heat_capacity,
    )
    return place, contact_inlet(c)


@kernel
def reference_film(load: float, speed: float, place: FilmPlace, inlet: FilmInlet) -> float:
    """Return the central film that the model corrects [m].

    Chittenden et al. 1985 at psi = 0 with the component u cos(psi)

    Parameters
    ----------
    load, speed
        Above zero [N], [m/s].
    place, inlet
        From `film_place` and `film_inlet`.
    """
    return central_film_thickness(
        place.R_x,
        place.side_flow,
        inlet.eta0,
        inlet.alpha,
        speed * place.cos_psi,
        load,
        2.0 * inlet.contact_modulus,
    )


@kernel
def semi_minor_axis(load: float, p: float, place: FilmPlace) -> float:
    """Return the dry semi-axis along the minor axis [m] at load [N] and mean pressure p [Pa]."""
    return math.sqrt(load / (math.pi * p * place.ellipticity))


@kernel
def film_groups(
    film: float,
    load: float,
    p: float,
    speed: float,
    slip: float,
    place: FilmPlace,
    inlet: FilmInlet,
) -> FilmGroups:
    """Return the groups of a contact.

    Parameters
    ----------
    film
        `reference_film` [m].
    load
        Above zero [N].
    p
        Mean Hertz pressure, above zero [Pa].
    speed, slip
        Amounts of entrainment, above zero, and of sliding [m/s].
    place, inlet
        From `film_place` and `film_inlet`.

    Notes
    -----
    With steel E* 5.1e-9 1/Pa is a constant; other solids are other films, see `FilmModel`.
    """
    log_speed = math.log(speed)
    return FilmGroups(
        math.log(p / inlet.contact_modulus),
        place.ellipse,
        place.psi,
        math.log(max(slip, _TINY)) - log_speed,
        place.delta,
        inlet.viscosity,
        inlet.exponent,
        inlet.stress,
        place.rate + log_speed,
        place.peclet + log_speed,
        inlet.cooling,
        inlet.warmth,
        inlet.conductivity,
        inlet.capacity,
        inlet.heat + 2.0 * log_speed,
        math.sqrt(film * place.R_x) / semi_minor_axis(load, p, place),
    )


@kernel
def contact_groups(contact: FilmContact) -> FilmGroups:
    """Return the groups of a contact."""
    place, inlet = contact_parts(contact)
    load = max(contact.load, LEAST_LOAD)
    p = place.pressure_coefficient * math.exp(math.log(load) / 3.0)
    speed = max(contact.entrainment_speed, LEAST_SPEED)
    film = reference_film(load, speed, place, inlet)
    return film_groups(film, load, p, speed, contact.sliding_speed, place, inlet)
