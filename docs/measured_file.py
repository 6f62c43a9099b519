"""Rewrite docs/measured_file.md: python -m docs.measured_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile

PAGE = Path(__file__).with_suffix(".md")
SECTIONS = {
    "": "The file",
    "gear.grid": "[pinion.grid] and [gear.grid]: where the points of the deviations lie",
}

HEAD = """# Measured gears

The tables are written by `python -m docs.measured_file` from the data model
(`gearlube_core/hypoid_geometry/measured/measured_file.py`), the text with them; not edited by
hand.

Gears are not what their machine settings say. A measuring machine says what they are: numbers on
a grid of each flank. A measured-gear file (TOML) names the nominal gear file and the CSV files:

```
gearlube measured examples/measured/axle_17.toml --out m   # reads, smooths, writes m/axle_17.toml
gearlube contact m/axle_17.toml --out m/contact            # contact of the measured flanks
gearlube sweep --mesh-table m/contact/axle_17.nc           # the axle with them
```

The first command writes a gear file, a table of what the smooth surfaces leave over, and a
figure of every flank. The gear file has the measured surfaces in `surface_um` of its flanks; all
that reads gear files takes it. The data of the example are made, and its files say so.

## Deviations of the flanks

One line for each point, in any order; lines that begin with # are left out:

```
member,flank,tooth,row,column,deviation_um
gear,drive,1,1,1,-3.2
```

- **member**: pinion or gear.
- **flank**: drive or coast, or convex or concave. The drive flank of the gear is convex, that of
  the pinion concave ([conventions](conventions.md#frame-of-the-hypoid-pair)).
- **tooth**: its number, from 1. Several teeth are averaged.
- **row**: from 1 at the root to the tip. **column**: from 1 at the toe to the heel. Rows and
  columns lie evenly between the insets of the grid, in tooth height and along the pitch cone.
- **deviation_um**: along the outward normal of the nominal flank, in micrometres. **Plus is more
  material.** The nominal flank is that of the gear file, with its reliefs.
- **Middle point**: usually the member is turned until the middle point is zero (`middle_point =
  "zero"`, which is checked). With `middle_point = "measured"` the mean stays in the flank: it
  moves the zero of the angles, which nothing here feels. Backlash is a number of the axle.

Layouts differ from machine to machine. Turn yours into this one; of a grid listed from the tip
down, for instance, the rows count backwards.

## What is refused

Missing points (they are named), points that are there twice, flanks called left and right,
members without a described grid, numbers beyond 500 um, grids whose largest deviation is below
0.1 um (in another unit, most likely), middle points that are not zero. Every sentence names file
and line.

Not found out: a grid with rows or columns in the wrong order, or of the wrong hand, where its
middle point still is zero.

## The smooth surface

Each flank gets a polynomial of a low degree in the profile and the face position, fitted to the
mean of its teeth. What it leaves is told as a root mean square and shown in flanks.png. Beside
it stands how far single teeth lie from their mean.

A surface through all points would follow the noise of the probe, and contact feels curvature. A
cubic has 10 coefficients: of 45 points with 1 um of noise it keeps 0.47 um, 0.3 um in the middle
and 1.7 um in the corners, which lie outside the grid. A higher degree keeps more.

The test: the shipped pinion cut with 0.1 deg more tilt and 0.05 mm more radial setting, 12 um
over the flank, entered as 5 x 9 numbers (`tests/analytical/test_measured_flanks.py`). Its
transmission error at 100 N.m comes out within 0.6 urad by a cubic and 0.4 urad by the fourth
degree; the settings change it by 45 urad.
"""

TAIL = """
## Limits

- What is finer than the polynomial, such as marks of the feed and single scratches, is left out.
- The polynomial goes on from the outermost points to the edges.
- Teeth are averaged; that they differ is not in the contact.
- No fit of machine settings to the deviations.
"""


def page() -> str:
    """Return docs/measured_file.md."""
    return HEAD + "\n## Fields\n" + field_tables(MeasuredFile, SECTIONS) + TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
