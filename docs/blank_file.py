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

HEAD = """# The blank file

The tables are written by `python -m docs.blank_file` from the data model
(`gearlube_core/hypoid_design/blank_file.py`), the text with them; not edited by hand.

The few numbers from which a hypoid or bevel pair is designed: teeth, offset, size, spiral angle and
cutter. From them follow pitch cones, faces, heights and thicknesses by ISO 23509. One blank ships,
`hypoid_13_42` (`gearlube_core/hypoid_design/data/hypoid_13_42.toml`).

Teeth are equally deep from toe to heel, as in [gear files](gear_file.md): pitch, face and root cone
of a member are parallel. Axes stand at 90 degrees.

**Hand**: a pair with a left-handed pinion is the mirror image of the computed one, y -> -y in the
[frame of the pair](conventions.md#frame-of-the-hypoid-pair). All numbers stay: pitch cones,
contact, transmission error, stiffness, axial forces. The drive flanks are the pinion's concave
ones for both hands; the sense of rotation is the other one. With `pinion_hand = "left"` exported
flanks and bodies, nominal measured points and REXS files are those of the left-handed pair. On the
machine its settings lie on the other side: vertical setting, blank offset, cradle angle and swivel
angle change their signs.

## The four methods

| Method | For | Needs | Cones |
|---|---|---|---|
| 0 | bevel gears, no offset | outer diameter, spiral of the gear | that meet in one apex |
| 1 | hypoid gears | outer diameter, spiral of the pinion | whose limit curvature the tooth has |
| 2 | hypoid gears | mean diameter, spiral of the gear | apexes and cutter centre on a line |
| 3 | hypoid gears | outer diameter, spiral of the gear | that meet the cutter condition |

Diameters are those of the gear. The other spiral angle follows: a pair of touching cones leaves one
free. Method 1 puts the calculation point where its first guess of the pitch angle says, which is
not the middle of the face; the other methods take the middle.
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

Every number carries its origin: `given` in the file, `assumed` because the file is silent, or
`inferred`, which follows from the others.

- **Heights**: working depth k_d m_mn, gear addendum c_ham of it, clearance k_c of it. Without
  `gear_addendum_factor` the gear gets 0.21 + 0.29 (z_1/z_2)^2. The shipped pair has 0.25, and this
  gives 0.248.
- **Face of the pinion**: so wide that it covers the gear's. Method 1 extends both ends by the turn
  of the root plane, method 2 multiplies by 1 + tan^2 of the offset angle, method 3 adds 3 m_mn tan
  of it and rounds up to whole millimetres.
- **Thickness**: teeth and slots are equally wide at the middle of the working depth, because a gear
  file has one point radius for the blades of both flanks. There is no backlash in it.
- **Blade angles**: the effective pressure angle plus the limit pressure angle on the gear's drive
  flank, less it on the coast flank. Both flanks then roll alike.

## Machine settings

```
gearlube design my_blank.toml --out my_design     # some ten seconds
gearlube contact my_design/my_blank.toml --out my_design/contact   # under load; the file as it is
gearlube map my_design/axle.toml                  # losses; also sweep, cycle, build-fmu --axle
gearlube design --example > my_blank.toml         # a blank file to start from
```

From "13 to 42 teeth, 15 mm offset" to loss map and FMU in five commands, about seven minutes on a
small machine, five of them for the FMUs of five platforms:

```
gearlube design --example > my_blank.toml
gearlube design my_blank.toml --out my_pair
gearlube contact my_pair/hypoid_13_42.toml --out my_pair/contact --quick
gearlube map my_pair/axle.toml --out my_map
gearlube build-fmu --axle my_pair/axle.toml --out my_fmus
```

`gearlube design` writes the gear file (named after `name`), `axle.toml`, an [axle
file](axle_file.md) to complete, `report.html`, `design.nc` and `figures/`: contact patterns with
ease-off, transmission error, widths of the teeth. The report says of the contact what was asked
and found, of the teeth topland, slot, undercut and how wide blade points may be, and of every
number whether it was given, chosen or follows. What was not met stands there with how near it
came and what to relax. If both flanks do not even touch, nothing is written.

In Python:

```python
from gearlube_core.hypoid_design.design import design_pair

design = design_pair(designed.file)
design.file  # a gear file, as `gearlube contact` takes it
design.measured["drive"]  # what the contact analysis finds of what was asked
```

1. **Gear**: form-cut (Formate), or generated by a rolling cradle (`gear = "generated"`). Its cutter
   stands where the blade passes the calculation point at the spiral angle of the blank, the
   reference plane at the middle of the working depth.
2. **Start of the pinion**: beside a form-cut gear, what the gear itself would cut, the cradle
   turning as the gear does in the mesh. Such flanks are conjugate: without crowning and without
   transmission error. Beside a generated gear, a pinion that a crown gear generates: conjugate
   without offset, 0.1 mm off with 15 mm.
3. **Wanted gap**: a parabola along every line of contact, 6.35 um at the ends of the ellipse, and
   along the path a parabolic transmission error. Error, ellipse and path direction are the three
   numbers of the second-order gap at the mean contact.
4. **Fit**: eleven settings of the pinion's machine and cutter, and what `[machine]` allows besides:
   the edge radius of its blades, one for each flank, modified roll, helical motion; by least
   squares over both flanks, the coast flank as a whole with 0.3 of the
   weight; mean contact and path count ten times, on both sides. The
   cutter's reference plane stays in the middle of the working depth, the backlash at zero.
5. **Judgement**: the unloaded contact analysis of the finished gear file. What it finds too much or
   too little is taken off the targets, and the fit goes on, up to six rounds. If a side still fails
   whose path is left open, a path nearer to across the lines of contact is tried.

Both flanks of the pinion are cut in one set-up (completing). Not here: a set-up of its own for each
flank, and tapered teeth.

**What was found on the samples** (`tests/analytical/test_designed_pair.py`): hypoid 13/42 with
offset 15, the bevel pair 14/39 and the face-hobbed 13/42 meet 50 and 80 urad within 1 %, path
directions within 1 deg and the mean contact within 0.2 mm. So do 13/42 and 14/39 with a generated
gear, 13/42 also face-hobbed. This takes a freedom besides the eleven settings:

| Blades | Modified roll | Helical motion | 13/42 face-milled, form-cut gear |
|---|---|---|---|
| curved, a radius for each flank | no | no | as asked |
| straight | no | no | no extreme of the error on the coast flanks |
| straight | yes | no | error of the drive flanks 92 instead of 50 urad |
| straight | yes | yes | as asked; so it is with a generated gear |

**The pair of the papers from its blank alone** (`tests/literature/test_designed_shipped_pair.py`):
165 mm, 46 deg, offset 24, cutter 64 mm with 11 blade groups, and on each side the place, error,
ellipse and path that the paper's settings have. Ease-offs then differ by 4.5 um (drive) and 3.4 um
(coast, rms) of 135 and 121 um, by 1.4 and 1.0 um where the flanks are closer than 30 um. What
differs are the corners: the design's second order is that of the paper, its third is not. The
settings themselves differ, tilt by 2 deg: many settings give nearly one flank.

**48 designs** of five ratios, offsets of 10 to 45 mm, milled and hobbed, form-cut and generated:
[designs.md](designs.md). What fails are offsets of nearly half the gear's radius.

**Relief**: designed flanks get tip relief on both members and end relief on the pinion, because
without it edges carry from small torques on: 13/42 then has 4.4 GPa at 150 N.m and more than three
pairs of teeth in contact, with it 1.3 GPa. The targets are those of the flanks as cut, without it.
It is enough up to some torque. A face-milled 11/43 of 200 mm has 1.22 GPa at 150 N.m, within 0.3 %
the same with 48 x 72 and 96 x 144 cells. At 300 N.m the gear's tip digs into the pinion's root:
1.56 GPa, then 2.10. With `tip_relief_um = 40` it is 1.68 GPa with both. So choose the relief for
the torque that counts: `gearlube contact` names the edges that carry, and from which torque on.

Limits for a remark in the report: transmission error 10 % on drive and 15 % on coast flanks, path
direction 2 deg, mean contact 0.5 mm, ellipse length 25 %.

## Against printed samples

ISO 23509:2016, annex F, hypoid samples F.3 (method 1), F.4 (2) and F.5 (3), in
`tests/literature/test_designed_blanks.py`. The standard stops its iterations early; here the
conditions are solved to rounding. The difference is the standard's own tolerance: cone distances
of F.4 by 0.18 mm, all else of F.3 and F.5 within 0.02 mm. F.3 is tapered in the standard; its cones
and faces are compared, not its depths.

## Blanks that cannot exist

| Check | Refused | Warning |
|---|---|---|
| Offset, spiral angle, cutter radius: cones that meet the method's condition | none found | |
| Spiral angle that the offset leaves to the gear | 0 or less | |
| Blade angle: pressure angle with the limit pressure angle | outside 5 to 40 deg | |
| Cutter over the gear's face | does not reach; spiral above 65 deg | spiral of the other hand |
| Face width over outer cone distance | above 0.45 | above 0.35 |
| Calculation point | not on the face | |
| Blade groups and teeth | a common factor | |
| Topland at mid-face | none (pointed) | below 0.2 normal modules |
| Undercut at mid-face by the mate's tip | any | |

Topland and undercut are those of the virtual spur gear in the normal section, an estimate to choose
a blank by. `gearlube_core/hypoid_geometry/flank/tooth_form.py` examines the teeth as cut.

ISO 23509 has more that is not here: tapered depth (standard, duplex, tilted root line), shaft
angles other than 90 degrees, thickness factors and backlash, and the pinion's offset angle in
the root plane, for which that in the axial plane stands.
"""


def page() -> str:
    """Return docs/blank_file.md."""
    return HEAD + "\n## Fields\n" + field_tables(BlankFile, SECTIONS) + TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
