"""The named laws of the raceways and of inlet heating, by code for kernels."""

from __future__ import annotations

from typing import Final

from gearlube_core.film.biboulet_houpert_2010 import IN_RANGE, biboulet_houpert_force
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.kernels.jit import kernel

BIBOULET_HOUPERT, ZHOU_HOEPRICH, GOKSEM_HARGREAVES, AIHARA = 0, 1, 2, 3
ROLLING_LAWS = {
    "biboulet_houpert": BIBOULET_HOUPERT,
    "zhou_hoeprich": ZHOU_HOEPRICH,
    "goksem_hargreaves": GOKSEM_HARGREAVES,
    "aihara": AIHARA,
}
# films by a film model, see `race_rolling`; for contacts that `rolling_force` does not know
SOLVED_FILMS = 4
RACE_LAWS = {**ROLLING_LAWS, "solved_films": SOLVED_FILMS}
MATERIAL_LIMIT_WORDS = "M 0.2 to 200, L 4 to 16"  # range of biboulet_houpert_2010
CATALOGUE_LAWS = ("palmgren", "skf", "timken")
PALMGREN, SKF = 0, 1  # of them, for kernels
LAWS = (*RACE_LAWS, *CATALOGUE_LAWS)
# of `gearlube bearing`, of axles and of their FMU: it needs no more than a catalogue has
DEFAULT_LAW: Final = "palmgren"

NO_HEATING, AIHARA_HEATING, ZHU_CHENG_HEATING = 0, 1, 2
HEATINGS = {"none": NO_HEATING, "aihara": AIHARA_HEATING, "zhu_cheng": ZHU_CHENG_HEATING}
# what each law is used with, once
USUAL_HEATING = {
    "biboulet_houpert": "aihara",
    "zhou_hoeprich": "zhu_cheng",
    "goksem_hargreaves": "aihara",
    "aihara": "aihara",
    "solved_films": "none",
}


@kernel
def aihara_force(
    R: float, line_load: float, reduced_modulus: float, eta0: float, alpha: float, speed: float
) -> tuple[float, int]:
    """Return the rolling force of a roller on a race per surface and length, without heating.

    F = 176 (R^2/alpha) (G U)^0.658 W^0.31/(2 R),  U = eta0 u/(E' R),  G = alpha E',
    W = q/(E' R)

    Parameters and returns as in `biboulet_houpert_force`.

    Notes
    -----
    The source gives the rolling moment of a length of roller, fitted to about 200 bearings under
    axial load; divided by 2 R it is the force of either surface. It writes R for the radius of the
    roller, W = 2 F_a/(D l z sin(a) E'), which is q/(E' R) of each roller; with R of either contact
    in its place the sum of both races changes by less than 1 %. It knows no radial load.
    Source: [aihara_1987 (27)]
    """
    size = reduced_modulus * R
    GU = alpha * eta0 * speed / R
    W = line_load / size
    return 176.0 * (R * R / alpha) * GU**0.658 * W**0.31 / (2.0 * R), IN_RANGE


@kernel
def aihara_heating(heating_number: float) -> float:
    """Return the factor by which inlet heating lowers the rolling force.

    phi = 1/(1 + 0.29 Lt^0.78)

    Parameters
    ----------
    heating_number
        Lt = eta0 beta u^2/K, see `groups.inlet_heating_number` [-].

    Notes
    -----
    Made for the rolling force.
    Source: [aihara_1987]
    """
    return 1.0 / (1.0 + 0.29 * heating_number**0.78)


@kernel
def goksem_hargreaves_force(
    R: float, line_load: float, reduced_modulus: float, eta0: float, alpha: float, speed: float
) -> tuple[float, int]:
    """Return the rolling force of a line contact per surface and length.

    F = 4.318 (R/alpha) (G U)^0.658 W^0.0126,  U = eta0 u/(E' R),  G = alpha E',  W = q/(E' R)

    Parameters and returns as in `biboulet_houpert_force`.

    Notes
    -----
    Flooded and isothermal. The range of the fit is not known here; the status is always 0.
    Source: [goksem_hargreaves_1978]
    """
    size = reduced_modulus * R
    GU = alpha * eta0 * speed / R
    W = line_load / size
    return 4.318 * (R / alpha) * GU**0.658 * W**0.0126, IN_RANGE


@kernel
def zhou_hoeprich_force(
    R: float, line_load: float, reduced_modulus: float, eta0: float, alpha: float, speed: float
) -> tuple[float, int]:
    """Return the rolling force of a line contact per surface and length.

    F = 29.2 (R/alpha) (G U)^0.648 W^0.246,  U = eta0 u/(E' R),  G = alpha E',  W = q/(E' R)

    Parameters and returns as in `biboulet_houpert_force`. alpha is the pressure-viscosity
    coefficient of the oil, not the contact angle.

    Notes
    -----
    The range of the fit is not known here; the status is always 0. The law gives about half of
    the force of a flooded film as Reynolds' equation has it (docs/bearing.md).
    Source: [zhou_hoeprich_1991 (17)]
    """
    size = reduced_modulus * R
    GU = alpha * eta0 * speed / R
    W = line_load / size
    return 29.2 * (R / alpha) * GU**0.648 * W**0.246, IN_RANGE


@kernel
def rolling_force(
    law: int,
    R: float,
    line_load: float,
    reduced_modulus: float,
    eta0: float,
    alpha: float,
    speed: float,
) -> tuple[float, int]:
    """Return the cold rolling force of a law per surface and length [N/m], and its status.

    `law` is a value of ROLLING_LAWS; the rest as in `biboulet_houpert_force`.
    """
    if law == ZHOU_HOEPRICH:
        return zhou_hoeprich_force(R, line_load, reduced_modulus, eta0, alpha, speed)
    if law == GOKSEM_HARGREAVES:
        return goksem_hargreaves_force(R, line_load, reduced_modulus, eta0, alpha, speed)
    if law == AIHARA:
        return aihara_force(R, line_load, reduced_modulus, eta0, alpha, speed)
    return biboulet_houpert_force(R, line_load, reduced_modulus, eta0, alpha, speed)


@kernel
def heating_factor(heating: int, heating_number: float, pressure_ratio: float) -> float:
    """Return the factor of inlet heating in pure rolling [-].

    `heating` is a value of HEATINGS; the rest as in `zhu_cheng_heating`.
    """
    if heating == AIHARA_HEATING:
        return aihara_heating(heating_number)
    if heating == ZHU_CHENG_HEATING:
        return zhu_cheng_heating(heating_number, pressure_ratio, 0.0)
    return 1.0
