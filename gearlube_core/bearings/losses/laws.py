"""The named laws of the raceways and of inlet heating, by code for kernels."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final, NamedTuple

from numba.extending import register_jitable

from gearlube_core.film.biboulet_houpert_2010 import IN_RANGE, biboulet_houpert_force
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.kernels.jit import kernel


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


class RollingLaw(NamedTuple):
    """A law of rolling of the raceways; all that names such laws takes them from `ROLLING`."""

    name: str  # of authors; of `gearlube bearing`
    force: Callable[..., tuple[float, int]]  # a kernel, see `rolling_force`
    heating: str  # the inlet heating that it is used with, once
    factor: float  # of its error bar, see `loss.UNCALIBRATED`
    in_axle: str = ""  # its name as an option of the axle; "": none

    @property
    def words(self) -> str:
        """Its authors for figures."""
        return " and ".join(author.capitalize() for author in self.name.split("_"))


# the code of a law for kernels is its place
ROLLING = (
    RollingLaw("biboulet_houpert", biboulet_houpert_force, "aihara", 5.0, "biboulet_houpert_2010"),
    RollingLaw("zhou_hoeprich", zhou_hoeprich_force, "zhu_cheng", 2.0, "zhou_hoeprich_1991"),
    RollingLaw("goksem_hargreaves", goksem_hargreaves_force, "aihara", 2.5),
    RollingLaw("aihara", aihara_force, "aihara", 3.0, "aihara_1987"),
)
ROLLING_LAWS = {one.name: code for code, one in enumerate(ROLLING)}
# films by a film model, see `race_rolling`; for contacts that `rolling_force` does not know
SOLVED_FILMS = -1
RACE_LAWS = {**ROLLING_LAWS, "solved_films": SOLVED_FILMS}
MATERIAL_LIMIT_WORDS = "M 0.2 to 200, L 4 to 16"  # range of biboulet_houpert_2010
CATALOGUE_LAWS = ("palmgren", "skf")
PALMGREN, SKF = 0, 1  # of them, for kernels
LAWS = (*RACE_LAWS, *CATALOGUE_LAWS)
# of `gearlube bearing`, of axles and of their FMU: it needs no more than a catalogue has
DEFAULT_LAW: Final = "palmgren"

NO_HEATING, AIHARA_HEATING, ZHU_CHENG_HEATING = 0, 1, 2
HEATINGS = {"none": NO_HEATING, "aihara": AIHARA_HEATING, "zhu_cheng": ZHU_CHENG_HEATING}
USUAL_HEATING = {one.name: one.heating for one in ROLLING} | {"solved_films": "none"}


def _force_by_code(code: int) -> Any:
    """Return the force of the law of a code or below: which, says its first argument."""
    force = ROLLING[code].force
    if code == 0:
        return register_jitable(lambda law, *contact: force(*contact))
    below = _force_by_code(code - 1)

    @register_jitable
    def chosen(law: int, *contact: float) -> Any:
        if law == code:
            return force(*contact)
        return below(law, *contact)

    return chosen


def number_at(numbers: Sequence[int]) -> Any:
    """Return a function for kernels: the number at a place, the first one at any other.

    An index could raise, and native code has nobody who would take that.
    """
    *before, last = numbers
    if not before:
        return register_jitable(lambda place: last)
    below, here = number_at(before), len(before)
    return register_jitable(lambda place: last if place == here else below(place))


_force = _force_by_code(len(ROLLING) - 1)
_heating = number_at([HEATINGS[one.heating] for one in ROLLING])


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
    return _force(law, R, line_load, reduced_modulus, eta0, alpha, speed)  # type: ignore[no-any-return]


@kernel
def usual_heating(law: int) -> int:
    """Return the code of the inlet heating that a law of rolling is used with."""
    return _heating(law)  # type: ignore[no-any-return]


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
