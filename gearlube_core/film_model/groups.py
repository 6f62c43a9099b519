"""Dimensionless groups of one elliptical contact with a thermal Eyring film."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.contact.hertz import ellipticity, hertz_coefficients
from gearlube_core.film.point_film import central_film_thickness, film_geometry
from gearlube_core.film_model.inlet import FilmInlet, contact_inlet, inlet_cooling, oil_under
from gearlube_core.kernels.jit import kernel

LEAST_LOAD = 1e-3  # N, film and pressure of an unloaded contact are those at this load
LEAST_SPEED = 1e-6  # m/s, the same of a resting one
THIN = 2.0 / 3.0  # the inlet's length goes with the film to this power
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
    alpha: float  # slope of ln eta at ambient pressure by Roelands [1/Pa]; idle with a modulus
    beta: float  # -d ln eta0/dT [1/K]
    tau0: float  # Eyring stress [Pa]; idle with an Eyring slope
    limiting_stress: float  # of the oil at ambient pressure [Pa]; with the slope 0: none
    limiting_slope: float  # its slope with pressure [-]
    temperature: float  # of oil and solids at the inlet [K]
    conductivity: float  # of the oil [W/(m K)]
    heat_capacity: float  # of the oil by volume, density times specific [J/(m3 K)]
    solid_conductivity: float  # [W/(m K)]
    solid_heat_capacity: float  # by volume [J/(m3 K)]
    modulus: float = 0.0  # A of the pressure factor at the inlet [Pa]; 0: Roelands and Houpert
    modulus_slope: float = 0.0  # B [-]
    modulus_turn: float = 0.0  # dA/dT [Pa/K]
    slope_turn: float = 0.0  # dB/dT [1/K]
    eyring_slope: float = 0.0  # Lambda [-]; 0: the constant tau0 without a limit


class FilmGroups(NamedTuple):
    """Groups that fix a film; all dimensionless [-], logarithms natural."""

    pressure: float  # ln(p_mean/E*)
    ellipse: float  # ln(a_y/a_x)
    psi: float  # entrainment from the minor axis [rad]
    slide_roll: float  # ln(sliding/entrainment)
    delta: float  # sliding from entrainment [rad], -pi/2 to pi/2
    sharpness: float  # ln(alpha p_mean) - 2/3 thickness: growth of viscosity along the inlet
    shape: float  # ln[ln(eta/eta0)/(alpha p)] at p_mean
    stress: float  # ln(Eyring stress/E*) at p_mean
    limited: float  # 1 with the local Eyring stress and its limit, 0 with a constant one
    rate: float  # ln[eta0 u/(E* R_x)]
    peclet: float  # ln(u R_x rho c/k) of the solids
    cooling: float  # ln of -d ln eta/dT at p_mean over that at ambient pressure
    warmth: float  # ln(beta T0)
    conductivity: float  # ln(k oil/k solids)
    capacity: float  # ln(rho c oil/rho c solids)
    heat: float  # ln(beta eta0 u^2/k) of the oil
    thickness: float  # ln(h R_x/a_x^2)/2: reference film over what the solids flatten


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
    """Groups that depend on the place of a contact on the flank alone; all floats."""

    R_x: float  # [m]
    side_flow: float  # factor of the reference film [-]
    pressure_coefficient: float  # mean Hertz pressure over load^(1/3) [Pa/N^(1/3)]
    psi: float  # entrainment from the minor axis [rad]
    cos_psi: float  # not below 1e-3
    delta: float  # sliding from entrainment, -pi/2 to pi/2 [rad]
    ellipticity: float  # a_y/a_x
    ellipse: float  # ln(a_y/a_x)
    log_R: float  # ln R_x, R_x in m
    peclet: float  # ln(R_x rho c/k) of the solids, u in m/s


@kernel
def film_place(
    R_x: float,
    R_y: float,
    psi: float,
    delta: float,
    ellipticity: float,
    pressure_coefficient: float,
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
        math.log(R_x),
        math.log(R_x * solid_heat_capacity / solid_conductivity),
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
        c.solid_conductivity,
        c.solid_heat_capacity,
    )
    return place, contact_inlet(c)


@kernel
def reference_film(load: float, speed: float, place: FilmPlace, inlet: FilmInlet) -> float:
    """Return the central film that the model corrects [m].

    Chittenden et al. 1985 at psi = 0 with the component u cos(psi), times `inlet_cooling`

    Parameters
    ----------
    load, speed
        Above zero [N], [m/s].
    place, inlet
        From `film_place` and `film_inlet`.
    """
    film = central_film_thickness(
        place.R_x,
        place.side_flow,
        inlet.eta0,
        inlet.alpha,
        speed * place.cos_psi,
        load,
        2.0 * inlet.contact_modulus,
    )
    return film * inlet_cooling(speed, inlet)


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
    """
    log_speed = math.log(speed)
    under = oil_under(p, inlet)
    thickness = math.log(math.sqrt(film * place.R_x) / semi_minor_axis(load, p, place))
    return FilmGroups(
        math.log(p / inlet.contact_modulus),
        place.ellipse,
        place.psi,
        math.log(max(slip, _TINY)) - log_speed,
        place.delta,
        math.log(inlet.alpha * p) - THIN * thickness,
        math.log(under.log_ratio / (inlet.alpha * p)),
        math.log(under.stress / inlet.contact_modulus),
        1.0 if inlet.eyring_slope > 0.0 else 0.0,
        inlet.rate + log_speed - place.log_R,
        place.peclet + log_speed,
        math.log(under.decline / inlet.beta),
        inlet.warmth,
        inlet.conductivity,
        inlet.capacity,
        inlet.heat + 2.0 * log_speed,
        thickness,
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
