"""The named laws of the raceways and of inlet heating, by code for kernels."""

from __future__ import annotations

from typing import Final

from gearlube_core.bearings.losses.aihara_1987 import aihara_force, aihara_heating
from gearlube_core.bearings.losses.goksem_hargreaves_1978 import goksem_hargreaves_force
from gearlube_core.bearings.losses.zhou_hoeprich_1991 import zhou_hoeprich_force
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
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
