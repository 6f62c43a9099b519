"""Rewrite docs/gear_file.md and the picture of the pair: python -m docs.gear_file."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation

from docs.field_tables import field_tables
from gearlube_core.arrays import Array
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Placement
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import Solid, gear_solid
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

STEEL, BRASS = np.array([0.62, 0.68, 0.75]), np.array([0.86, 0.62, 0.33])
FOLDER = Path(__file__).parent
SECTIONS = {
    "": "The file",
    "pair": "[pair]",
    "pinion": "[pinion] and [gear]: the blank",
    "pinion.cutter": "[pinion.cutter] and [gear.cutter]",
    "pinion.machine": "[pinion.machine]: generated, with cutter tilt",
    "gear.machine": "[gear.machine]: form-cut (Formate), or generated with a ratio of roll",
    "pinion.drive_flank": "[pinion.drive_flank], [pinion.coast_flank], [gear.drive_flank] and "
    "[gear.coast_flank]: reliefs, crowns and measured surfaces",
}

HEAD = """# The gear file

The tables are written by `python -m docs.gear_file` from the data model
(`gearlube_core/hypoid_geometry/gear_file.py`), the text with them; not edited by hand.

A gear file describes a hypoid pair as a workshop does: blank, cutters and machine settings, in
millimetres and degrees, in one TOML file. The flank surfaces are computed from it, and from them
tooth contact, transmission error, load sharing and the mesh table of the axle.

![Pinion and gear in mesh](images/gear_pair.png)

*The shipped pair, computed from its machine settings: 13 and 36 teeth, offset 24 mm, face-hobbed.
Right: the teeth in mesh, seen from the toe.*

The tooth depth is uniform and the axes are at right angles. The gear is form-cut or generated. The
pinion is generated with cutter tilt. The pair is face-hobbed, or face-milled if the number of blade
groups is 0. [Conventions](conventions.md#frame-of-the-hypoid-pair) defines the frame, the hands and
the driving side.

## Signs

Drawings use different sign conventions. This section says which ones this package uses. With these
signs the printed settings of the shipped pair bring the pinion's cutter within 0.002 mm of the
gear's tooth. Every other choice of signs misses it by 0.23 mm or more
(`tests/literature/test_flank_surface_karagiannis_2012.py`).

- **Reference plane**: the plane at the middle of the working depth. `point_radius_mm` is the radius
  in this plane, not at the blade tips. It holds for the blades of both flanks.
- **Blade angles are named after the flank they cut**, convex or concave, because tables use
  "inside" and "outside" in different ways. If the two angles are exchanged, the pressure angles of
  the mating flanks of the shipped pair differ by 11.6 deg.
- **Apexes** are positive beyond the crossing point of the axes. The gear's
  `machine_center_to_back_mm` is measured in the same way, for the reference plane.
- **Modified roll and helical motion** start from the basic cradle position, where the mean point is
  cut. If the machine root angle of the pinion is above 10 deg, the cradle represents a crown gear.
  Then the mean point is cut where the pinion's cone touches the plane normal to the cradle axis.
- **Generated gear**: cut without tilt. Its cradle axis meets the gear axis in the machine centre.
- **Cradle axis of the pinion**: the gear axis of the assembled pair, if nothing is crowned. The
  cutter axis leans from it by the tilt angle i, towards the azimuth q - j - 90 deg (q basic cradle
  angle, j basic swivel angle). The distance from the plane of the cutter centre to the pinion axis
  is the sliding base. The pinion axis is on the side of the blade tips.
- **`blade_edge_radius_mm`**: radius of a hollow blade edge, which crowns the tooth along its
  profile. Without this field the edge is straight. The blades of each flank may have their own
  radius, `convex_flank_edge_radius_mm` and `concave_flank_edge_radius_mm`.
- **Reliefs** remove material from the flank as cut, along its normal. The amount at the distance d
  from the edge is the amount at the edge times (1 - d/extent)^2, and zero beyond the extent.
  Distances from tip and root are tooth heights. Distances from toe and heel are measured along the
  pitch cone.
- **Edge radius**: a radius r is a relief of r/2 over the length r. Where it begins its curvature is
  1/r.
- **Crowns** are parabolas over the whole flank, zero in its middle. Reliefs and crowns of a flank
  add up.
- Root fillets are not described. Below the flanks the tooth ends on the root cone.

## Where a number is from

`inferred` and `completed` list fields by section and name, such as `pinion.pitch_angle_deg`.
`inferred` lists the values that the source does not print but implies. `completed` lists the values
that were chosen because the source does not give them. All other fields count as printed.
"""

TAIL = """
## Write your own

1. Copy `gearlube_core/hypoid_geometry/data/mohammadpour_2015.toml` (face-hobbed) or
   `examples/gears/face_milled.toml` and enter the numbers of your summary sheet.
2. Read the file in Python. An error names every wrong field with its value and its range:

   ```python
   from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

   file = HypoidGearFile.from_toml("my_gear.toml")
   ```

3. Check whether the flanks can mesh. `gearlube contact` makes the same check first:

   ```python
   from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings

   check_pair(file)
   print(*pair_warnings(file), sep="\\n")
   ```

   `check_pair` refuses a pair whose flanks cannot mesh. It takes one to five seconds. It says which
   check failed and which setting is most likely wrong:

   > The flanks cannot mesh. The distance of the pinion cutter's reference plane from the middle of
   > the working depth must be within 0.1 mm, got -36.9 mm. Most likely wrong: the flanks meet with
   > pinion.machine.sliding_base_mm from -20.647 to 20.647 mm (the sign).

   `pair_warnings` lists faults that only shift the contact.
4. Check the tooth form for thin toplands, pointed teeth and undercut:

   ```python
   from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form

   print(*tooth_form(file, "pinion").report(), sep="\\n")
   ```

5. Export the gears: `gearlube contact my_gear.toml --export` writes the flanks as points (CSV) and
   as exact surfaces (STEP), and teeth and gears as triangles (STL, GLB; install
   `gearlube[export]` for them). In Python use
   `write_flank_csv` and `write_solid` in `gearlube_core/hypoid_geometry/flank/tooth_solid.py`, and
   `write_step` in `step_file.py`. The exported flanks are the flanks as cut, without reliefs and
   crowns. A STEP file contains both flanks of one tooth as bicubic B-splines, within 0.01 um of the
   flank. They start at the height from which the flank has no undercut over the whole face width,
   and end at the tip. The STEP file contains no bodies: root and blank are part of the CAD model. A
   library that could build them (Open CASCADE) needs 380 MB.

## Relieve the edges

In the shipped pair, sharp tooth edges come into contact from about 50 N.m on. The pressure at a
sharp edge has no finite value ([tooth contact](tooth_contact.md#edges-and-relief)). Add a relief,
for example

```toml
[pinion.drive_flank]
tip_relief_um = 20.0
tip_relief_depth_mm = 1.9     # a quarter of the tooth's height
toe_relief_um = 30.0
toe_relief_length_mm = 5.0
heel_relief_um = 30.0
heel_relief_length_mm = 5.0
```

and the same for the gear. Contact analysis and mesh table are then computed with the relieved
flanks, and so are transmission error, stiffness, radii of curvature, films and losses. The check
whether the flanks can mesh uses the flanks as cut. `gearlube vary contact my_gear.toml --vary
pinion.drive_flank.tip_relief_um=10:40:5` compares several amounts of relief.

## What is checked

The checks run in this order, the fastest first. Each limit lies between the values of correct and
wrong pairs. Correct pairs stay well below the limits.

| Check | Refused above | Warning above |
|---|---|---|
| Tooth pitch at the mean point, pinion against gear | 1.5 % | |
| Working depth less two normal modules | 1 module | 0.3 modules |
| Mean point from the pinion's pitch cone; from its mid-face | 0.05 mm; 2 % | |
| Angle between the pitch cones at the mean point | 0.2 deg | |
| Difference of the spiral angles less the offset angle | 0.5 deg | |
| Ratio of roll against the teeth (machine root angle up to 2 deg) | 5 % | |
| Blade groups: the same in both cutters, no common factor with the teeth | | |
| Profile crowning by a blade edge radius | | 0.04 mm |
| Cutter's reference plane from the middle of the working depth | 1 mm | 0.1 mm |
| Spiral angle as cut: gear; pinion | 2 deg; 5 deg | |
| Slopes between the flanks at the mean point, drive and coast | 10 mrad | |
| Contact of both flanks without load, on both teeth | none | |
| Extreme of the unloaded transmission error on the teeth | | none |
| Unloaded transmission error of the pinion, peak to peak | | 1000 urad |

If a file fails, the program tries these changes of one setting: the other sign, ten times or a
tenth of the value, inches, radians, a few teeth or blade groups more or fewer, two settings
exchanged. If none of them helps, it searches the value at which the misfit is zero. It suggests a
change if all checks then pass and both flanks touch. The message names the change that fits best
and up to two others.

A difference between the pressure angles of the two blades is not an error: summary sheets often
omit hook angles and the curvature of the blade edge, and tilt changes the angles of correct pairs
by up to a degree. The program checks the slopes between the flanks instead. If the transmission
error has no extreme on the teeth, change the two angle corrections of the pinion.
"""


def page() -> str:
    """Return docs/gear_file.md."""
    return HEAD + "\n## Fields\n" + field_tables(HypoidGearFile, SECTIONS) + TAIL


def picture(name: str = "mohammadpour_2015") -> Figure:
    """Return a picture of a shipped pair: the whole, and the teeth in mesh seen from the toe."""
    file = HypoidGearFile.named(name)
    pair = FlankPair.from_file(file, "drive")
    members = [
        (gear_solid(Tooth.from_file(file, "gear"), 12, 24, rim=9e-3), pair.gear_placed(0.0), STEEL),
        (
            gear_solid(Tooth.from_file(file, "pinion"), 16, 40, rim=9e-3),
            pair.pinion_placed(0.0),
            BRASS,
        ),
    ]
    figure = Figure(figsize=(11.0, 5.0), dpi=120)
    whole = _view(figure.add_axes((0.0, 0.0, 0.56, 1.0)), members, np.array([0.1, 0.85, -0.5]))
    near = _view(figure.add_axes((0.58, 0.02, 0.41, 0.96)), members, np.array([-0.75, -0.2, -0.42]))
    for axes, (low, high) in ((whole.axes, whole.frame), (near.axes, near.around(pair.mean_point))):
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.set_aspect("equal")
        axes.axis("off")
    return figure


class View(NamedTuple):
    """A drawn view: its axes, the directions of its sheet, its corners low and high [m]."""

    axes: Axes
    sheet: Array  # (3, 2)
    frame: tuple[Array, Array]

    def around(self, point: Array) -> tuple[Array, Array]:
        """Return the corners of a window around a point of the pair."""
        middle = point @ self.sheet
        return middle - 25e-3, middle + 25e-3


def _view(axes: Axes, members: list[tuple[Solid, Placement, Array]], eye: Array) -> View:
    """Draw the members as seen from the direction `eye`, the gear's teeth up."""
    eye = eye / np.linalg.norm(eye)
    parts = [_lit(solid, placement, eye, base) for solid, placement, base in members]
    corners = np.concatenate([one[0] for one in parts])
    shade = np.concatenate([one[1] for one in parts])
    order = np.argsort((corners @ eye).mean(axis=1))
    up = np.array([0.0, 0.0, -1.0]) + eye[2] * eye
    up /= np.linalg.norm(up)
    sheet = np.stack([np.cross(up, eye), up], axis=1)
    flat, shade = corners[order] @ sheet, shade[order]
    # each triangle is edged in its own colour, else the background shines through the joints
    axes.add_collection(PolyCollection(flat, facecolors=shade, edgecolors=shade, linewidths=0.25))
    ends = flat.reshape(-1, 2)
    return View(axes, sheet, (ends.min(axis=0) - 2e-3, ends.max(axis=0) + 2e-3))


def _lit(solid: Solid, placement: Placement, eye: Array, base: Array) -> tuple[Array, Array]:
    """Return the triangles that face the eye, (f, 3, 3), and their colours, (f, 3)."""
    angle = np.arctan2(placement.sine, placement.cosine)
    turn = Rotation.from_rotvec(angle * np.array(placement.axis))
    point = np.array(placement.point)
    corners = (turn.apply(solid.vertices - point) + point)[solid.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    seen = normal @ eye > 0.0
    corners, normal = corners[seen], normal[seen]
    lamp = eye + np.array([-0.5, 0.5, -0.6])
    lamp /= np.linalg.norm(lamp)
    half = (lamp + eye) / np.linalg.norm(lamp + eye)
    diffuse = np.clip(normal @ lamp, 0.0, 1.0)[:, None]
    gloss = np.clip(normal @ half, 0.0, 1.0)[:, None] ** 30
    return corners, np.clip(base * (0.25 + 0.75 * diffuse) + 0.35 * gloss, 0.0, 1.0)


if __name__ == "__main__":
    (FOLDER / "gear_file.md").write_text(page(), encoding="utf-8")
    (FOLDER / "images").mkdir(exist_ok=True)
    picture().savefig(FOLDER / "images" / "gear_pair.png")
