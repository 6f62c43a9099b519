"""Rewrite docs/axle_file.md: python -m docs.axle_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.read_axle import read_axle
from drivetrain.axle_file.section import attribute_of
from fmu_src.axle_arguments import start_arguments
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.friction.flank_friction import friction_laws
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
    "film": "[film]: film and friction of the oil on the flanks",
    "vehicle": "[vehicle]",
    "tyre": "[tyre]",
    "gearbox": "[gearbox]",
    "engine": "[engine]",
    "driveline": "[driveline]",
}

HEAD = """# The axle file

The tables are written by `python -m docs.axle_file` from the data model
(`drivetrain/axle_file/axle_file.py`), the text with them; not edited by hand.

An axle file describes your hypoid axle and the car around it in one TOML file: gear set, masses,
bearings, oil, vehicle, tyre, gearbox, engine and driveline. The speed sweep, the FMU and the Python
model all read this file. The axle of Mohammadpour et al. 2015 ships as `mohammadpour_2015`. This
shipped file gives the same results as a run without an axle file.

```
gearlube sweep --example > my_axle.toml       # every field, at the paper's values
gearlube axle show my_axle.toml               # checks the file; each input and where it is from
gearlube sweep my_axle.toml --speeds 40 60
gearlube build-fmu --axle my_axle.toml --out DIR
```

`examples/my_axle.toml` describes an invented van. Its two shafts have different bearings.

```python
import gearlube as gl

paper = gl.read_axle("mohammadpour_2015")
axle, car = paper.axle, paper.driveline  # HypoidAxleParameters, DrivelineParameters
for note in paper.assumed:
    print(note.field, note.value_text, note.unit, note.origin, note.why)
```

## Gears

- Only the gears are required. There are two ways to give them. `gear_set.gear_file` names
  [your gear file](gear_file.md): `gearlube design` writes one, or you fill it in from the machine
  settings. `gear_set.mesh_table` names a shipped mesh table, or one that `gearlube contact` wrote.
  The numbers of teeth, and so the final drive ratio, are taken from the gear file or mesh table.
- With `gear_file = "my_gears.toml"` the first command or call that reads the axle file computes the
  loaded tooth contact. This takes 2 to 4 minutes on two processors and shows a progress bar. The
  resulting mesh table is stored beside the gear file as `my_gears.mesh.nc`. If that folder is not
  writable, the table goes to the user's cache folder. If you stop the computation by Ctrl-C, the
  same command later continues from the finished positions.
- The stored mesh table carries hashes of the gear file's content, of the torques and of the
  analysis code. If one of these changes, the table is computed again and the command says why.
  Comments and `[tolerances]` of the gear file have no effect on the hash.
  `gearlube contact my_gears.toml` at its usual settings, or with `--torques`, stores the same table
  and draws the figures as well.
- The analysis uses the torques of `gearlube contact`: 5 to 400 N.m on the pinion. For a truck, set
  `contact_torques_n_m`. For misaligned gears or other mesh positions run `gearlube contact` and
  name its table as `mesh_table`.

## Values that the file leaves out

- A value in the file counts as **given**. A missing value is **inferred** if it follows from given
  fields. Otherwise it is **assumed**: the default in the tables below. `gearlube axle show` and the
  report of a sweep list all inferred and assumed values, with units and reasons.
- Without a section `[gear.bearing]` the gear's shaft has the same bearings as the pinion's shaft.
  With this section, its missing fields take the defaults in the tables below. The one exception is
  the preload: if it is missing, it is the preload of the pinion's bearings.
- Some fields replace others; give only one of each pair. `drag_area_m2` replaces the drag
  coefficient and the frontal area. `rolling_radius_mm` replaces the tyre size. `interference_um`
  replaces the preload. The two race diameters replace the pitch diameter. `walther_a` and
  `walther_b` replace the two viscosities. The engine's orders need all three of their lists.

## Bearings, masses and engine

- A bearing is described by its bore, outside diameter, pitch diameter and contact angle, and by the
  number, mean diameter and effective length of its rollers. The race diameters are the pitch
  diameter minus and plus the roller diameter times the cosine of the contact angle. The stiffness
  follows from the roller length: d = 3.84e-5 Q^0.9/l^0.8 [mm, N] for each of the two contacts of a
  roller (Palmgren; Harris and Kotzalas 2007). Without a roller length the stiffness is that of the
  paper. For the paper's rollers this is 2.5 times softer.
- A catalogue prints bore, outside diameter, load rating C and a factor e, but no rollers. Give the
  first two, `dynamic_load_rating_kn`, and as contact angle the one whose tangent is e/1.5.
  Rollers that are left out are then inferred: 0.57 of the section for their diameter, as many as
  fill 0.8 of the pitch circle, and the length that gives C by ISO 281 (factors from memory). For
  32216 this gives 16 rollers of 17.1 x 23.8 mm; measured ones are 16 of 17 x 22.7 mm. Without C a
  roller is 1.5 times as long as thick.
- `frusta_lengths_mm` and the lists beside it describe the pinion or the gear as a row of steel cone
  frusta on its axis, taken from the drawing: blank and shaft, and for the gear also the ring, the
  bolted flange and the differential case. If the file gives no mass or inertia, these are computed
  from the frusta. Describe the toothed zone by a frustum whose surface is halfway between root and
  tip.
- `kind = "electric_motor"` in `[engine]` replaces the engine by a motor with one gear and smooth
  torque. It has its own defaults for rotor, shaft and speeds; its speeds start at standstill.
  `orders` are then the orders of its torque ripple, in periods per revolution of the rotor, at most
  24.

## Friction and losses

- `asperity_table` names a table that `gearlube roughness flow-factors` computed from
  [rough patches](rough_contact.md). It replaces the usual constants of Greenwood and Tripp's law.
  The form of the law stays: its two products are fitted to the load and the area of the table
  between h/sigma 0.5 and 3. `gearlube axle show` prints the fit and the factor by which it misses
  the table, up to 2.6 for Gaussian surfaces. If `roughness_rms_um` is left out, the roughness is
  that of the table. If it is given, it changes the film ratio only.
- An `asperity_table` of surfaces pressed together without oil puts far more load on the asperities
  than the usual constants do. It does not include the oil pressure that flattens the roughness
  before the surfaces touch. See [loss_map.md](loss_map.md#mixed-friction-of-the-flanks).
- `film.model` says where film and friction of the oil on the flanks come from. `formula` is
  Chittenden 1985 with Evans and Johnson 1986. `solved` is a model of solved thermal Eyring films.
  It knows the oil by its viscosity, `alpha_per_gpa`, `eyring_stress_mpa`, conductivity and heat
  capacity. Outside its domain the formulas come in. The results then have the share of load
  outside, and bounds of losses and efficiency. [film_model_axle.md](film_model_axle.md) compares
  both. `gearlube axle show` tells which of the oil's data are assumed: they matter more than the
  model's own error.
- `film.flank_model` and `film.roller_model` name
  [film models of your own oil](film_model.md#a-model-of-your-own-oil) in place of those in the
  package: for the flanks, and for the rollers with `solved_films`. A model of another kind, a
  damaged file, and a model that says nothing of the oil at any temperature are refused. Maps,
  cycles, sweeps and variations, and the FMUs that are built with the file, then compute with them.
- `film.limiting_slope` is the limiting shear stress of the film divided by pressure. The film model
  knows no such limit: contacts that come near it count as outside. It does not change the junctions
  of `limiting_shear_stress_mpa` and `boundary_friction`.
- `film.bulk_resistance_k_w` lets the friction of the flanks warm their bulk: its temperature over
  the oil's is this resistance times the mean friction loss in steady running. Films, friction and
  rolling of the flanks are then those at the temperature of the bulk; bearings, churning and seals
  stay at the oil's. `gearlube map` and `gearlube cycle` use it; a sweep or another march in time
  refuses it. 0, the default, leaves it out.
  [film_model_axle.md](film_model_axle.md#heat-of-the-flanks-bulk) says what is known of the number.
- `friction` of `[model]` names a law of the flank friction: {laws}.
  A law of your own is one Python file, see [architecture.md](architecture.md#how-to-add). Import it
  before the axle file is read, or install it with an entry point of the group `gearlube.laws`,
  which commands and their workers find too. Its numbers stand in `friction_numbers`. A native FMU
  is compiled for the law of its axle file; its parameters then end with the numbers of the law.
- Rolling friction of the flanks is only modelled if `flank_rolling` of `[model]` names its law.
- `bearing_torque_loss` of `[model]` selects the law of the bearing drag; `solved_films` takes the
  rollers' friction and films from [solved films](film_model_axle.md#rollers-with-solved-films).
  All laws except palmgren use the forces of each bearing or the load of each roller, updated at
  least once in 12 integrator steps. With the laws that sum over the rollers a communication step
  of 0.1 ms takes 2 to 4 times as long.
- `oil.file` names an [oil file](oil_file.md), which describes your oil by its data sheet. It
  replaces all other fields of `[oil]`.
- Churning is only modelled if the file has a field of `[housing]`, seals only if it has a field of
  `[seals]`. For churning the immersion depth matters most. The rotating gear throws oil off, which
  lowers the immersion, and the laws differ by a factor of three. The torque of a seal does not
  depend on speed. `wheel_torque_n_m` is the torque of the seals of both wheels together.

## Scatter and errors in the file

- `[tolerances]` says how fields vary from part to part. Each field is named with its section:
  `gear_set.backlash_um = { plus_minus = 30.0 }`, or `plus_minus_percent`, or
  `standard_deviation`. The distribution is normal unless `distribution = "uniform"` is set. For
  a normal distribution the tolerance is three standard deviations, and parts outside the
  tolerance are rejected. [`gearlube vary --scatter`](vary.md#scatter-from-part-to-part) samples
  these fields.
- All wrong fields of a file are reported together, before anything is compiled. Each message gives
  the value, its limits and its unit. If the value would be within the limits in another unit, the
  message names that unit.
- A number within its limits but outside its usual range is taken, with a warning that names the
  unit in which it would be usual.
- A relative path in a file counts from the folder of that file.

## Fields
"""

_TAIL = """
## The sweep

`gearlube sweep my_axle.toml` takes oil, roughness, equations, friction and drag torque from the
file. An option on the command line overrides the file. Without `--preload` the sweep runs the
preload of the file; if the file gives none, it runs 2500 and 6000 N. `--preload` sets the bearings
of the pinion's shaft. The bearings of the gear's shaft get the same preload, unless the file gives
them their own. The oil temperature is set by `--oil-temperature`, by default 95 degC. With
`--steady-temperature` each point has its own steady oil temperature, see
[drive_cycle.md](drive_cycle.md). If the road load needs a torque above that of the mesh table, the
sweep warns. If it needs more than 1.5 times that torque, the sweep stops before it builds anything.

## The FMU

`gearlube build-fmu --axle my_axle.toml` builds native [FMUs](fmu.md). With `--python` it builds an
FMU that computes in this Python package. The FMU contains these files:

- the axle file as `resources/axle.toml`; paths in this copy have no effect
- your mesh table, or the one computed from the gear file, as `resources/mesh_table.nc`; the gear
  file itself is not in the FMU
- the asperity table, if any, as `resources/asperity_table.nc`
- the oil file, if any, as `resources/oil.toml`
- film models of your own, if any, as `resources/flank_film_model.json` and
  `resources/roller_film_model.json`

The GUID of the FMU depends on every byte of these files. The start values of its parameters are
those of the axle file. If the axle file describes its own oil, `oil.name` has the value `custom`.
`--mesh-table` cannot be used with `--axle`, because the axle file names its gears. A sweep stores
one such FMU in the cache for each content of file and tables. The FMU does not contain the car: the
vehicle, tyre, gearbox, engine and driveline of the file are used by the sweep only.

These inputs are parameters of the FMU and can be set at run time. All others are built in.

| Parameter | Input |
|---|---|
{parameters}
## Limits

- Each shaft has two equal bearings in opposed arrangement. The distance between them is not an
  input, because the model has no tilt of the shafts.
- For two unlike bearings give sizes halfway between them. An example with bearings of 45 and 40 mm
  bore (pitch diameters 74 and 66 mm): the loss of the axle is within 1 % of the mean of two axles,
  one with each bearing, by palmgren, skf_2013 and zhou_hoeprich_1991.
- The two bearings of an overhung pinion share the radial load unequally. With 6 and 2 kN in place
  of 4 and 4 kN the drag of both together changes by at most 0.6 % by zhou_hoeprich_1991, and by
  less with the other laws. The axial forces caused by tilt are not included in this number. These
  numbers hold for the losses, not for the dynamics of the two bearings.
- Masses and inertias are those given, those computed from the frusta, or those of the paper. They
  are not computed from the tooth shape: a frustum between root and tip replaces the teeth.
- The stiffness of the rollers is always that of steel, whatever `[steel]` says.
- Both races use the contact angle of the outer race. The rib contact uses another angle for the
  inner race: the angle at which rollers and races share one apex.
"""
_FIELDS = {
    "bearing_preload": "`pinion.bearing.preload_n`",
    "gear_bearing_preload": "`gear.bearing.preload_n`",
    "oil": "`oil`",
    "pinion_seal_torque": "`seals.pinion_torque_n_m`",
    "wheel_seal_torque": "`seals.wheel_torque_n_m`",
    "rolling": "`model.flank_rolling`",
    "film": "`film.model`",
    "film_limiting_slope": "`film.limiting_slope`",
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
    listed = [f"`{name}` ({law.text})" for name, law in friction_laws().items()]
    head = HEAD.replace("{laws}", ", ".join(listed))
    return head + tables + _TAIL.format(parameters=_run_time_parameters())


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
