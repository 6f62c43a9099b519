"""Rewrite docs/measured_file.md: python -m docs.measured_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from docs.measured.make import lines_table
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile

PAGE = Path(__file__).with_suffix(".md")
SECTIONS = {
    "": "The file",
    "gear": "[pinion] and [gear]",
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

## Settings that were wrong, and corrective ones

```
gearlube measured examples/measured/axle_17.toml --fit pinion.machine.tilt_angle_deg \\
    --fit pinion.machine.radial_setting_mm
```

finds by least squares with which changes of these settings the nominal flanks would have the
measured deviations, of both sides of the member at once, and how uncertain that leaves them. The
nominal settings less these changes are the corrective ones, to first order. Settings that do
nearly the same to the flanks are refused. Numbers are written to settings.csv. The example was
made with 0.05 deg and 0.03 mm; 0.1 deg and 0.05 mm come back to 1e-5 without noise
(`tests/analytical/test_settings_fit.py`).

## Errors of single teeth

Pitch, a running axis beside or askew to that of the teeth, and waves make one tooth differ from
the next. They do not change the flanks of the gear file. They enter the mesh table, after the
contact analysis:

```
gearlube measured examples/measured/axle_17.toml --table m/contact/axle_17.nc --out m/teeth
gearlube sweep --mesh-table m/teeth/axle_17.nc     # the axle with teeth that differ
gearlube build-fmu --mesh-table m/teeth/axle_17.nc
```

**Counting**: teeth are counted in the order in which they come into mesh when the pair is driven
forward; tooth 2 follows tooth 1. Tooth 1 of the pinion meets tooth 1 of the gear at mesh phase
zero.

**Pitch** (`pitch`): one line for each tooth of a flank, all of them.

```
member,flank,tooth,deviation_um
gear,drive,1,0.0
```

In micrometres along the circle of `pitch_radius_mm`. Cumulative: how far the flank lies further
on in the sense of counting than it should; the mean does not count. Single: the change of that
from the tooth before, tooth 1 from the last; they must sum to zero within 2 um.

**Eccentricity** (`eccentricity_um`, `eccentricity_phase_deg`): of the teeth from the axis about
which the member runs in the axle, beside that about which it was measured. What pitch was
measured about is in the pitch deviations already. A runout (twice the eccentricity, peak to
peak) that was measured about the same axis as pitch must not be given again.

**Wobble** (`wobble_um`, `wobble_phase_deg`): tilt of the teeth against the running axis, as of a
ring gear that does not sit square: half of the axial runout, peak to peak, at the pitch radius.
The tilt is about the point of the axis at the level of the mean point.

**Waves** (`waviness`): one line for each number of waves a turn.

```
member,flank,waves,amplitude_um,phase_deg
gear,drive,83,0.4,45
```

The deviation is A cos(n theta + phase), plus for more material, with theta the rotation of the
member in the drive direction at which a point of the flank is in contact. So waves run along the
lines of contact, as those do that come from the drive of the machine's work spindle. theta is
zero where tooth 1 stands at the mean point.

### From teeth to orders

For each mesh phase every tooth pair gets a curve: the torque that it carries by the pinion's
rotation, on elastic teeth with the gap of its flanks. The errors of its two teeth shift the
curve. The rotation at which all pairs together carry the torque, less that of nominal teeth, is
the added error; times the mean arm of the mesh force it is in metres. This is done for every
mesh of the hunting turn (468 of the shipped pair) at every torque of the table, and for both
sides.

From the hunting turn come a part that repeats with the pinion and one that repeats with the
gear, each as orders of its turn: `e_pinion` and `e_gear` of the mesh table. The dynamics add
them to the error e and its rate, in Python and in the FMUs. A pitch error thus acts as the load
sharing lets it, and gives its order and sidebands of the mesh order; n waves a turn give order
n. What repeats with the hunting turn alone is left out. The command tells its root mean square;
in the example it is 0.01 to 0.09 um beside errors of 15 um.

Exact up to the curves' cells where a flank is turned about its axis, as by pitch: 1 % of the
direct solution of all pairs with changed gaps. Displacements and waves vary over the contact of
a pair; their mean over it is taken, weighted with the growth of the forces. Stiffness, load
shares and films stay those of nominal teeth: the mesh force of the axle is right about the
table's torques, less so where an error is so large that a tooth loses contact.

`tests/analytical/test_tooth_errors.py` has waves that return as their order with their
amplitude, an eccentric member with the lever of the normal force, pitch errors against the
stiffness of the pairs and against all pairs solved together.

## Nominal points

With `nominal_points` the grids need no sections. One line for each point, rows and columns as in
the deviations:

```
member,flank,row,column,x_mm,y_mm,z_mm
```

in a right-handed frame of the member, z along its axis and away from the crossing point of the
axes; where the zeros of z and of the angle lie does not matter. Each grid must lie within 2 um
of the flank of the gear file, after one rotation and one axial shift. If it does not, the
sentence says how far it is off, and whether it fits the other flank, the other hand, z the other
way round or another unit. A tilt angle that differs by 0.1 deg is 4 um rms.

## What is refused

Missing points and teeth (they are named), what is there twice, flanks called left and right,
members without a described grid, numbers beyond 500 um, grids whose largest deviation is below
0.1 um (in another unit, most likely), middle points that are not zero. Every sentence names file
and line.

Not found out without nominal points: a grid with rows or columns in the wrong order, or of the
wrong hand, where its middle point still is zero.

## The smooth surface

Each flank gets a polynomial of a low degree in the profile and the face position, fitted to the
mean of its teeth. What it leaves is told as a root mean square and shown in report.html. Beside
it stands how far single teeth lie from their mean.

A surface through all points would follow the noise of the probe, and contact feels curvature. A
cubic has 10 coefficients: of 45 points with 1 um of noise it keeps 0.47 um, 0.3 um in the middle
and 1.7 um in the corners, which lie outside the grid. A higher degree keeps more.

The test: the shipped pinion cut with 0.1 deg more tilt and 0.05 mm more radial setting, 12 um
over the flank, entered as 5 x 9 numbers (`tests/analytical/test_measured_flanks.py`). Its
transmission error at 100 N.m comes out within 0.6 urad by a cubic and 0.4 urad by the fourth
degree; the settings change it by 45 urad.
"""

SHOW = """
## From measured data to the axle's spectrum

The example, from its made data (`docs/measured/data.py`: 4 and 8 um of pitch error once a turn with
noise from tooth to tooth, 5 and 10 um of eccentricity, 31 waves of 0.3 um on the pinion and 83 of
0.4 um on the gear) to the mesh force at 60 N.m and 145 rad/s of the pinion, 60 km/h
(`python -m docs.measured.make`).

![What single teeth add to the transmission error](images/measured_teeth.png)

*Added error over a turn, and by orders, at 20 and 200 N.m. Load sharing leaves little of the
steps from tooth to tooth, and less with more load.*

![Spectrum of the mesh force](images/measured_spectrum.png)

*Amplitudes over the hunting turn, 36 turns of the pinion. With all teeth alike there are mesh
orders alone.*

"""

AFTER = """
Inertia makes the force: it grows with the square of the frequency. So waves of a third of a
micrometre stand out, and pitch and eccentricity, up to thirty times larger but once a turn, give
little force of their own. They return beside the mesh orders. The feet of the lines are from the
speed, which still settles a little.

The same in the FMU: `gearlube sweep --mesh-table m/teeth/axle_17.nc --speeds 60 --preload 2500` has
506 nm of mesh order in the spectrum of `mesh.dte`, 19 and 10 nm one order of the pinion below and
above it, 34 nm of order 1 and 10 nm of order 31. Its windows are whole turns of the pinion: orders
of the gear fall between its bins.
"""

TAIL = """
## Limits

- What is finer than the polynomial, such as marks of the feed and single scratches, is left out.
- The polynomial goes on from the outermost points to the edges.
- Grids of several teeth are averaged; teeth differ by pitch, eccentricity and waves alone.
- Orders are kept up to a quarter of `--positions` times the teeth; the corners of a step lie
  above.
- The axle takes about half as long again with the 147 orders of the example.
- The gear turns in proportion to the pinion in these errors; that they shake it does not count.
- The losses of `gearlube map` are those of nominal teeth. The torsional pair (`gearlube
  resonance`), whose motions have the mesh period, refuses such a table.
"""


def page() -> str:
    """Return docs/measured_file.md."""
    fields = "\n## Fields\n" + field_tables(MeasuredFile, SECTIONS)
    return HEAD + SHOW + lines_table() + AFTER + fields + TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
