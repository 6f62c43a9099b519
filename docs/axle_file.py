"""Rewrite docs/axle_file.md: python -m docs.axle_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.field_units import attribute_of
from drivetrain.axle_file.read_axle import read_axle
from fmu_src.axle_arguments import start_arguments
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.input_file.field_notes import field_notes

PAGE = Path(__file__).with_suffix(".md")
SECTIONS = {
    "": "The file",
    "gear_set": "[gear_set]",
    "pinion": "[pinion] and [gear]",
    "pinion.bearing": "[pinion.bearing] and [gear.bearing]: two opposed bearings on the shaft",
    "steel": "[steel]: flanks, rollers and races",
    "oil": "[oil]: a shipped oil, or what differs from it",
    "housing": "[housing]: the gear in its oil",
    "seals": "[seals]: of the shafts",
    "model": "[model]: how the axle is computed",
    "vehicle": "[vehicle]",
    "tyre": "[tyre]",
    "gearbox": "[gearbox]",
    "engine": "[engine]",
    "driveline": "[driveline]",
}

HEAD = """# The axle file

The tables are written by `python -m docs.axle_file` from the data model
(`drivetrain/axle_file/axle_file.py`), the text with them; not edited by hand.

Your hypoid axle and the car around it in one TOML file: gear set, masses, bearings, oil, vehicle,
tyre, gearbox, engine and driveline. From it come the speed sweep, the FMU and the Python model. The
axle of Mohammadpour et al. 2015 ships as `mohammadpour_2015`; with it all is as without a file.

```
gearlube sweep --example > my_axle.toml       # every field, at the paper's values
gearlube axle show my_axle.toml               # checks the file; each input and where it is from
gearlube sweep my_axle.toml --speeds 40 60
gearlube build-fmu --axle my_axle.toml --out DIR
```

`examples/my_axle.toml` is a made-up van, with bearings of its own on either shaft.

```python
import gearlube as gl

paper = gl.read_axle("mohammadpour_2015")
axle, car = paper.axle, paper.driveline  # HypoidAxleParameters, DrivelineParameters
for note in paper.assumed:
    print(note.field, note.value_text, note.unit, note.origin, note.why)
```

- Only the gears are required: `gear_set.gear_file` names [your gear file](gear_file.md), as
  `gearlube design` writes it or you fill it in from the machine settings; or `gear_set.mesh_table`
  names a shipped table or one that `gearlube contact` wrote. The numbers of teeth, and so the final
  drive, are theirs.
- With `gear_file = "my_gears.toml"` the first command or call that reads the axle file analyses the
  loaded contact, 2 to 4 minutes on two processors, with a bar. Its mesh table is kept
  beside the gear file as `my_gears.mesh.nc`, or in the user's cache folder where nothing can be
  written there. It carries hashes of the gear file's content, the torques and the code of the
  analysis: when one of them has changed it is computed anew, and the command says why. Comments and
  `[tolerances]` of the gear file do not count. Stopped by Ctrl-C, the same command goes on from the
  finished positions. `gearlube contact my_gears.toml` at its usual settings, or with `--torques`,
  keeps the same table and draws the figures as well.
- The analysis has the torques of `gearlube contact`, 5 to 400 N.m on the pinion; a truck needs its
  own `contact_torques_n_m`. Misaligned pairs, other positions: `gearlube contact`, and its table as
  `mesh_table`.
- What the file gives is **given**. What it leaves out is **inferred** where it follows from given
  fields, else **assumed**: the default in the tables below. `gearlube axle show` and the report of
  a sweep list what is inferred and assumed, with values, units and reasons.
- Without `[gear.bearing]` the bearings of the gear's shaft are as the pinion's. With it, what it
  leaves out is at the defaults, not as the pinion's; only the preload is then the pinion's.
- A bearing is given by bore, outside diameter, pitch diameter, number, mean diameter and effective
  length of the rollers, and contact angle. Races follow from the pitch diameter: it less and plus
  roller diameter times cosine of the contact angle. The stiffness follows from the roller length,
  d = 3.84e-5 Q^0.9/l^0.8 [mm, N] for each of the two contacts (Palmgren; Harris and Kotzalas 2007).
  Without a roller length it is the paper's, which is 2.5 times softer for the paper's rollers.
- `frusta_lengths_mm` and the lists beside it describe a member as cone frusta of the steel on its
  axis, from the drawing: blank, shaft, and for the gear the ring, bolted flange and differential
  case. Mass and inertia that the file does not give are theirs. A tooth zone is a frustum halfway
  between root and tip.
- `drag_area_m2` stands for drag coefficient times frontal area, `rolling_radius_mm` for the tyre's
  size, `interference_um` for the preload, the two race diameters for the pitch diameter, and
  `walther_a` with `walther_b` for the two viscosities: give one of each. The engine's orders have
  their three lists together.
- `kind = "electric_motor"` in `[engine]` puts a smooth motor with one gear in the place of the
  engine, with defaults of its own: rotor, shaft, speeds from standstill. `orders` are then those of
  its torque ripple, in periods per revolution of the rotor, at most 24.
- `asperity_table` takes what `gearlube roughness flow-factors` computed of
  [rough patches](rough_contact.md) in the place of the usual constants of Greenwood and Tripp's
  law. The kernels keep the law: its two products are fitted to load and area of the table between
  h/sigma 0.5 and 3. `gearlube axle show` tells the fit and by what factor it misses the table, up
  to 2.6 for Gaussian surfaces. Left out, `roughness_rms_um` is that of the table; given, it scales
  the film ratio alone.
- An `asperity_table` of surfaces pressed dry puts far more load on asperities than the usual
  constants: oil that flattens roughness before it touches is not in it. See
  [loss_map.md](loss_map.md#mixed-friction-of-the-flanks).
- Rolling of the flanks is not modelled until `flank_rolling` of `[model]` names its law.
- `bearing_torque_loss` of `[model]` other than palmgren takes the forces of each bearing or the
  load of each roller, anew at least once in 12 integrator steps. With the sums over rollers a
  communication step of 0.1 ms takes 2 to 4 times as long.
- `oil.file` names an [oil file](oil_file.md), your oil by its data sheet, in place of all other
  fields of `[oil]`.
- Churning and seals are not modelled until the file has a field of `[housing]` and of `[seals]`.
  Immersion matters most; oil that is thrown off lowers it, and the laws differ by a
  factor of three. A seal's torque is free of speed, `wheel_torque_n_m` that of both wheels' seals.
- `[tolerances]` says how fields scatter from part to part, each by its dotted name:
  `gear_set.backlash_um = { plus_minus = 30.0 }`, or `plus_minus_percent`, or
  `standard_deviation`. Without `distribution = "uniform"` it is normal with three standard
  deviations to the tolerance; parts beyond are sorted out.
  [`gearlube vary --scatter`](vary.md#scatter-from-part-to-part) samples them.
- All wrong fields of a file are named at once, each with the value, its limits and unit, and, if
  another unit would bring the number within them, that unit. Nothing is compiled before.

## Fields
"""

_TAIL = """
## The sweep

`gearlube sweep my_axle.toml` takes its options from the file: oil, roughness, equations, friction
and drag torque; an option on the command line goes before the file. Without `--preload` it runs the
preload that the file gives, else 2500 and 6000 N. `--preload` sets the bearings of the pinion's
shaft; those of the gear's follow unless the file gives them a preload of their own. The oil
temperature is that of `--oil-temperature`, 95 degC; with `--steady-temperature` each point has its
own, see [drive_cycle.md](drive_cycle.md). If the road asks for more than 1.5 times the
torque of the mesh table, the sweep refuses before it builds anything; beyond the table it warns.

## The FMU

`gearlube build-fmu --axle my_axle.toml` builds native [FMUs](fmu.md), with `--python` one that
computes in this package. The FMU carries the file as `resources/axle.toml`, a mesh table of its own
or that of its gear file as `resources/mesh_table.nc`, an asperity table as
`resources/asperity_table.nc` and an oil file as `resources/oil.toml`; the paths in
the file have no meaning there, and the gear file itself is not in it. Its GUID depends on every
byte of all of them. Start values of its parameters are the file's. An oil of the file's own is the
literal `custom` of `oil.name`. `--mesh-table` does not go with `--axle`: the file names its gears.
A sweep keeps one such FMU in the cache for each content of file and tables. The FMU has no car:
vehicle, tyre, gearbox, engine and driveline of the file are those of the sweep.

These inputs are parameters of the FMU and can be set at run time; all others are built in:

| Parameter | Input |
|---|---|
{parameters}
## Limits

- Two opposed and equal bearings on each shaft; no distances between them: the model has no tilt
  of the shafts. For two unlike bearings give sizes halfway between them: with bearings of 45 and
  40 mm bore (pitch 74 and 66 mm) the loss of an axle is then within 1 % of the mean of the axles
  with either, by palmgren, skf_2013 and zhou_hoeprich_1991. A radial load that an overhung pinion
  shares 6 to 2 kN between its bearings and not 4 to 4 changes the drag of both together by 0.6 % at
  most by zhou_hoeprich_1991, less by the others; the axial forces that come with tilt are not in
  that. Dynamics of the bearings at either end are another matter.
- Masses and inertias are given, those of the member's frusta, or the paper's. Nothing takes them
  from the teeth: a frustum between root and tip stands for them.
- The stiffness of the rollers is that of steel, whatever `[steel]` says.
- The contact angle is that of the outer race for both races; for the rib the inner race has the
  angle with which rollers and races share one apex.
"""
_FIELDS = {
    "bearing_preload": "`pinion.bearing.preload_n`",
    "gear_bearing_preload": "`gear.bearing.preload_n`",
    "oil": "`oil`",
    "pinion_seal_torque": "`seals.pinion_torque_n_m`",
    "wheel_seal_torque": "`seals.wheel_torque_n_m`",
    "rolling": "`model.flank_rolling`",
    "bearing_approach": "`model.bearing_approach`",
}


def _field_of(argument: str, fields: dict[str, str]) -> str:
    """Return the field of the file that sets an argument of the FMU's model."""
    role, _, rest = argument.partition("_")
    if argument in _FIELDS:
        return _FIELDS[argument]
    of_bearing = f"{role}.bearing.{rest}"
    of_member = f"{role}.{rest}"
    name = next(n for n in (argument, of_bearing, of_member) if n in fields)
    return f"`{fields[name]}`"


def _run_time_parameters() -> str:
    fields: dict[str, str] = {}
    for name in field_notes(AxleFile):
        section, _, key = name.rpartition(".")
        prefix = "" if section in ("gear_set", "housing", "model") else f"{section}."
        fields[prefix + attribute_of(key)] = name
    starts = start_arguments(read_axle("mohammadpour_2015").axle)
    rows = [
        f"| `{v.name}` | {_field_of(v.argument, fields)} |\n"
        for v in HYPOID_AXLE
        if v.argument in starts
    ]
    return "".join(rows)


def page() -> str:
    """Return docs/axle_file.md."""
    bare = AxleFile.from_data({"gear_set": {"mesh_table": "mohammadpour_2015"}}, "the page")
    assumed = bare.car_axle().assumed
    defaults = {note.field: note.value_text for note in assumed if note.origin == "assumed"}
    for key in ("mass_kg", "inertia_kg_m2"):
        defaults[f"pinion.{key}"] += f", gear {defaults[f'gear.{key}']}"
    tables = field_tables(AxleFile, SECTIONS, defaults)
    return HEAD + tables + _TAIL.format(parameters=_run_time_parameters())


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
