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
from gearlube_core.oil.lubricant import lubricant_names, lubricant_state
from gearlube_core.oil.oil_file import OilFile, read_oil

PAGE = Path(__file__).with_suffix(".md")

HEAD = """# The oil file

The tables are written by `python -m docs.oil_file` from the data model
(`gearlube_core/oil/oil_file.py`), the text with them; not edited by hand.

An oil file describes your oil by its data sheet, in one TOML file. It needs the class of the base
oil, the density, and two of these three: viscosity at 40 degC, viscosity at 100 degC, viscosity
index. Values that the data sheet does not give are estimated. Each value is marked as given,
inferred or assumed.

```
gearlube oil --example > my_oil.toml          # a file to start from
gearlube oil my_oil.toml --figure oil.png     # checks it; numbers, table over temperature, figure
gearlube bearing --oil my_oil.toml
gearlube map my_axle.toml --oil my_oil.toml
gearlube sweep my_axle.toml --oil my_oil.toml
```

In an axle file, name the oil file in section `[oil]`: `file = "my_oil.toml"`. The path is relative
to the axle file. Sweeps and FMUs then use this oil. An FMU contains the oil file as
`resources/oil.toml`.

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

The uncertainty is given as a factor. With a probability of 95 % (k = 2) the true value lies between
value / factor and value times factor.

{classes}
Eyring stress: factor {eyring:g}. Values of 2 to 5 MPa are in use.

- **Pressure-viscosity coefficient** alpha: the mean slope of ln eta up to 200 MPa is s nu^t. The
  constants s and t depend on the class of the base oil (Gold et al. 2001). Roelands' law converts
  this mean slope to the slope at ambient pressure. The constants are quoted from memory and have
  not been compared with the printed paper.
  Compared with published measurements the mean slope is 3 % low at 25 degC and 6 % low at 80 degC
  for FVA 3A, 3 % low at 40 degC for a paraffinic oil and a PAO of ISO VG 100, and 32 % low for a
  naphthenic oil. The slope at ambient pressure is within 5 % for the paraffinic oil and at most
  13 % high for the PAO. No measurements were available to check esters and polyglycols.
  Correlations with density, such as So and Klaus 1980, are not used, because their text was not
  available.
- **Eyring stress**: 2 Lambda/alpha, where Lambda is the limiting coefficient (Bair and Winer 1990,
  quoted by Arana et al. 2019). Arana et al. use alpha at the pressure of the contact. There alpha
  is smaller and the stress is larger: 7 MPa at 1 GPa, compared with 4.5 MPa at ambient pressure.
- **Limiting coefficient** Lambda: Höglund 1999, quoted by Arana et al. 2019. The friction law of
  the axle's flanks has no limiting shear stress. There Lambda only sets the Eyring stress if none
  is given. The fit to measured traction below does use this limit.
- **Viscosity index**: quadratic formulas of ASTM D2270, read in a published copy. They give the
  printed value of 97 for FVA 3A.
- All computations use a constant density, the value at 70 degC. The dynamic viscosity is therefore
  2 % low at 40 degC and 2 % high at 100 degC.

## Fit to measured traction

```
gearlube oil fit --example > measurements.csv      # a table to start from, computed
gearlube oil fit measurements.csv --oil my_oil.toml --radius-mm 9.525 --out fitted_oil.toml
```

The first line of the [table](conventions.md#tables) has the column names. Each further line is
one measured point:

| Column | Unit | Meaning |
|---|---|---|
| `slide_roll_ratio` | - | Sliding speed divided by mean speed; or give `sliding_speed_m_s` |
| `sliding_speed_m_s` | m/s | Difference of the surface speeds |
| `entrainment_speed_m_s` | m/s | Mean of the surface speeds |
| `mean_pressure_gpa` | GPa | Load divided by contact area; or give `hertz_pressure_gpa` |
| `hertz_pressure_gpa` | GPa | Maximum Hertz pressure |
| `temperature_degc` | degC | Of the oil at the inlet |
| `traction_coefficient` | - | Traction force divided by load |

The film thickness comes from the formula for a circular contact (`--contact point`, Chittenden) or
for a line contact (`--contact line`, Dowson and Toyoda). The traction law is that of the axle's
flanks, Evans and Johnson 1986. The shear stress is limited to Lambda times the pressure.

A least-squares fit finds the Eyring stress. It also finds Lambda if at least three points lie on
the limit and if an F test gives a probability below 1 % that the limit appears by chance. The
factors are 95 % intervals from the Jacobian and the residual. They were tested on invented points
of the law with scatter: 56 points on 8 curves, 1000 sets for each case. The interval contained the
true Eyring stress in 94 of 100 sets if no point reaches the limit, in 95 if a third of the points
lie on the limit, and in 90 if nine tenths do.

- The factor covers scatter only. Errors of film, alpha, viscosity and law shift a whole curve. The
  mean residual of the worst curve shows such an error. The command prints a message if this
  residual is too large to be scatter.
- Many points with little scatter give a factor near 1. The loss map then shows almost no error bar
  due to the Eyring stress. If pressures or temperatures of the map lie outside the measured range,
  enlarge `eyring_stress_factor`.
- Use the fitted Eyring stress together with the alpha used in the fit, because their errors
  compensate each other in the traction.
- The fit assumes smooth surfaces. If the film is thinner than three times the roughness, asperity
  friction adds to the measured traction.
- The written file keeps the fields of the file given by `--oil`, but not its comments.

## In the loss map

For its error bars `gearlube map` varies alpha and the Eyring stress within the factors of the oil
(`alpha_factor`, `eyring_stress_factor`). The oils of the library have no factors. For them the map
uses 1.15 and 2.

## Shipped oils

Choose a shipped oil by `--oil NAME`, by `gl.read_oil("NAME")` or by `name` in section `[oil]` of an
axle file. The last oil of the table cannot be named in an axle file.
`gearlube oil NAME` shows the source of each value.

{oils}
No published data of the reference oils FVA 1, 2 and 4 were available.

Take care with the oils of the hypoid papers: their pressure exponents, 0.39 (`karagiannis_2012`)
and 0.83 (`mohammadpour_2015`), lie below and at the upper end of measured mineral oils, and 2 MPa
is little. With `karagiannis_2012` flanks rub far less than published friction says, see
[the comparison](film_model_axle.md#against-published-friction).

## Limits

- The viscosity follows the straight line of ASTM D341 and holds above 2 mm2/s. Oils with much
  polymer deviate from this line.
- Thermal conductivity and heat capacity do not depend on temperature.
- `gearlube sweep --oil` accepts oil files and the two oils of the hypoid papers, no other shipped
  oils.
"""

# 4 MPa without and with a limit of 0.055 (scatter 0.001, 0.002), 8 MPa with a limit of 0.05 (0.001)
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
    classes = _classes() + "\nEach pair is a value and its factor. Sources:\n\n" + _sources()
    tail = _TAIL.format(classes=classes, eyring=EYRING_FACTOR, oils=_oils())
    return HEAD + "## Fields\n" + field_tables(OilFile, {"": "The file"}, _WITHOUT) + tail


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
