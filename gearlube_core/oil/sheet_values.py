"""From the numbers of a data sheet to those of a lubricant, each with where it is from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from gearlube_core.input_file.field_notes import field_unit
from gearlube_core.input_file.input_note import InputNote, Origin
from gearlube_core.oil.astm_d2270 import viscosity_at_40, viscosity_at_100, viscosity_index
from gearlube_core.oil.base_oils import (
    BASE_OILS,
    BOUNDARY_FRICTION,
    BOUNDARY_STRESS,
    EYRING_FACTOR,
    GIVEN_LIMIT_FACTOR,
    MEASURED_ALPHA_FACTOR,
    REFERENCE_DENSITY_DEGC,
    eyring_stress_of,
)
from gearlube_core.oil.gold_2001 import ambient_coefficient, secant_coefficient
from gearlube_core.oil.walther_1931 import (
    MM2_S,
    walther_coefficients,
    walther_kinematic_viscosity,
)
from gearlube_core.units import celsius_to_kelvin

_COLD, _HOT = celsius_to_kelvin(40.0), celsius_to_kelvin(100.0)


class SheetValues(NamedTuple):
    """Fields of `Lubricant` in SI units, notes on them, and what a lubricant does not hold."""

    data: dict[str, float]
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
    estimate = ambient_coefficient(secant_coefficient(given["base_oil"], nu), nu * density)
    alpha = 1e-9 * notes.value(
        "alpha_per_gpa",
        1e9 * estimate * base.alpha.value,
        "inferred",
        "Gold et al. 2001 from viscosity and base oil; Roelands to low pressure",
    )
    measured = "alpha_per_gpa" in given
    alpha_factor = notes.value(
        "alpha_factor",
        MEASURED_ALPHA_FACTOR if measured else base.alpha.factor,
        "assumed",
        "between methods" if measured else base.alpha.why,
    )
    limit = notes.value(
        "limiting_coefficient",
        base.limiting_coefficient.value,
        "assumed",
        base.limiting_coefficient.why,
    )
    own_limit = "limiting_coefficient" in given
    notes.value(
        "limiting_coefficient_factor",
        GIVEN_LIMIT_FACTOR if own_limit else base.limiting_coefficient.factor,
        "assumed",
        "one number without scatter" if own_limit else base.limiting_coefficient.why,
    )
    eyring = 1e6 * notes.value(
        "eyring_stress_mpa",
        1e-6 * eyring_stress_of(limit, alpha),
        "inferred",
        "2 limiting_coefficient/alpha, Bair and Winer 1990",
    )
    own_stress = "eyring_stress_mpa" in given
    eyring_factor = notes.value(
        "eyring_stress_factor",
        EYRING_FACTOR,
        "assumed",
        "one number without scatter" if own_stress else "2 to 5 MPa in use",
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
    low = notes.value("temperature_low_degc", 0.0, "assumed", "as of the library's oils")
    high = notes.value("temperature_high_degc", 150.0, "assumed", "as of the library's oils")
    data = {
        "walther_a": A,
        "walther_b": B,
        "density": density,
        "alpha": alpha,
        "alpha_temperature": alpha_kelvin,
        "alpha_factor": alpha_factor,
        "eyring_stress": eyring,
        "eyring_stress_factor": eyring_factor,
        "limiting_shear_stress": boundary_stress,
        "boundary_friction": friction,
        "conductivity": conductivity,
        "conductivity_temperature": alpha_kelvin,
        "conductivity_slope": 0.0,
        "heat_capacity": capacity,
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
