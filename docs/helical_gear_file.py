"""Rewrite docs/helical_gear_file.md: python -m docs.helical_gear_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

PAGE = Path(__file__).with_suffix(".md")
SECTIONS = {
    "": "The file",
    "pair": "[pair]",
    "pinion": "[pinion] and [gear]",
    "pinion.flank": "[pinion.flank] and [gear.flank]: modifications",
    "pinion.body": "[pinion.body] and [gear.body]",
    "pinion.bearing_1": "[pinion.bearing_1], [pinion.bearing_2], and of the gear",
    "damping": "[damping]",
    "operation": "[operation]: default torque and speed",
    "meshing_steps": "[meshing_steps]: the source's steps of a contact line",
    "oil": "[oil]: for films, friction and losses",
    "film": "[film]: film and friction of the oil, of `gearlube helical` and the marching model",
    "film_mesh": "[film_mesh]: nodes of films",
}

HEAD = """# The gear file of a helical pair

The tables are written by `python -m docs.helical_gear_file` from the data model
(`gearlube_core/helical_geometry/gear_file.py`), the text with them; not edited by hand.

This file describes an external helical or spur gear pair on parallel axes, in millimetres and
degrees, in one TOML file. Contact lines, gaps, loaded contact, vibration and the FMU are computed
from it. Three files ship: `he_2007`, `jamali_2015_a` and `jamali_2015_b`
(`gearlube_core/helical_geometry/data/`).

- Give one module and one pressure angle, each either in the normal or in the transverse section.
- `profile_shift_coefficient` sets how thick the teeth are. The backlash then follows from the
  centre distance, or is given and taken off both gears alike. Without it for both gears the
  coefficients are guessed from centre distance and tip diameters, which is said.
- Without a root diameter the teeth are 2.25 normal modules deep, or 1.25 below the profile shift.
- Tips that cut into the mate's root, run into its fillet or are pointed are refused. Clearances
  below 0.1 normal modules, tips below 0.2 and undercut are reported.
- Undercut is that of a hob without protuberance with the corner radius `fillet_radius_factor`.
  Contact then ends where the involute begins. The elastic teeth keep their uncut roots.
  The radius matters: 24 teeth of 14.5 degrees have a contact ratio of 1.72 with 0.38, 1.65 with
  0.3 and 1.62 with 0.25. Without undercut it is 1.86.
- Without mass or inertia a member
  is taken as a steel disc with its face width and its root diameter. Such values count as
  completed.
- Frame, hand and the signs of the slopes: [conventions](conventions.md#frame-of-the-helical-pair).
- `inferred` and `completed` list fields by section and name, such as `pair.backlash_mm`, with the
  reason. All other fields count as printed in the source.

## Fields
"""

TAIL = """
## Write your own

Copy a shipped file, change it, and read it in Python. An error names every wrong field with its
value, its range and a remedy.

```python
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

file = HelicalGearFile.from_toml("my_pair.toml")
pair = file.helical_pair()
print(pair.total_contact_ratio, file.provenance("pair.backlash_mm"))
```

Use the file in these commands:

- `gearlube helical my_pair.toml` analyses the pair. `--export` also writes both flanks of a tooth
  of each gear as STEP files (`gears/pinion_flanks.step`, `gears/gear_flanks.step`): bicubic
  B-splines within 0.01 um of the involute helicoids, without modifications, from the start of the
  involute to the tip. Each is about its own axis, z, with mid-face at z = 0.
- `gearlube build-fmu --model helical-pair --gear my_pair.toml` builds an FMU of it.
- `[film]` is on friction and losses in both. `oil_file` names your [oil](oil_file.md), `model` the
  formulas or solved films, and `line_model` a
  [film model of your own oil](film_model.md#a-model-of-your-own-oil). The FMU carries these files.
- `[oil]` is the oil of films, friction, losses and the FMU where `oil_file` names none. It has the
  viscosity at one temperature; at others it follows the slope of mohammadpour_2015, whose heat data
  it takes too. An oil file beside `[oil]` must agree with it within 10 % there, or the file is
  refused. `--oil` of a command replaces both.
- `gearlube ehl helical my_pair.toml` solves the film on its contact lines. `[oil]` or `--oil` names
  the oil. `[film_mesh]` or `--nodes-across`, `--nodes-along` and `--spacing` set the mesh. A
  transient film on 129 x 257 nodes with `spacing = "exit"` is as accurate as on 182 x 857 uniform
  nodes, for a fraction of the computing time (`benchmarks/README.md`).
"""


def page() -> str:
    """Return docs/helical_gear_file.md."""
    return HEAD + field_tables(HelicalGearFile, SECTIONS) + TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
