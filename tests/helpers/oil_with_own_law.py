"""Films of an oil whose viscosity law one file brings: by its name in oil files and case files."""

import json
import sys
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

from gearlube_core.ehl.case.sections import Oil
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil import pressure_viscosity, viscosity
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.oil_file import OilFile, read_oil

PRESSURES = (0.0, 1e8, 8e8)  # Pa
ETA0, ALPHA, TEMPERATURE = 0.05, 15e-9, 313.15
Q = 20.0
SHEET = {
    "name": "sheet", "base_oil": "pao", "density_kg_m3": 850.0, "viscosity_40_degc_mm2_s": 100.0,
    "viscosity_100_degc_mm2_s": 14.0, "alpha_per_gpa": 15.0, "alpha_temperature_degc": 40.0,
    "alpha_is": "slope",
}  # fmt: skip
OWN = {"viscosity_law": "own_power", "law_numbers": {"q": Q}}


def refusal(**changes):
    try:
        OilFile.from_data(SHEET | changes, "the oil")
    except ParameterError as error:
        return str(error)
    return ""


def as_toml(data):
    numbers = data.get("law_numbers", {}).items()
    lines = [f"{key} = {json.dumps(value)}" for key, value in data.items() if key != "law_numbers"]
    return "\n".join([*lines, "[law_numbers]", *(f"{key} = {value}" for key, value in numbers)])


def report():
    """Write eta/eta0 of the oil's films and what refuses, as JSON."""
    before = refusal(**OWN)
    import_module("tests.helpers.own_power_law")
    with TemporaryDirectory() as folder:
        path = Path(folder, "oil.toml")
        path.write_text(as_toml(SHEET | OWN))
        described = read_oil(path)
        case = {"library": str(path), "temperature_degc": 40.0}
        numbers = {"viscosity_pa_s": ETA0, "pressure_viscosity_per_gpa": 1e9 * ALPHA}
        films = {
            "oil file": film_oil_of(described.lubricant, TEMPERATURE),
            "case with the oil file": Oil(**case).film_oil(),
            "case": Oil(**numbers, law="own_power", law_numbers={"q": Q}).film_oil(),
            "python": film_oil(eta0=ETA0, alpha=ALPHA, law="own_power"),
            "other law in the case": Oil(**case, law="barus").film_oil(),
        }
    found = {
        name: [viscosity(oil, p) / oil.eta0 for p in PRESSURES] + [pressure_viscosity(oil)]
        for name, oil in films.items()
    }
    notes = [list(one) for one in described.inputs if "law" in one.field]
    refusals = [
        refusal(viscosity_law="own_power", law_numbers=one) for one in ({"r": 1.0}, {"q": 0})
    ]
    refusals.append(refusal(law_numbers={"q": 16.0}))
    report = {"before": before, "films": found, "notes": notes, "refusals": refusals}
    sys.stdout.write(json.dumps(report))
