"""Reading a lubricant library: tagged data in a TOML file to plain SI numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from gearlube_core.checks import check_finite, check_option, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.input_file import read_toml
from gearlube_core.oil.walther_1931 import MM2_S, walther_coefficients, walther_double_log
from gearlube_core.units import celsius_to_kelvin

LIBRARY_PATH = Path(__file__).with_name("lubricants.toml")
TAGS = ("printed", "corrected", "completed", "assumed")
KELVIN_SUFFIX = "_degc"
LOWEST_VISCOSITY = 2.0e-6  # m2/s, [astm_d341] for the shift of 0.7 mm2/s


def read_library(path: Path = LIBRARY_PATH) -> dict[str, Any]:
    """Return the lubricants of a TOML file as nested dictionaries, as written there.

    A file is read once until it changes; do not write into what is returned.
    """
    try:
        return _read(path, path.stat().st_mtime_ns)
    except FileNotFoundError:
        raise ParameterError(f"There is no lubricant library at {path}.") from None


@lru_cache(maxsize=8)
def _read(path: Path, _changed: int) -> dict[str, Any]:
    return read_toml(path, "lubricant library")


def datum_value(table: Mapping[str, Any], key: str, where: str) -> Any:
    """Return the value of one datum, after checking that it has a tag and a source."""
    if key not in table:
        raise ParameterError(f"{where} needs {key} = [value, tag, source].")
    datum = table[key]
    if not (isinstance(datum, list) and len(datum) == 3 and isinstance(datum[2], str)):
        raise ParameterError(f"{where}.{key} must be [value, tag, source], got {datum!r}.")
    check_option(f"tag of {where}.{key}", datum[1], TAGS)
    return datum[0]


def lubricant_data(library: Mapping[str, Any], name: str) -> dict[str, Any]:
    """Return the fields of one lubricant in SI, ready for `Lubricant(**fields)`."""
    check_option("lubricant name", name, library)
    entry = library[name]
    for section in ("source", "valid_temperature_degc", "viscosity", "data"):
        if section not in entry:
            raise ParameterError(f"Lubricant {name} has no {section}.")
    data = {key: datum_value(entry["data"], key, f"{name}.data") for key in entry["data"]}
    fields: dict[str, Any] = {}
    for key, value in data.items():
        if isinstance(value, str):
            fields[key] = value
            continue
        number = check_finite(f"{name}.data.{key}", value)
        if key.endswith(KELVIN_SUFFIX):
            fields[key.removesuffix(KELVIN_SUFFIX)] = celsius_to_kelvin(number)
        else:
            fields[key] = number
    A, B = _walther_line(library, name)
    low, high = entry["valid_temperature_degc"]
    return fields | {
        "name": name,
        "source": entry["source"],
        "walther_a": A,
        "walther_b": B,
        "temperature_low": celsius_to_kelvin(low),
        "temperature_high": celsius_to_kelvin(high),
    }


def _walther_line(library: Mapping[str, Any], name: str) -> tuple[float, float]:
    """Return A and B through two points, or through one with the slope of another oil."""
    table = library[name]["viscosity"]
    where = f"{name}.viscosity"
    density = check_positive(
        f"{name}.data.density", datum_value(library[name]["data"], "density", name), "kg/m3"
    )
    nu_1, T_1 = _viscosity_point(table, 1, density, where)
    if "same_slope_as" in table:
        other = datum_value(table, "same_slope_as", where)
        check_option(f"{where}.same_slope_as", other, (key for key in library if key != name))
        if "same_slope_as" in library[other]["viscosity"]:
            raise ParameterError(f"{where}.same_slope_as must name an oil with two viscosities.")
        B = _walther_line(library, other)[1]
        return walther_double_log(nu_1) + B * math.log10(T_1), B
    nu_2, T_2 = _viscosity_point(table, 2, density, where)
    if (nu_1 - nu_2) * (T_2 - T_1) <= 0.0:
        raise ParameterError(
            f"{where}: viscosity must fall from the cold to the hot point, got "
            f"{nu_1:g} m2/s at {T_1:g} K and {nu_2:g} m2/s at {T_2:g} K."
        )
    return walther_coefficients(nu_1, T_1, nu_2, T_2)


def _viscosity_point(
    table: Mapping[str, Any], number: int, density: float, where: str
) -> tuple[float, float]:
    """Return kinematic viscosity [m2/s] and temperature [K] of point 1 or 2."""
    key = f"temperature_{number}_degc"
    T_degc = check_finite(f"{where}.{key}", datum_value(table, key, where), "degC")
    if f"dynamic_{number}" in table:
        eta = datum_value(table, f"dynamic_{number}", where)
        nu = check_positive(f"{where}.dynamic_{number}", eta, "Pa s") / density
    else:
        nu_mm2_s = datum_value(table, f"kinematic_{number}_mm2_s", where)
        nu = check_finite(f"{where}.kinematic_{number}_mm2_s", nu_mm2_s, "mm2/s") * MM2_S
    cure = "The viscosity-temperature line holds above 2 mm2/s; 100 cSt is 1e-4 m2/s."
    check_within(f"{where}: kinematic viscosity", nu, LOWEST_VISCOSITY, 1.0, "m2/s", cure)
    return nu, celsius_to_kelvin(T_degc)
