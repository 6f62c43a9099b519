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
    "domain": "[domain]: left out: as far as load and film need",
    "profile": "[profile]: heights from a file",
    "solver": "[solver]",
}
POINT = {
    "": "Point contact: the file",
    "domain": "[domain]: left out: as far as load and film need",
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

These files ship (`gearlube_core/ehl/case/data/`). `gearlube ehl line --example` prints one to start
from.

| Command | Contact | Shipped case files |
|---|---|---|
| `gearlube ehl line` | line | `jamali_2015`, `jamali_2015_thermal` |
| `gearlube ehl point` | point | `mourier_2006`, `elliptical`, `elliptical_thermal` |
| `gearlube ehl point` | part of a line contact with a periodic film | `jamali_2015_section` |
| `gearlube ehl rough` | rough line | `jamali_2015_a`, `_a_straight`, `_b`, `_c` and `_d` |
| `gearlube ehl hypoid` | flank of a hypoid pair | `mohammadpour_2015` |

[rough_line_contact.md](rough_line_contact.md) shows results of rough line contacts. A hypoid case
takes its contacts from a mesh table. Its fields are at the end of this page, and
[ehl_hypoid.md](ehl_hypoid.md) shows results. Contact lines of helical pairs have no case file. They
come from the pair's [gear file](helical_gear_file.md), whose `[film_mesh]` can make the mesh finer
where the film leaves the contact. The rest of this page describes line and point contacts.

- Body 1 is below the film, body 2 above. Speeds are those of the surfaces relative to the contact,
  positive along x. The entrainment speed is their mean. The sliding speed is that of body 2 minus
  that of body 1. Speeds against x are negative.
- `reduced_modulus_gpa` is E' = 2 E*, with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. If it is left
  out, it is computed from the two bodies. By default the bodies are steel.
- Give either an oil of the library and a temperature, or the oil's own values. An Eyring stress
  acts on flow and friction. A limiting stress acts on the friction. In point contacts of an oil
  with an Eyring stress it acts on the flow too: above the limiting stress the film slips.
- `temperature = "thermal"` solves the energy balance together with the film, for line and point
  contacts. The results include the temperatures across the film and of both surfaces. The oil then
  needs `law = "houpert"`. In point contacts entrainment and sliding may have any direction, and one
  of the surfaces may stand still. The heat balance is met within 1e-6.

## Shapes of the gap

The smooth gap is x^2/(2 R) or x^2/(2 R_x) + y^2/(2 R_y). Surface heights are subtracted from it: a
positive height is a peak and makes the gap smaller. With `holds = "gap"` the file gives the whole
undeformed gap, up to a constant. Examples are tip relief, crown, or a flank from a measuring
machine. The radii then only set scales, domain and start.

- A profile is a [table](conventions.md#tables) with the columns `x_mm` and `height_um`. A cubic
  spline interpolates between the points.
- A height map is a NetCDF file with the dimensions x and y, or an `.npz` file with the arrays `x`
  (nx), `y` (ny) and `height` (nx, ny), in mm, mm and um. A bicubic spline interpolates between the
  points.
- A file must cover the domain, be at least as fine as the finest grid, and contain finite numbers
  only. Otherwise the case is refused, and the error gives both numbers. Details finer than the grid
  are not averaged: filter out wavelengths below about eight nodes first.
- Ridge, dent and waviness of a point contact are added, with or without a map. Sections of ridge
  and dent are Gaussian, z = A exp(-4 ln 2 (s/width)^2). Waves are cosines.
- The solutions are steady, so the heights must not move: they are on a surface that stands still,
  or constant along the motion. On a moving surface they would travel and squeeze the film. The
  command warns in this case.
- Film formulas and Hertz contacts in the summary are computed for the smooth gap.

## Where the film breaks

By default pressure and its slope are zero where the film breaks, and the gap behind counts as full
(Reynolds' condition). `cavitation = "mass_conserving"` also computes the oil content of the broken
film. There the oil moves with the mean speed of the surfaces. Pressure moves it only where the gap
is full (Jakobsson and Floberg 1957, Olsson 1965, Elrod 1981; pressure and void as complements as in
Giacopini et al. 2010). Oil mass is conserved within the tolerance. In a flooded contact film and
pressure agree with those of Reynolds' condition within the error of the grid. Two things are new:
the oil content behind the contact (`void` of a line contact, `fill` of a point contact), and an
inlet that is not full:

- For a line contact set `inlet_fill`, the share of the gap that is filled at the inlet.
- For a point contact set `inlet_layer_um`, the thickness of oil on both surfaces together. With a
  thinner layer the edge of the oil moves closer to the contact. The central film h then approaches
  the layer thickness, corrected for the density under pressure. Let r be this corrected layer
  thickness divided by the flooded film. The ratio of h to the flooded film was found between
  r/(1 + r^g)^(1/g) with g = 2 and with g = 5 (form of Chevalier et al. 1998).

In point contacts mass-conserving cavitation is available for steady isothermal films with finite
volumes and without touching solids. An Eyring oil must slide along x or y. Shear acts only on the
share of the surface that is covered with oil.

## Time and memory

Measured on one core of a small server, starting from the dry contact. The compilation in the first
run is not included.

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

The libraries take 0.20 GiB in each case. The rest grows with the number of nodes for a point
contact, and with its square for a line contact.

## What the commands write

`line.nc` or `point.nc` (pressure, film, shear and history with units, scalars and the outcome as
attributes), `summary.csv` and `figures/`. Files are written completely or not at all. A contact
that does not converge is written too. It is marked as not converged, and the exit code is 1.
"""

TAIL = """
## Errors

The error names every wrong field with its value, its range and its unit:

```text
my_case.toml has 1 wrong field(s). oil.viscosity_pa_s must be a number, 0.0001 to 10000 Pa.s, got
800000.0. Dynamic viscosity at ambient pressure and at the inlet temperature. Example: oils of ISO
VG 100 have 0.08 at 40 degC and 0.007 to 0.011 at 100 degC [arana_2019 Table 2].
```
"""


def page() -> str:
    """Return docs/ehl_case_file.md."""
    return (
        HEAD
        + "\n## Fields of both\n"
        + "\nNames in square brackets are sources: [bibliography.bib](bibliography.bib).\n"
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
