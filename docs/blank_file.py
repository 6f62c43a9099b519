"""Rewrite docs/blank_file.md: python -m docs.blank_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from gearlube_core.hypoid_design.blank_file import BlankFile

PAGE = Path(__file__).with_suffix(".md")
SECTIONS = {
    "": "The file",
    "pair": "[pair]",
    "cutter": "[cutter]",
    "depth": "[depth]: may be left out",
    "contact": "[contact]: may be left out",
    "machine": "[machine]: may be left out",
    "relief": "[relief]: may be left out",
}

# relief [um] and highest pressure [GPa], drive and coast, as the heads of `_relief_table` say
RELIEF = (
    ("13/42, 170 mm, offset 15 mm", 300, "20, 32, 30", "25, 25, 30", "1.78, 1.77, 1.78",
     "1.82, 1.84, 1.84"),
    ("11/43, 200 mm, offset 30 mm", 410, "25, 32, 60", "32, 32, 30", "1.66, 1.68, 1.67",
     "1.78, 1.79, 1.79"),
    ("9/41, 190 mm, offset 25 mm", 300, "25, 40, 60", "32, 32, 30", "1.89, 1.90, 1.90",
     "1.96, 1.96, 1.96"),
    ("11/39, 190 mm, offset 45 mm", 390, "20, 25, 94", "32, 25, 30", "1.27, 1.28, 1.28",
     "1.38, 1.39, 1.39"),
)  # fmt: skip

HEAD = """# The blank file

The tables are written by `python -m docs.blank_file` from the data model
(`gearlube_core/hypoid_design/blank_file.py`), the text with them; not edited by hand.

A blank file gives the few numbers from which a hypoid or bevel pair is designed: teeth, offset,
size, spiral angle and cutter. Pitch cones, face widths, tooth heights and thicknesses are computed
from them by ISO 23509. One blank ships, `hypoid_13_42`
(`gearlube_core/hypoid_design/data/hypoid_13_42.toml`).

The tooth depth is the same from toe to heel, as in [gear files](gear_file.md): the pitch, face and
root cones of a member are parallel. The axes are at 90 degrees.

**Hand**: a pair with a left-handed pinion is computed as the mirror image of a right-handed pair, y
-> -y in the [frame of the pair](conventions.md#frame-of-the-hypoid-pair). All numbers are the same:
pitch cones, contact, transmission error, stiffness, axial forces. For both hands the drive flanks
are the concave flanks of the pinion. The sense of rotation is reversed. With `pinion_hand = "left"`
the exported flanks and bodies, the nominal measured points and the REXS files are those of the
left-handed pair. On the machine some settings are on the other side: vertical setting, blank
offset, cradle angle and swivel angle change their signs.

## The four methods

| Method | For | Needs | Condition for the pitch cones |
|---|---|---|---|
| 0 | bevel gears, no offset | outer diameter, gear spiral angle | the cones meet in one apex |
| 1 | hypoid gears | outer diameter, pinion spiral angle | tooth has the cones' limit curvature |
| 2 | hypoid gears | mean diameter, gear spiral angle | apexes and cutter centre lie on one line |
| 3 | hypoid gears | outer diameter, gear spiral angle | the cones meet the cutter condition |

Diameters are those of the gear. Only one spiral angle can be chosen, because the two pitch cones
must touch. The other one follows. In method 1 the place of the calculation point follows from the
first estimate of the pitch angle and is not the middle of the face. The other methods use the
middle.
"""

TAIL = """
## What comes out

```python
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.blank_limits import check_blank
from gearlube_core.hypoid_design.designed_blank import DesignedBlank

designed = DesignedBlank.from_file(BlankFile.from_toml("my_blank.toml"))
print(*check_blank(designed), sep="\\n")
for note in (*designed.file.inputs(), *designed.results()):
    print(note.field, note.value_text, note.unit, note.origin, note.why)
```

Every number has an origin: `given` in the file, `assumed` because the file does not give it, or
`inferred` because it follows from the others.

- **Heights**: the working depth is k_d m_mn, the gear addendum is c_ham times the working depth,
  the clearance is k_c times the working depth. Without `gear_addendum_factor`, c_ham is 0.21 + 0.29
  (z_1/z_2)^2. For the shipped pair this gives 0.248; the pair has 0.25.
- **Face width of the pinion**: wide enough to cover the gear's face. Method 1 extends both ends by
  the rotation of the root plane. Method 2 multiplies by 1 + tan^2 of the offset angle. Method 3
  adds 3 m_mn times the tangent of the offset angle and rounds up to whole millimetres.
- **Thickness**: teeth and slots are equally wide at the middle of the working depth, because a gear
  file has one point radius for the blades of both flanks. There is no backlash in this thickness.
- **Blade angles**: effective pressure angle plus limit pressure angle on the gear's drive flank,
  and effective minus limit pressure angle on its coast flank. Both flanks then roll alike.

## Machine settings

```
gearlube design --example > my_blank.toml         # a blank file to start from
gearlube design my_blank.toml --out my_design     # a minute
gearlube contact my_design/hypoid_13_42.toml --out my_design/contact   # under load
gearlube map my_design/axle.toml                  # losses; also sweep, cycle, build-fmu --axle
gearlube design my_blank.toml --out my_design --optimise   # and a quieter pair, some minutes
```

`--optimise` runs `gearlube optimise my_design/problem.toml` after the design. That problem file is
written in any case: crowns, twist and tip relief of the drive flanks and the pinion's settings may
change, at 15 and 30 % of the torque of the relief, with small errors of assembly, and under limits
of pressure, loss, sensitivity and coast flanks. Change it as you like
([problem_file.md](problem_file.md)) and run it again. The quieter pair has a report of its own in
`my_design/optimised`. On the shipped blank it changed
all mesh orders together by -10.0 dB at 45 N.m and -5.4 dB at 90 N.m, and by -8.2 and -4.3 dB with
the worst error of assembly. Highest pressure (1.03 and 1.23 GPa), sliding loss and sensitivity
rose by 0.4 % at most. Order 2 alone rose by 10 dB at 45 N.m. That took 7 minutes beside other work.
The search is local, and not every design gains as much: read the report, and try other ranges or
starts. [optimise.md](optimise.md) has three more pairs.

These five commands lead from "13 to 42 teeth, 15 mm offset" to a loss map and FMUs. They take about
seven minutes on a small machine, five of them for the FMUs of five platforms:

```
gearlube design --example > my_blank.toml
gearlube design my_blank.toml --out my_pair
gearlube contact my_pair/hypoid_13_42.toml --out my_pair/contact --quick
gearlube map my_pair/axle.toml --out my_map
gearlube build-fmu --axle my_pair/axle.toml --out my_fmus
```

`gearlube design` writes:

- the gear file, named after `name`
- `axle.toml`, an [axle file](axle_file.md) for you to complete
- `problem.toml`, a [problem file](problem_file.md) that makes the pair quieter
- `report.html` and `design.nc`
- `figures/`: contact patterns with ease-off, transmission error, widths of the teeth

The report compares for the contact what was asked and what was found. For the teeth it gives
topland, slot width, undercut and the largest possible blade point width. For every number it says
whether it was given, chosen or computed. If a target was not met, the report says how close the
design came and which requirement to relax. If one of the two flanks does not touch at all, nothing
is written.

In Python:

```python
from gearlube_core.hypoid_design.design import design_pair

design = design_pair(designed.file)
design.file  # a gear file for `gearlube contact`
design.measured["drive"]  # result of the contact analysis for each target
```

1. **Gear**: form-cut (Formate), or generated by a rolling cradle (`gear = "generated"`). The cutter
   is placed so that its blade passes the calculation point at the spiral angle of the blank. The
   reference plane is at the middle of the working depth.
2. **Start of the pinion**: for a form-cut gear, the start is the pinion that the gear itself would
   cut if the cradle turned as the gear does in mesh. Such flanks are conjugate: they have no
   crowning and no transmission error. For a generated gear, the start is a pinion generated by a
   crown gear. It is conjugate without offset, and 0.1 mm off with 15 mm offset.
3. **Target gap** (ease-off): a parabola along every contact line, 6.35 um at the ends of the
   contact ellipse, and a parabolic transmission error along the path of contact. Transmission
   error, ellipse length and path direction are the three coefficients of the second-order gap at
   the mean contact point.
4. **Fit**: a least-squares fit over both flanks changes eleven settings of the pinion's machine and
   cutter. It also changes what `[machine]` allows: the edge radii of the blades (one for each
   flank), modified roll, helical motion. The coast flank has 0.3 of the weight of the drive flank.
   On both flanks the mean contact point and the path have ten times the weight. The reference plane
   of the cutter stays at the middle of the working depth, and the backlash stays zero.
5. **Check**: the unloaded contact analysis of the finished gear file. Its deviations from the
   targets are subtracted from the targets, and the fit is repeated, for up to six rounds. If a
   flank with a free path direction still fails, a path direction closer to normal to the contact
   lines is tried.

Both flanks of the pinion are cut in one set-up (completing). Separate set-ups for the two flanks
and tapered teeth are not implemented.

**Results on samples** (`tests/analytical/test_designed_pair.py`): three pairs meet their targets of
50 and 80 urad within 1 %, path directions within 1 deg and the mean contact point within 0.2 mm.
They are hypoid 13/42 with 15 mm offset, the bevel pair 14/39 and the face-hobbed 13/42. With a
generated gear 13/42 and 14/39 meet them too, 13/42 also face-hobbed. The fit needs one more free
parameter besides the eleven settings:

| Blades | Modified roll | Helical motion | 13/42 face-milled, form-cut gear |
|---|---|---|---|
| curved, a radius for each flank | no | no | targets met |
| straight | no | no | no extreme of the transmission error on the coast flanks |
| straight | yes | no | transmission error of the drive flanks 92 instead of 50 urad |
| straight | yes | yes | targets met, also with a generated gear |

**The shipped pair, designed from its blank only**
(`tests/literature/test_designed_shipped_pair.py`): outer diameter 165 mm, spiral angle 46 deg,
offset 24 mm, cutter radius 64 mm with 11 blade groups. On each flank the targets are the contact
place, transmission error, ellipse and path of the paper's settings. The ease-offs of the design and
of the paper then differ by 4.5 um (drive) and 3.4 um (coast) rms, of 135 and 121 um. Where the
flanks are closer than 30 um, they differ by 1.4 and 1.0 um. The difference is in the corners of the
flanks: the second-order terms agree, the third-order terms do not. The machine settings differ, the
tilt by 2 deg: many different settings give almost the same flank.

**48 designs** of five ratios, offsets of 10 to 45 mm, milled and hobbed, form-cut and generated:
[designs.md](designs.md). The designs that fail have offsets of nearly half the gear's radius.

**Relief**: designed flanks get tip relief on both members and end relief on the pinion. Without
relief the edges carry load even at small torques: 13/42 then has 4.4 GPa at 150 N.m and more than
three pairs of teeth in contact. The targets are for the flanks as cut, without relief. A given
amount of relief is enough up to some torque. So the amounts that the file leaves open are chosen
for a torque: `torque_n_m`, or else the torque at which the gear carries 0.2 N/mm2 times the cube of
its outer diameter (300 N.m for the pinion of the example). The loaded contact is computed at
twelve positions of the mesh, with finite-element teeth. While it reaches an edge, the relief of
that edge rises by a quarter, on each side and member for itself. It begins with 20 um at the tips
and 30 um at the ends. The highest pressure at that torque is then the same with coarse and fine
cells within 2 %
(`tests/analytical/test_chosen_relief.py`):

RELIEF_TABLE

More relief costs transmission error at small torques. If your torque is lower, name it. With both
amounts given and no torque, the loaded contact is not computed, and the design takes a third of the
time. `gearlube contact` names the edges that carry load, and the torque from which they do.

The report contains a remark if a result misses its target by more than this: transmission error 10
% on drive flanks and 15 % on coast flanks, path direction 2 deg, mean contact point 0.5 mm, ellipse
length 25 %.

## Against printed samples

`tests/literature/test_designed_blanks.py` compares with ISO 23509:2016, annex F, hypoid samples F.3
(method 1), F.4 (method 2) and F.5 (method 3). The standard stops its iterations early. Here the
conditions are solved to rounding. The difference is due to the tolerance of the standard: 0.18 mm
for the cone distances of F.4, and within 0.02 mm for all values of F.3 and F.5. F.3 has tapered
teeth in the standard. Its cones and face widths are compared, but not its tooth depths.

## Blanks that cannot exist

| Check | Refused | Warning |
|---|---|---|
| Offset, spiral angle, cutter radius: cones that meet the condition of the method | none found | |
| Spiral angle of the gear, after subtraction of the offset angle | below 0 | |
| Blade angle: pressure angle plus or minus limit pressure angle | outside 5 to 40 deg | |
| Cutter over the gear's face | does not reach; spiral above 65 deg | spiral of the other hand |
| Face width over outer cone distance | above 0.45 | above 0.35 |
| Calculation point | not on the face | |
| Blade groups and teeth | a common factor | |
| Topland at mid-face | none (pointed) | below 0.2 normal modules |
| Tip clearance | | below 0.1 normal modules |
| Undercut at mid-face by the mate's tip | any | |

Topland and undercut are those of the virtual spur gear in the normal section. This is an estimate,
good enough to choose a blank. `gearlube_core/hypoid_geometry/flank/tooth_form.py` checks the teeth
as cut.

These parts of ISO 23509 are not implemented: tapered depth (standard, duplex, tilted root line),
shaft angles other than 90 degrees, thickness factors and backlash, and the pinion's offset angle in
the root plane. The offset angle in the axial plane is used instead.
"""


def page() -> str:
    """Return docs/blank_file.md."""
    tail = TAIL.replace("RELIEF_TABLE", _relief_table())
    return HEAD + "\n## Fields\n" + field_tables(BlankFile, SECTIONS) + tail


def _relief_table() -> str:
    lines = [
        "| Design | Torque [N.m] | Relief of pinion tip, gear tip, ends [um]: drive | coast | "
        "Highest pressure [GPa] with 24 x 36, 48 x 72, 96 x 144 cells: drive | coast |",
        "|---|---|---|---|---|---|",
    ]
    return "\n".join([*lines, *("| " + " | ".join(map(str, row)) + " |" for row in RELIEF)])


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
