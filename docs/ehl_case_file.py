"""Rewrite docs/ehl_case_file.md: python -m docs.ehl_case_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.case.rough_case import RoughCase

PAGE = Path(__file__).with_suffix(".md")
OIL = {
    "oil": "[oil]",
    "body_1": "[body_1] and [body_2]: the solids",
}
LINE = {
    "": "Line contact: the file",
    "domain": "[domain]: left out, as far as load and film need",
    "profile": "[profile]: heights from a file",
    "solver": "[solver]",
}
POINT = {
    "": "Point contact: the file",
    "domain": "[domain]: left out, as far as load and film need",
    "height_map": "[height_map]: heights from a file",
    "ridge": "[ridge]",
    "dent": "[dent]",
    "waviness": "[waviness]",
    "solver": "[solver]",
}
HYPOID = {"": "Hypoid flank: the file", "solver": "[solver]"}
ROUGH = {
    "": "Rough line contact: the file",
    "surface_1": "[surface_1] and [surface_2]: give one of file, stand_in, ra_um, amplitude_um",
    "times": "[times]",
    "touching": "[touching]: solids where the film vanishes",
    "domain": "[domain]",
    "solver": "[solver]",
    "frames": "[frames]: films that are kept, and records",
}

ROLLING = """
Equal speeds are a valid case, also of an Eyring oil: the film is the limit of small sliding, and
neither oil nor touching solids make friction, which would have no direction.
"""

HEAD = """# The case files of lubricated line and point contacts and of hypoid flanks

The tables and the text are written by `python -m docs.ehl_case_file` from the data models in
`gearlube_core/ehl/case/`; do not edit them by hand.

`gearlube ehl line my_case.toml` and `gearlube ehl point my_case.toml` read them. Two line contacts
ship, `jamali_2015` and `jamali_2015_thermal`, and four point contacts, `mourier_2006`,
`elliptical`, `elliptical_thermal` and `jamali_2015_section`, a part of a line contact whose film
repeats (`gearlube_core/ehl/case/data/`). `gearlube ehl rough my_case.toml` reads rough line
contacts; `jamali_2015_a`, `_a_straight`, `_b`, `_c` and `_d` ship, and
[rough_line_contact.md](rough_line_contact.md) shows what comes out.
`gearlube ehl line --example` prints one to start from.
Contact lines of helical pairs come from the pair's [gear file](helical_gear_file.md), whose
`[film_mesh]` can set the nodes denser where the film leaves the contact. A hypoid
flank, `gearlube ehl hypoid my_case.toml`, takes its contacts from a mesh table; `mohammadpour_2015`
ships, its fields stand at the end, and [ehl_hypoid.md](ehl_hypoid.md) shows what comes out. What
follows is about lines and points.

- Body 1 lies below the film, body 2 above. Speeds are those of the surfaces against the contact,
  positive along x; their mean is the entrainment speed, and body 2 less body 1 slides. Against
  the motion is negative.
- `reduced_modulus_gpa` is E' = 2 E*, with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. Left out, it is
  that of the bodies, which are steel where nothing is said.
- An oil is one of the library at a temperature, or its own numbers. An Eyring stress acts on flow
  and friction. A limiting stress acts on the friction, and in point contacts of an oil with an
  Eyring stress on the flow as well: beyond it the film slips.
- `temperature = "thermal"` solves the energy balance with the film: temperatures across it and of
  both surfaces, for lines and points. The oil then needs `law = "houpert"`. In point contacts
  entrainment and sliding point anywhere and either surface may stand; heat is balanced to 1e-6.

## Shapes of the gap

The smooth gap is x^2/(2 R) or x^2/(2 R_x) + y^2/(2 R_y). Heights are taken off it: what stands out
of a surface is positive and narrows the gap. With `holds = "gap"` the file is the whole undeformed
gap itself, up to a constant: tip relief, crown, a flank from a measuring machine. The radii then
only choose scales, domain and start.

- A profile is a CSV file, first line `x_mm,height_um`, lines with # left out. Between the places
  lies a cubic spline.
- A height map is a NetCDF file with the dimensions x and y, or an `.npz` file with the arrays `x`
  (nx), `y` (ny) and `height` (nx, ny); mm, mm and um. Between the places lies a bicubic spline.
- A file must cover the domain and be at least as fine as the finest grid, and hold finite numbers
  alone; else the case is refused with both numbers. What is finer than the grid is not averaged:
  take out wavelengths below about eight nodes first.
- Ridge, dent and waviness of a point contact add up, with or without a map. Sections of ridge and
  dent are Gaussian, z = A exp(-4 ln 2 (s/width)^2); waves are cosines.
- These are steady solutions, so heights are at rest: on a standing surface, or constant along the
  motion. On a moving surface they would travel and squeeze the film, and the command says so.
- Formulas and Hertz contacts in the summary are those of the smooth gap.

## Where the film breaks

By default pressure and its slope vanish where a film breaks, and the gap counts as full behind
(Reynolds). With `cavitation = "mass_conserving"` what the broken film holds is found as well: there
oil is carried along with the mean speed of the surfaces, and pressure moves it only where the gap
is full (Jakobsson and Floberg 1957, Olsson 1965, Elrod 1981; pressure and void as complements as in
Giacopini et al. 2010). What enters the domain leaves it, to the tolerance. A flooded contact has
the film and the pressure of Reynolds' condition to the error of the grid; what is new is the oil
behind it, `void` of a line and `fill` of a point contact, and an inlet that is not full:

- a line takes `inlet_fill`, the share of the gap at the inlet;
- a point contact takes `inlet_layer_um`, the thickness of oil on both surfaces together. As it
  thins, the edge of the oil moves up to the contact and the central film h falls to the layer, at
  the density under pressure: with r the layer over the flooded film, at that density, h over the
  flooded film was found between r/(1 + r^g)^(1/g) with g = 2 and 5 (form of Chevalier et al. 1998).

Point contacts have it at rest, isothermal, with finite volumes, without touching solids, and for an
Eyring oil with sliding along x or y. Shear acts on the share of the surface that oil covers.

## Time and memory

Of one core of a small server, from the dry contact on, without the compilation of the first run:

| Contact | Nodes | CPU time | Memory of the process |
|---|---|---|---|
| line, `jamali_2015` | 1001 | 0.1 s | 0.26 GiB |
| line, `jamali_2015` | 4001 | 1.3 s | below 0.6 GiB |
| line with heat, `jamali_2015_thermal` | 1001 | 0.4 s | 0.26 GiB |
| point, `mourier_2006` | 129 x 129 | 0.5 s | 0.31 GiB |
| point, `mourier_2006` | 257 x 257 | 1.3 s | 0.38 GiB |
| point with heat, `elliptical_thermal` | 129 x 129 | 2.5 s | 0.4 GiB |
| point, `mourier_2006` | 513 x 513 | 4.0 s | 0.62 GiB |
| helical line marching, `jamali_2015_a` | 97 x 257 | 0.4 s a step | 0.41 GiB |

0.20 GiB of each are the libraries. A point contact's share grows with the nodes, that of a line
with their square.

## What the commands write

`line.nc` or `point.nc` (pressure, film, shear and history with units, scalars and the outcome as
attributes), `summary.csv` and `figures/`. Files appear whole or not at all. A contact that does not
converge is written all the same, is marked so, and ends with exit code 1.
"""

TAIL = """
## Errors

Every wrong field is named with its value, its range and its unit:

```text
my_case.toml has 1 wrong field(s). oil.viscosity_pa_s must be a number, 0.0001 to 10000 Pa.s, got
800000.0. At ambient pressure and the inlet's temperature.
```
"""


def page() -> str:
    """Return docs/ehl_case_file.md."""
    return (
        HEAD
        + "\n## Fields of both\n"
        + field_tables(LineCase, OIL)
        + "\n## Fields of a line contact\n"
        + field_tables(LineCase, LINE)
        + "\n## Fields of a point contact\n"
        + field_tables(PointCase, POINT)
        + "\n## Fields of a hypoid flank\n"
        + field_tables(HypoidCase, HYPOID)
        + "\n## Fields of a rough line contact\n"
        + ROLLING
        + field_tables(RoughCase, ROUGH)
        + TAIL
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
