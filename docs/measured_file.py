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

Real gears differ from the surfaces that their machine settings describe. A measuring machine gives
these deviations as numbers on a grid of each flank. A measured-gear file (TOML) names the nominal
gear file and the CSV files with the measured values:

```
gearlube measured --example mine                  # an example: axle_17.toml and its CSV files
gearlube measured mine/axle_17.toml --out m       # reads, smooths, writes m/axle_17.toml
gearlube contact m/axle_17.toml --out m/contact   # contact of the measured flanks
gearlube sweep --mesh-table m/contact/axle_17.nc  # the axle with these flanks
```

The second command fits a smooth surface to each flank. It writes a gear file, a table of the
residuals of these fits, and a figure of every flank. The gear file stores the measured surfaces in
`surface_um` of its flanks. Every command that reads gear files accepts it. The data of the example
are invented, and its files say so.

## Deviations of the flanks

The [table](conventions.md#tables) has one line for each point, in any order:

```
member,flank,tooth,row,column,deviation_um
gear,drive,1,1,1,-3.2
```

- **member**: pinion or gear.
- **flank**: drive or coast, or convex or concave. The drive flank of the gear is convex, that of
  the pinion concave ([conventions](conventions.md#frame-of-the-hypoid-pair)).
- **tooth**: number of the tooth, from 1. Several teeth are averaged.
- **row**: counts from 1 at the root to the tip. **column**: counts from 1 at the toe to the heel.
  Rows are evenly spaced over the tooth height, columns along the pitch cone. The grid ends at its
  insets from the edges.
- **deviation_um**: deviation along the outward normal of the nominal flank, in micrometres.
  **Plus means more material.** The nominal flank is that of the gear file, including its reliefs.
- **Middle point**: usually the measuring machine turns the member until the deviation at the middle
  point is zero. This is `middle_point = "zero"`, and it is checked. With
  `middle_point = "measured"` the mean deviation stays in the flank. It only shifts the zero of the
  rotation angles, which has no effect on the results. Backlash is a separate input of the axle.

File layouts differ between machines. Convert your file to this layout. If your grid is listed from
the tip down, for example, reverse the row numbers.

## Wrong and corrective machine settings

```
gearlube measured mine/axle_17.toml --fit pinion.machine.tilt_angle_deg \\
    --fit pinion.machine.radial_setting_mm
```

This command assumes that wrong machine settings caused the measured deviations. A least-squares fit
finds the changes of the named settings that explain the deviations best, on both sides of the
member at once. It also gives the uncertainty of each change. The corrective settings are the
nominal settings minus these changes, to first order. The command refuses settings whose effects on
the flanks are nearly the same. The results are written to settings.csv. The fit was tested on data
made with changes of 0.1 deg and 0.05 mm: without noise it returns these values within 1e-5
(`tests/analytical/test_settings_fit.py`). The data of the example were made with 0.05 deg and 0.03
mm.

## Errors of single teeth

Pitch errors, eccentricity, wobble and waves make each tooth differ from the next. These errors do
not change the flanks of the gear file. They are added to the mesh table after the contact analysis:

```
gearlube measured mine/axle_17.toml --table m/contact/axle_17.nc --out m/teeth
gearlube sweep --mesh-table m/teeth/axle_17.nc     # the axle with teeth that differ
gearlube build-fmu --mesh-table m/teeth/axle_17.nc
```

**Counting**: teeth are counted in the order in which they come into mesh when the pair is driven
forward. Tooth 2 follows tooth 1. Tooth 1 of the pinion meets tooth 1 of the gear at mesh phase
zero.

**Pitch** (`pitch`): one line for each tooth of a flank. All teeth are needed.

```
member,flank,tooth,deviation_um
gear,drive,1,0.0
```

The deviation is in micrometres along the circle of `pitch_radius_mm`. There are two kinds. A
cumulative deviation is the distance of the flank from its nominal place, positive in the sense of
counting. Its mean has no effect. A single deviation is the change from the tooth before; for tooth
1 the tooth before is the last tooth. Single deviations must sum to zero within 2 um.

**Eccentricity** (`eccentricity_um`, `eccentricity_phase_deg`): distance between the axis of the
measurement and the axis about which the member runs in the axle. The pitch deviations already
include any eccentricity about the axis of the pitch measurement. So do not give a runout that was
measured about the same axis as the pitch. Runout, peak to peak, is twice the eccentricity.

**Wobble** (`wobble_um`, `wobble_phase_deg`): tilt of the teeth relative to the running axis, as for
a ring gear that is not mounted square. The value is half of the axial runout, peak to peak, at the
pitch radius. The centre of the tilt is the point of the axis at the level of the mean point.

**Waves** (`waviness`): one line for each number of waves per turn.

```
member,flank,waves,amplitude_um,phase_deg
gear,drive,83,0.4,45
```

The deviation is A cos(n theta + phase), positive for more material. theta is the rotation of the
member in the drive direction at which the point of the flank is in contact. So the waves run along
the lines of contact. Waves caused by the work spindle drive of the cutting machine have this
direction. theta is zero where tooth 1 is at the mean point.

### From tooth errors to orders

1. For each mesh phase the program computes a curve for every tooth pair: the torque that the pair
   carries as a function of the pinion's rotation, with elastic teeth and the gap of its flanks.
2. The errors of the two teeth shift this curve.
3. All pairs together carry the applied torque at some rotation of the pinion. The added error is
   this rotation minus that of nominal teeth. It is multiplied by the mean arm of the mesh force to
   give metres.
4. Steps 1 to 3 are done for every mesh of the hunting turn (the period after which the same teeth
   meet again, 468 meshes for the shipped pair), for every torque of the table and for both sides.
5. The result is split into a part that repeats with each turn of the pinion and a part that repeats
   with each turn of the gear. Both are stored as orders: `e_pinion` and `e_gear` of the mesh table.
   The dynamic models add them to the transmission error e and its rate, in Python and in the FMUs.

So a pitch error acts as far as load sharing allows. It gives its own order and sidebands of the
mesh order. n waves per turn give order n. The part that repeats with the hunting turn only is left
out of the mesh table. The command prints its root mean square; in the example this is 0.01 to 0.09
um, beside errors of 15 um. The report and tooth_errors.nc (`hunting_amplitude`) have its largest
orders. In the example they are, on the drive flanks (`python -m docs.measured.make`):

| Order of the pinion | Of the gear | 20 N.m [nm] | 50 N.m [nm] | 100 N.m [nm] | 200 N.m [nm] |
|---|---|---|---|---|---|
| 0.6389 = 1 - 13/36 | 1.7692 | 14.2 | 8.9 | 5.2 | 3.3 |
| 1.3611 = 1 + 13/36 | 3.7692 | 13.7 | 8.9 | 5.1 | 3.3 |
| 4.0556 | 11.2308 | 18.5 | 10.6 | 5.2 | 2.9 |
| 0.9444 | 2.6154 | 18.1 | 9.2 | 4.1 | 2.5 |
| 1.9444 | 5.3846 | 17.7 | 8.9 | 3.6 | 2.1 |
| 2.2500 | 6.2308 | 16.5 | 10.5 | 6.0 | 3.6 |

The first two are sums and differences of one turn of the pinion and one of the gear: load sharing
multiplies the two errors. The others come from the scatter from tooth to tooth. All are below 0.02
um, a thousandth of the errors themselves.

For a flank that is turned about its axis, as by a pitch error, the result is accurate within 1 % of
a direct solution of all pairs with changed gaps. This difference is due to the cells of the curves.
Wobble, eccentricity and waves vary over the contact of a pair. There the mean over the contact is
used, weighted with the growth of the forces. Stiffness, load shares and films remain those of
nominal teeth. The mesh force of the axle is therefore right near the torques of the table. It is
less accurate if an error is so large that a tooth loses contact.

`tests/analytical/test_tooth_errors.py` checks that waves give their order with their amplitude,
that an eccentric member acts with the lever of the normal force, and that pitch errors agree with
the stiffness of the pairs and with all pairs solved together.

## Nominal points

With `nominal_points` the grids need no sections of their own. The CSV file has one line for each
point, with rows and columns as for the deviations:

```
member,flank,row,column,x_mm,y_mm,z_mm
```

The frame of each member is right-handed. Its z axis is the member's axis and points away from the
crossing point of the axes. The zeros of z and of the angle are free. Each grid must lie within 2 um
of the flank of the gear file, after one rotation and one axial shift. If it does not, the error
message gives the distance. It also says whether the grid fits the other flank, the other hand, the
opposite z direction or another unit. For comparison: a tilt angle that is wrong by 0.1 deg gives
4 um rms.

## What is refused

These data are refused, with an error that names file and line:

- missing points and missing teeth; the message names them
- points or teeth that are given twice
- flanks called left and right
- members without a described grid
- numbers above 500 um
- grids whose largest deviation is below 0.1 um; most likely the unit is wrong
- middle points that are not zero

Without nominal points one mistake is not detected: a grid with rows or columns in the wrong order,
or of the wrong hand, whose middle point is still zero.

## The smooth surface

Each flank gets a polynomial of low degree in the profile and face-width positions. It is fitted to
the mean of the measured teeth. The residual of the fit is given as a root mean square and shown in
report.html. The report also shows how far single teeth deviate from their mean.

A surface through all points would follow the noise of the probe, and the contact is sensitive to
curvature. A cubic has 10 coefficients. From 45 points with 1 um of noise each it keeps 0.47 um of
noise: 0.3 um in the middle and 1.7 um in the corners, which lie outside the grid. A higher degree
keeps more noise.

The smooth surface was tested with the shipped pinion cut with 0.1 deg more tilt and 0.05 mm more
radial setting. This changes the flank by 12 um and was entered as 5 x 9 numbers
(`tests/analytical/test_measured_flanks.py`). The transmission error at 100 N.m is then reproduced
within 0.6 urad by a cubic and within 0.4 urad by the fourth degree. The changed settings themselves
change it by 45 urad.
"""

SHOW = """
## From measured data to the axle's spectrum

This example goes from invented data to the mesh force (`python -m docs.measured.make`). The data
are in `docs/measured/data.py`:

- pitch errors of 4 and 8 um once per turn (pinion and gear), with noise from tooth to tooth
- eccentricities of 5 and 10 um
- 31 waves of 0.3 um on the pinion and 83 waves of 0.4 um on the gear

The operating point is 60 N.m and 145 rad/s of the pinion, 60 km/h.

![What single teeth add to the transmission error](images/measured_teeth.png)

*Added error over a turn, and its orders, at 20 and 200 N.m. Load sharing reduces the steps from
tooth to tooth. They become smaller with more load.*

![Spectrum of the mesh force](images/measured_spectrum.png)

*Amplitudes over the hunting turn, 36 turns of the pinion. If all teeth are equal, only mesh orders
appear.*

"""

AFTER = """
The force is due to inertia and grows with the square of the frequency. So waves of a third of a
micrometre give large force amplitudes. Pitch errors and eccentricities are up to thirty times
larger, but they act once per turn and cause little force at their own order. They do cause
sidebands of the mesh orders. The broad feet of the lines come from the speed, which is not yet
quite steady.

The FMU gives the same picture. `gearlube sweep --mesh-table m/teeth/axle_17.nc --speeds 60
--preload 2500` gives these amplitudes of `mesh.dte`: 506 nm at the mesh order, 19 and 10 nm one
order of the pinion below and above it, 34 nm at order 1 and 10 nm at order 31. The sweep evaluates
whole turns of the pinion, so orders of the gear fall between its frequency lines.
"""

TAIL = """
## Limits

- Details finer than the polynomial, such as feed marks and single scratches, are left out.
- Between the outermost points and the edges the polynomial is extrapolated.
- Several teeth of a grid are averaged. Teeth differ only by pitch, eccentricity, wobble and waves.
- Orders are kept up to a quarter of `--positions` times the number of teeth. Sharp corners of a
  step have higher orders and are lost.
- With the 147 orders of the example the computing time of the axle is about 1.5 times as long.
- In these errors the gear turns in proportion to the pinion. The vibration that the errors cause is
  not fed back.
- `gearlube map` computes the losses of nominal teeth. The torsional pair (`gearlube resonance`)
  refuses such a table, because its motions have the mesh period.
"""


def page() -> str:
    """Return docs/measured_file.md."""
    fields = "\n## Fields\n" + field_tables(MeasuredFile, SECTIONS)
    return HEAD + SHOW + lines_table() + AFTER + fields + TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
