"""Rewrite docs/oil_file.md: python -m docs.oil_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from gearlube_core.oil.base_oils import (
    BASE_OILS,
    BOUNDARY_FRICTION,
    BOUNDARY_STRESS,
    EYRING_FACTOR,
    GIVEN_LIMIT_FACTOR,
    MEASURED_ALPHA_FACTOR,
    BaseOil,
)
from gearlube_core.oil.lubricant import lubricant_names
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.oil.oil_file import OilFile, read_oil

PAGE = Path(__file__).with_suffix(".md")

HEAD = """# The oil file

The tables are written by `python -m docs.oil_file` from the data model
(`gearlube_core/oil/oil_file.py`), the text with them; not edited by hand.

Your oil as its data sheet describes it, in one TOML file: class of the base oil, density, and two
of viscosity at 40 degC, viscosity at 100 degC and viscosity index. The rest is estimated where
the sheet says nothing, and each number is marked given, inferred or assumed.

```
gearlube oil --example > my_oil.toml          # a file to start from
gearlube oil my_oil.toml --figure oil.png     # checks it; numbers, table over temperature, figure
gearlube bearing --oil my_oil.toml
gearlube map my_axle.toml --oil my_oil.toml
gearlube sweep my_axle.toml --oil my_oil.toml
```

In an axle file, also for sweeps and FMUs: `[oil]` with `file = "my_oil.toml"`, relative to the axle
file. An FMU carries the oil file as `resources/oil.toml`.

```python
import gearlube as gl

oil = gl.read_oil("my_oil.toml")
oil.lubricant  # what LossMapSettings, run_bearing, film_oil_of take
for note in oil.assumed:
    print(note.field, note.value_text, note.unit, note.origin, note.why)
```

"""

_TAIL = """
## What is estimated, and how well

Factors: the true value is within value/factor and value times factor with 95 % (k = 2).

{classes}
Eyring stress: factor {eyring:g}, 2 to 5 MPa being in use.

- **Pressure-viscosity coefficient**: the mean slope of ln eta up to 200 MPa is s nu^t with s and t
  of the class (Gold et al. 2001), turned into the slope at ambient pressure by Roelands' law. The
  constants are from memory, not compared with the printed paper. Compared with published
  measurements the mean slope is 3 % low at 25 and 6 % low at 80 degC for FVA 3A, 3 % low at
  40 degC for a paraffinic oil and a PAO of ISO VG 100, and 32 % low for a naphthenic oil. The slope
  at ambient pressure is within 5 % for the paraffinic oil and at most 13 % high for the PAO.
  Nothing was at hand to check esters and polyglycols. Correlations with density, such as So and
  Klaus 1980, are left out: no text of theirs could be read.
- **Eyring stress**: 2 Lambda/alpha with Lambda the limiting coefficient (Bair and Winer 1990,
  quoted by Arana et al. 2019). Arana et al. take alpha at the pressure of the contact, where it is
  smaller and the stress larger: 7 MPa at 1 GPa for 4.5 MPa at ambient pressure.
- **Limiting coefficient** Lambda: Höglund 1999, quoted by Arana et al. 2019. The law of the axle's
  flanks has no such limit; there it only sets the Eyring stress where none is given.
  The fit below has it.
- **Viscosity index**: quadratic forms of ASTM D2270, read in a published copy. They give the
  printed 97 of FVA 3A.
- The density counts as constant in all computations, at its value at 70 degC: dynamic viscosity is
  2 % low at 40 and 2 % high at 100 degC.

## Fit to measured traction

```
gearlube oil fit measurements.csv --oil my_oil.toml --radius-mm 9.525 --out fitted_oil.toml
```

The table has a line of column names and then one point a line:

| Column | Unit | Meaning |
|---|---|---|
| `slide_roll_ratio` | - | Sliding speed over mean speed; or the next |
| `sliding_speed_m_s` | m/s | Difference of the surface speeds |
| `entrainment_speed_m_s` | m/s | Mean of the surface speeds |
| `mean_pressure_gpa` | GPa | Load over area; or the next |
| `hertz_pressure_gpa` | GPa | The largest |
| `temperature_degc` | degC | Of the oil at the inlet |
| `traction_coefficient` | - | Traction over load |

Film from the formula of a circle (`--contact point`, Chittenden) or a line (`--contact line`,
Dowson and Toyoda); traction by the law of the axle's flanks, Evans and Johnson 1986, no greater
than Lambda times pressure. Least squares find the Eyring stress, and Lambda where three points or
more lie on it and an F test gives it less than 1 % by chance. Factors are 95 % intervals from the
Jacobian and the residual. On made-up points of the law with scatter, 56 points on 8 curves, 1000
sets each, the interval held the Eyring stress in {coverage}

- The factor counts scatter alone. Errors of film, alpha, viscosity and law bend a whole curve; the
  mean residual of the worst curve shows them, and the command says when it is beyond scatter.
- Many points of little scatter give a factor near 1, and the loss map then shows next to no error
  bar by the Eyring stress. Enlarge `eyring_stress_factor` where pressures or temperatures of the
  map lie outside the measured range.
- Use the fitted stress with the alpha that it was fitted with: their errors balance in traction.
- Smooth surfaces: with films below three times the roughness, asperities rub too.
- The written file keeps the fields of `--oil`; comments are lost.

## In the loss map

`gearlube map` draws alpha and the Eyring stress within the factors of the oil (`alpha_factor`,
`eyring_stress_factor`). Oils of the library have none; for them it takes 1.15 and 2.

## Shipped oils

`--oil NAME`, `gl.read_oil("NAME")` and, but for the last one, `[oil] name` of an axle file.
`gearlube oil NAME` shows where each number is from.

{oils}
Of the reference oils FVA 1, 2 and 4 no published data could be read.

## Limits

- One line of viscosity after ASTM D341, above 2 mm2/s; oils with much polymer depart from it.
- Conductivity and heat capacity have no temperature dependence.
- Beside oil files `gearlube sweep --oil` takes the two oils of the hypoid papers alone.
"""

# 4 MPa without and with a limit of 0.055 (scatter 0.001, 0.002), 8 MPa with a limit of 0.05 (0.001)
_COVERAGE = (
    "94 of 100 where no limit is reached, in\n95 where a third of the points lie on one, and in 90 "
    "where nine of ten do."
)
_CLASS = "by class"
_WITHOUT = {
    "density_temperature_degc": "15",
    "density_slope_kg_m3_k": _CLASS,
    "viscosity_40_degc_mm2_s": "inferred",
    "viscosity_100_degc_mm2_s": "inferred",
    "viscosity_index": "inferred",
    "alpha_per_gpa": "inferred",
    "alpha_temperature_degc": "40",
    "alpha_factor": f"{MEASURED_ALPHA_FACTOR:g}, of an estimate by class",
    "eyring_stress_mpa": "inferred",
    "eyring_stress_factor": f"{EYRING_FACTOR:g}",
    "limiting_coefficient": _CLASS,
    "limiting_coefficient_factor": f"{GIVEN_LIMIT_FACTOR:g}, of an estimate by class",
    "limiting_shear_stress_mpa": f"{1e-6 * BOUNDARY_STRESS:g}",
    "boundary_friction": f"{BOUNDARY_FRICTION:g}",
    "conductivity_w_m_k": _CLASS,
    "heat_capacity_j_kg_k": _CLASS,
    "temperature_low_degc": "0",
    "temperature_high_degc": "150",
}


def _classes() -> str:
    head = (
        "| `base_oil` | | Limiting coefficient | Conductivity | Heat capacity | Density slope "
        "| alpha |\n|---|---|---|---|---|---|---|\n"
    )
    return head + "".join(_row(name, base) for name, base in BASE_OILS.items())


def _row(name: str, base: BaseOil) -> str:
    cells = [
        f"{one.value:g}{unit}, {one.factor:g}"
        for one, unit in (
            (base.limiting_coefficient, ""),
            (base.conductivity, " W/(m.K)"),
            (base.heat_capacity, " J/(kg.K)"),
            (base.density_slope, " kg/(m3.K)"),
        )
    ]
    return f"| `{name}` | {base.words} | {' | '.join(cells)} | factor {base.alpha.factor:g} |\n"


def _sources() -> str:
    lines = []
    for name, base in BASE_OILS.items():
        for words, one in (
            ("limiting coefficient", base.limiting_coefficient),
            ("conductivity", base.conductivity),
            ("heat capacity", base.heat_capacity),
            ("density slope", base.density_slope),
        ):
            lines.append(f"- `{name}`, {words}: {one.why}\n")
    return "".join(lines)


def _oils() -> str:
    lines = [
        "| Name | nu 40 / 100 degC [mm2/s] | alpha 40 degC [1/GPa] | Eyring stress [MPa] "
        "| Source |\n",
        "|---|---|---|---|---|\n",
    ]
    for name in (*lubricant_names(), *OilFile.shipped()):
        described = read_oil(name)
        oil = described.lubricant
        cold, hot = (lubricant_state(oil.parameters(), 273.15 + t) for t in (40.0, 100.0))
        stress = next(n for n in described.inputs if n.field.startswith("eyring_stress"))
        lines.append(
            f"| `{name}` | {1e6 * cold.nu:.3g} / {1e6 * hot.nu:.3g} | {1e9 * cold.alpha:.1f} | "
            f"{1e-6 * oil.eyring_stress:.3g}, {stress.origin} | {described.source} |\n"
        )
    return "".join(lines)


def page() -> str:
    """Return docs/oil_file.md."""
    classes = _classes() + "\nEach pair is value and factor. Where they are from:\n\n" + _sources()
    tail = _TAIL.format(classes=classes, eyring=EYRING_FACTOR, coverage=_COVERAGE, oils=_oils())
    return HEAD + "## Fields\n" + field_tables(OilFile, {"": "The file"}, _WITHOUT) + tail


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
