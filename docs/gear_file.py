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

A hypoid pair as a workshop describes it: blank, cutters and machine settings, in millimetres and
degrees, in one TOML file. From it come the flank surfaces, and from them tooth contact,
transmission error, load sharing and the mesh table of the axle.

![Pinion and gear in mesh](images/gear_pair.png)

*The shipped pair as its machine settings cut it, 13 to 36 teeth, offset 24 mm, face-hobbed. Right:
the teeth in mesh, seen from the toe.*

Uniform depth, axes at right angles; gear form-cut or generated, pinion generated with cutter tilt;
face-hobbed or, with no blade groups, face-milled. Frame, hands and the driving side:
[conventions](conventions.md#frame-of-the-hypoid-pair).

## Signs

What drawings differ about, as this package reads it. With these signs the printed settings of the
shipped pair bring the pinion's cutter to within 0.002 mm of the gear's tooth; every other choice
of signs misses by 0.23 mm or more (`tests/literature/test_flank_surface_karagiannis_2012.py`).

- **Reference plane**: the plane at the middle of the working depth. `point_radius_mm` holds there,
  not at the blade tips, and for the blades of both flanks.
- **Blade angles are named after the flank they cut**, convex or concave, because tables disagree
  about "inside" and "outside". Taken the other way round, mating flanks of the shipped pair differ
  by 11.6 deg of pressure angle.
- **Apexes** count positive beyond the crossing point of the axes. The gear's
  `machine_center_to_back_mm` is the same kind of length, for the reference plane.
- **Modified roll and helical motion**: counted from the basic cradle position, where the mean point
  is cut. A machine root angle of the pinion above 10 deg makes its cradle a crown gear: the mean
  point is then cut where the pinion's cone touches the plane across the cradle axis.
- **Generated gear**: without tilt. Its cradle axis meets the gear axis in the machine centre.
- **Cradle axis**: the gear axis of the assembled pair, if nothing is crowned. The cutter axis
  leans by the tilt angle i from it, to the azimuth q - j - 90 deg (q basic cradle, j basic swivel
  angle). The pinion axis lies a sliding base from the cutter centre's plane, on the side of the
  blade tips.
- **`blade_edge_radius_mm`**: a hollow blade, which crowns the tooth along its profile; without it
  the edge is straight. The blades of either flank may have their own radius,
  `convex_flank_edge_radius_mm` and `concave_flank_edge_radius_mm`.
- **Reliefs** take material off the flank that the cutter left, along its normal: the amount at the
  edge times (1 - d/extent)^2 at the distance d from it, nothing beyond the extent. Distances from
  tip and root are tooth heights, those from toe and heel lie along the pitch cone. An edge radius r
  is a relief of r/2 over r: where it begins it has the curvature 1/r. Crowns are parabolas over the
  whole flank, zero in its middle; reliefs and crowns of a flank add up.
- Root fillets are not described: below the flanks the tooth ends on the root cone.

## Where a number is from

`inferred` and `completed` list fields by their dotted names: what the source implies, and what was
chosen because the source is silent. All other fields count as printed.
"""

TAIL = """
## Write your own

1. Copy `gearlube_core/hypoid_geometry/data/mohammadpour_2015.toml` (face-hobbed) or
   `examples/gears/face_milled.toml` and put your summary sheet's numbers in.
2. Read it. Every wrong field is named, with its value and its range:

   ```python
   from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

   file = HypoidGearFile.from_toml("my_gear.toml")
   ```

3. Ask whether the flanks meet. `gearlube contact` asks first, too:

   ```python
   from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings

   check_pair(file)
   print(*pair_warnings(file), sep="\\n")
   ```

   `check_pair` refuses a pair whose flanks do not meet, in one to five seconds. It says which check
   failed and which setting is most likely wrong:

   > The flanks cannot mesh. The distance of the pinion cutter's reference plane from the middle of
   > the working depth must be within 0.1 mm, got -36.9 mm. Most likely wrong: the flanks meet with
   > pinion.machine.sliding_base_mm from -20.647 to 20.647 mm (the sign).

   `pair_warnings` says what only shifts the contact.
4. Look at the tooth: thin toplands, pointed teeth, undercut.

   ```python
   from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form

   print(*tooth_form(file, "pinion").report(), sep="\\n")
   ```

5. Take it elsewhere: `gearlube contact my_gear.toml --export` writes the flanks as points (CSV) and
   as exact surfaces (STEP), teeth and gears as triangles (STL, GLB). In Python: `write_flank_csv`
   and `write_solid` in `gearlube_core/hypoid_geometry/flank/export.py`, `write_step` in
   `step_file.py`. These are the flanks as cut: reliefs and crowns are left out. A STEP file has
   both flanks of one tooth as bicubic B-splines, within 0.01 um of the flank, from where the flank
   is sound over the whole face up to the tip. Bodies are not in it: roots and blanks belong to the
   CAD model, and a library that could build them (Open CASCADE) takes 380 MB.

## Relieve the edges

Sharp teeth press into each other from some 50 N.m of the shipped pair on, and that pressure has no
finite value ([tooth contact](tooth_contact.md#edges-and-relief)). Add for instance

```toml
[pinion.drive_flank]
tip_relief_um = 20.0
tip_relief_depth_mm = 1.9     # a quarter of the tooth's height
toe_relief_um = 30.0
toe_relief_length_mm = 5.0
heel_relief_um = 30.0
heel_relief_length_mm = 5.0
```

and the same for the gear. Contact analysis, mesh table and what is made of it (transmission error,
stiffness, radii of curvature, films, losses) are those of the relieved flanks. Whether the flanks
meet at all is checked on the flanks as cut. `gearlube vary contact my_gear.toml --vary
pinion.drive_flank.tip_relief_um=10:40:5` compares amounts.

## What is checked

The checks run in this order, the cheapest first. Each limit lies between what sound and wrong pairs
show. Sound pairs stay well below them.

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

For a file that fails, these changes of one setting are tried: the other sign, ten times or a tenth,
inches, radians, some teeth or blade groups more or less, two settings exchanged. If none helps, the
value is looked for at which the misfit vanishes. A change is offered if all checks then pass and
both flanks touch. The sentence names the change that fits best and up to two others.

A difference of the pressure angles of both blades is no fault: summary sheets often omit hook
angles and blade edge curvature, and tilt changes the angles of sound pairs by up to a degree. The
slopes between the flanks are checked instead. If the transmission error has no extreme on the
teeth, change the two angle corrections of the pinion.
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
