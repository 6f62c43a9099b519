"""From the numbers of a data sheet to those of a lubricant, each with where it is from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_units import field_unit
from gearlube_core.input_file.input_file import InputNote, Origin
from gearlube_core.oil.base_oils import (
    BASE_OILS,
    BOUNDARY_FRICTION,
    BOUNDARY_STRESS,
    EYRING_FACTOR,
    GIVEN_LIMIT_FACTOR,
    GROWTH,
    HIGH_PRESSURE_FACTOR,
    MEASURED_ALPHA_FACTOR,
    REFERENCE_DENSITY_DEGC,
    UNKNOWN_ALPHA_SPREAD,
)
from gearlube_core.oil.pressure_coefficients import MEAN_PRESSURE, AlphaIs
from gearlube_core.oil.walther_1931 import (
    MM2_S,
    walther_coefficients,
    walther_kinematic_viscosity,
)
from gearlube_core.units import celsius_to_kelvin

INDEX_RANGE = (0.0, 400.0)
# [astm_d2270 Table X2.1]: from nu of 100 degC [mm2/s] on; a, b, c of L; d, e, f of H
_ROWS = (
    (2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
    (3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
    (4.4, 2.5, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
    (5.0, 0.101, 16.635, -45.469, 0.04985, 9.1613, -18.557),
    (6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
    (7.0, 0.01191, 21.475, -72.87, 0.79762, -0.7321, 14.61),
    (7.7, 0.41858, 16.1558, -56.04, 0.05794, 10.5156, -28.24),
    (9.0, 0.88779, 7.5527, -16.6, 0.26665, 6.7015, -10.81),
    (12.0, 0.7672, 10.7972, -38.18, 0.20073, 8.4658, -22.49),
    (15.0, 0.97305, 5.3135, -2.2, 0.28889, 5.9741, -4.93),
    (18.0, 0.97256, 5.25, -0.98, 0.24504, 7.416, -16.73),
    (22.0, 0.91413, 7.4759, -21.82, 0.20323, 9.1267, -34.23),
    (28.0, 0.87031, 9.7157, -50.77, 0.18411, 10.1015, -46.75),
    (40.0, 0.84703, 12.6752, -133.31, 0.17029, 11.4866, -80.62),
    (55.0, 0.85921, 11.1009, -83.19, 0.1713, 11.368, -76.94),
    (70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
)
_SLOPE = 0.00715  # of the index above 100
# [gold_2001]: s [1/GPa] and t [-]
_CONSTANTS = {
    "mineral": (9.904, 0.1390),
    "pao": (7.382, 0.1335),
    "ester": (6.605, 0.1360),
    "pag": (5.489, 0.1485),
}
_COLD, _HOT = celsius_to_kelvin(40.0), celsius_to_kelvin(100.0)


def _references(nu_100: float) -> tuple[float, float]:
    """Return L and H [mm2/s], viscosities at 40 degC of oils of index 0 and 100."""
    Y = nu_100 / MM2_S
    check_within("viscosity at 100 degC", Y, _ROWS[0][0], 1000.0, "mm2/s", "ASTM D2270 ends there.")
    _, a, b, c, d, e, f = next(row for row in reversed(_ROWS) if row[0] <= Y)
    return (a * Y + b) * Y + c, (d * Y + e) * Y + f


def viscosity_index(nu_40: float, nu_100: float) -> float:
    """Return the viscosity index of an oil.

    VI = 100 (L - U)/(L - H) to 100;  above, VI = 100 + (10^N - 1)/0.00715, N = lg(H/U)/lg Y

    Parameters
    ----------
    nu_40, nu_100 : float
        Kinematic viscosities U and Y at 40 and 100 degC [m2/s].

    Returns
    -------
    float
        Not rounded [-].

    Notes
    -----
    L and H by the quadratic forms of the standard, for Y above 2 mm2/s. The coefficients were
    read in a published copy, not in the standard; they are continuous within 0.2 % and give the
    printed index of the reference oil FVA 3A in [manjunath_2023].
    Source: [astm_d2270].

    Examples
    --------
    >>> round(viscosity_index(90.02e-6, 10.41e-6))
    97
    """
    L, H = _references(nu_100)
    U = nu_40 / MM2_S
    if U >= H:
        return 100.0 * (L - U) / (L - H)
    N = math.log(H / U) / math.log(nu_100 / MM2_S)
    return 100.0 + (10.0**N - 1.0) / _SLOPE


def viscosity_at_40(nu_100: float, index: float) -> float:
    """Return the viscosity at 40 degC [m2/s] of an oil with this index [-] and nu_100 [m2/s]."""
    check_within("viscosity_index", index, *INDEX_RANGE)
    L, H = _references(nu_100)
    if index <= 100.0:
        return (L - 0.01 * index * (L - H)) * MM2_S
    N = math.log10(1.0 + _SLOPE * (index - 100.0))
    return float(H * (nu_100 / MM2_S) ** -N * MM2_S)


def viscosity_at_100(nu_40: float, index: float) -> float:
    """Return the viscosity at 100 degC [m2/s] of an oil with this index [-] and nu_40 [m2/s].

    Raises
    ------
    ParameterError
        There is none above 2 mm2/s.
    """
    # not quite the ends of the range: roundings of units would leave it
    low, high = 2.000001 * MM2_S, min(nu_40, 999.999 * MM2_S)

    def excess(nu_100: float) -> float:
        return viscosity_at_40(nu_100, index) - nu_40

    if not low < high or excess(low) > 0.0 or excess(high) < 0.0:
        raise ParameterError(
            f"viscosity_index {index:g} with {nu_40 / MM2_S:g} mm2/s at 40 degC gives no viscosity "
            "at 100 degC within 2 to 1000 mm2/s. Give the viscosity at 100 degC instead of the "
            "index."
        )
    from scipy.optimize import brentq  # takes a third of a second

    return float(brentq(excess, low, high, xtol=1e-15, rtol=1e-12))


def secant_coefficient(base_oil: str, nu: float) -> float:
    """Return the mean pressure-viscosity coefficient up to 200 MPa.

    alpha_2000 = s nu^t, nu in mm2/s, alpha in 1/GPa

    Parameters
    ----------
    base_oil : {"mineral", "pao", "ester", "pag"}
        Kind of base oil; mineral means paraffinic.
    nu : float
        Kinematic viscosity at atmospheric pressure and the temperature of interest [m2/s].

    Returns
    -------
    float
        ln(eta/eta0)/p at p = 200 MPa [1/Pa].

    Notes
    -----
    The form is quoted by [arana_2019]; the constants are from memory, not compared with the
    printed source. Measured: FVA 3A is 3 % higher at 25 and 6 % at 80 degC [manjunath_2023]; a
    paraffinic and a PAO oil of ISO VG 100 at 40 degC are 3 % higher, a naphthenic one 46 %
    [arana_2019 Table 3]. No measured ester or polyglycol was at hand.
    Source: [gold_2001].

    Examples
    --------
    >>> round(1e9 * secant_coefficient("pao", 94.1e-6), 1)  # 1/GPa
    13.5
    """
    check_option("base_oil", base_oil, _CONSTANTS)
    s, t = _CONSTANTS[base_oil]
    return 1e-9 * float(s * (nu / MM2_S) ** t)


class SheetValues(NamedTuple):
    """Fields of `Lubricant` in SI units, notes on them, and what a lubricant does not hold."""

    data: dict[str, Any]
    notes: list[InputNote]
    limiting_coefficient: float
    density_slope: float


class _Notes:
    """Values as the file gives them or as they are completed; each leaves one note."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        self.given = given
        self.notes: list[InputNote] = []

    def value(self, key: str, otherwise: float, origin: Origin, why: str) -> float:
        if key in self.given:
            value, origin, why = self.given[key], "given", ""
        else:
            value = otherwise
        self.note(key, value, origin, why)
        return float(value)

    def note(self, key: str, value: Any, origin: Origin, why: str) -> None:
        self.notes.append(InputNote(key, value, field_unit(key)[0], origin, why))


def sheet_values(given: Mapping[str, Any]) -> SheetValues:
    """Return the numbers of a lubricant from the fields of an oil file that are given.

    Raises
    ------
    ParameterError
        Viscosity index and viscosity do not go together.
    """
    base = BASE_OILS[given["base_oil"]]
    notes = _Notes(given)
    notes.note("base_oil", given["base_oil"], "given", "")
    cold, hot = _viscosities(notes)
    A, B = walther_coefficients(cold, _COLD, hot, _HOT)

    notes.note("density_kg_m3", given["density_kg_m3"], "given", "")
    rho_at = notes.value(
        "density_temperature_degc", 15.0, "assumed", "where data sheets usually give it"
    )
    slope = notes.value(
        "density_slope_kg_m3_k", base.density_slope.value, "assumed", base.density_slope.why
    )
    density = given["density_kg_m3"] + slope * (REFERENCE_DENSITY_DEGC - rho_at)

    alpha_degc = notes.value("alpha_temperature_degc", 40.0, "assumed", "of the first viscosity")
    alpha_kelvin = celsius_to_kelvin(alpha_degc)
    nu = walther_kinematic_viscosity(A, B, alpha_kelvin)
    alpha = 1e-9 * notes.value(
        "alpha_per_gpa",
        1e9 * secant_coefficient(given["base_oil"], nu) * base.alpha.value,
        "inferred",
        "Gold et al. 2001 from viscosity and base oil",
    )
    measured = "alpha_per_gpa" in given
    alpha_is: AlphaIs = given.get("alpha_is", "film" if measured else "mean")
    if not measured and alpha_is != "mean":
        raise ParameterError(
            f"alpha_is must be left out without alpha_per_gpa, got {alpha_is!r}. Give alpha too."
        )
    why = "a number without a name is read as from films" if measured else "Gold et al. 2001"
    notes.note("alpha_is", alpha_is, *(("given", "") if "alpha_is" in given else ("assumed", why)))
    to = 1e9 * notes.value("alpha_pressure_gpa", 1e-9 * MEAN_PRESSURE, "assumed", "the usual end")
    alpha_factor = notes.value(
        "alpha_factor",
        MEASURED_ALPHA_FACTOR if measured else base.alpha.factor,
        "assumed",
        "between methods" if measured else base.alpha.why,
    )
    high_pressure, known = HIGH_PRESSURE_FACTOR, "alpha of films known, viscosity there is not"
    if not measured:
        of_alpha = 0.5 * GROWTH * math.log(alpha_factor)
        spread = math.sqrt(max(UNKNOWN_ALPHA_SPREAD**2 - of_alpha**2, 0.0))
        high_pressure, known = max(high_pressure, math.exp(2.0 * spread)), "alpha not measured"
    high_pressure = notes.value("high_pressure_factor", high_pressure, "assumed", known)
    limit = notes.value(
        "limiting_coefficient",
        base.limiting_coefficient.value,
        "assumed",
        base.limiting_coefficient.why,
    )
    own_limit = "limiting_coefficient" in given
    limit_factor = notes.value(
        "limiting_coefficient_factor",
        GIVEN_LIMIT_FACTOR if own_limit else base.limiting_coefficient.factor,
        "assumed",
        "one number without scatter" if own_limit else base.limiting_coefficient.why,
    )
    eyring = 1e6 * notes.value(
        "eyring_stress_mpa",
        2e-6 * limit / alpha,
        "inferred",
        "2 limiting_coefficient/alpha, Bair and Winer 1990; it grows with pressure",
    )
    own_stress = "eyring_stress_mpa" in given
    eyring_factor = notes.value(
        "eyring_stress_factor",
        EYRING_FACTOR if own_stress else limit_factor,
        "assumed",
        "one number without scatter" if own_stress else "that of the limiting coefficient",
    )
    junctions = "of the hypoid oils of the library"
    boundary_stress = 1e6 * notes.value(
        "limiting_shear_stress_mpa", 1e-6 * BOUNDARY_STRESS, "assumed", junctions
    )
    friction = notes.value("boundary_friction", BOUNDARY_FRICTION, "assumed", junctions)
    conductivity = notes.value(
        "conductivity_w_m_k", base.conductivity.value, "assumed", base.conductivity.why
    )
    capacity = notes.value(
        "heat_capacity_j_kg_k", base.heat_capacity.value, "assumed", base.heat_capacity.why
    )
    rise = given.get("heat_under_pressure", "none")
    own_rise: tuple[Origin, str] = ("assumed", "constant") if rise == "none" else ("given", "")
    notes.note("heat_under_pressure", rise, *own_rise)
    low = notes.value("temperature_low_degc", 0.0, "assumed", "as of the library's oils")
    high = notes.value("temperature_high_degc", 150.0, "assumed", "as of the library's oils")
    data: dict[str, Any] = {
        "walther_a": A,
        "walther_b": B,
        "density": density,
        "alpha": alpha,
        "alpha_is": alpha_is,
        "alpha_temperature": alpha_kelvin,
        "alpha_pressure": to,
        "alpha_factor": alpha_factor,
        "high_pressure_factor": high_pressure,
        "eyring_stress": eyring,
        "eyring_slope": 0.0 if own_stress else limit,
        "eyring_stress_factor": eyring_factor,
        "limiting_shear_stress": boundary_stress,
        "boundary_friction": friction,
        "conductivity": conductivity,
        "conductivity_temperature": alpha_kelvin,
        "conductivity_slope": 0.0,
        "heat_capacity": capacity,
        "heat_under_pressure": rise,
        "temperature_low": celsius_to_kelvin(low),
        "temperature_high": celsius_to_kelvin(high),
    }
    return SheetValues(data, notes.notes, limit, slope)


def _viscosities(notes: _Notes) -> tuple[float, float]:
    """Return the viscosities at 40 and 100 degC [m2/s], two of three data given."""
    given, why = notes.given, "viscosity index, ASTM D2270"
    cold = float(given.get("viscosity_40_degc_mm2_s", 0.0))
    hot = float(given.get("viscosity_100_degc_mm2_s", 0.0))
    if not hot:
        hot = viscosity_at_100(cold * MM2_S, given["viscosity_index"]) / MM2_S
    elif not cold:
        cold = viscosity_at_40(hot * MM2_S, given["viscosity_index"]) / MM2_S
    cold = notes.value("viscosity_40_degc_mm2_s", cold, "inferred", why)
    hot = notes.value("viscosity_100_degc_mm2_s", hot, "inferred", why)
    index = viscosity_index(cold * MM2_S, hot * MM2_S)
    notes.value("viscosity_index", index, "inferred", "the two viscosities, ASTM D2270")
    return cold * MM2_S, hot * MM2_S
