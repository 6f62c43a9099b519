"""Rewrite docs/problem_file.md: python -m docs.problem_file."""

from __future__ import annotations

from pathlib import Path

from docs.field_tables import field_tables
from gearlube_core.flank_optimisation.problem_file import OptimisationFile

PAGE = Path(__file__).with_suffix(".md")
SECTIONS = {
    "": "The file",
    "settings": "[settings]: of a hypoid pair; may be left out",
    "errors": "[errors]: may be left out",
    "limits": "[limits]: may be left out",
}

HEAD = """# The problem file of `gearlube optimise`

The tables are written by `python -m docs.problem_file` from the data model
(`gearlube_core/flank_optimisation/problem_file.py`), the text with them; not edited by hand.

A problem file says which values of a gear pair may change, and for which torques and assembly
errors the pair shall be quiet. [optimise.md](optimise.md) shows three pairs before and after.

```
gearlube optimise helical --example > my_problem.toml     # or hypoid
gearlube optimise my_problem.toml --out my_pair
gearlube helical my_pair/jamali_2015_a_quiet.toml         # analyses the better pair
gearlube contact my_pair/mohammadpour_2015_quiet.toml     # the same for a hypoid pair
```

`gearlube design` writes such a file for the pair that it designs, as `problem.toml`; with
`--optimise` it runs this command on it.

**Parameters** are fields of the [gear file](gear_file.md) or its [helical
twin](helical_gear_file.md), each with bounds in the unit of the field:

```
[parameters]
pinion.flank.tip_relief_um = { low = 0.0, high = 30.0, start = 8.0 }
```

For a helical pair the parameters are fields of `pinion.flank` and `gear.flank`. For a hypoid pair
they are reliefs, crowns and twist of the loaded flanks (`pinion.drive_flank`, `gear.drive_flank`),
and fields of `machine` and `cutter`. The blank does not change. A field that is not named keeps its
value. In this way you can keep one member, or the blades of both, unchanged.

`[settings]` makes all machine settings of the pinion parameters, within small ranges. The blades
are not included. If the machine has modified roll and helical motion, name them in `[parameters]`.
"""

TAIL = """
## What is minimised

The mesh orders follow from the loaded transmission error at N mesh phases,

c_k = (2/N) sum_n theta_n exp(-2 pi i k n/N)

at each torque and error. All orders together give W^2 = sum |c_k|^2 at one torque and error.

- `mean` minimises the mean of W^2 over torques and errors. Each torque is taken relative to the
  original pair. The mean of the square includes the scatter: it is the square of the mean plus the
  variance. So this gives the robust pair.
- `--nominal` also finds the pair that is best without errors, for comparison.
- `worst` minimises the highest W^2 of all torques and errors.

## Limits

| Limit | Measure, at each torque |
|---|---|
| `pressure` | highest pressure over all phases and errors |
| `loss` | sliding power of normal forces / power of pinion, mean over phases and errors |
| `sensitivity` | change of the mesh orders (complex numbers) by the errors, root mean square |
| `force_swing` | mesh orders of the normal force / its mean, rms over errors; hypoid only |
| `edge_share` | largest share of the load in a border along tip, toe and heel of either flank |
| `other_side_pressure` | `pressure` of the other flanks, at each of `other_side_torques_n_m` |
| `other_side_edge_share` | `edge_share` of the other flanks, at each of these torques |

`force_swing` limits the variation of the mesh force at constant torque. The lever arm of the mesh
force about the pinion's axis varies over the mesh cycle. At constant torque the force must vary
too. The bearings carry this varying force, but the transmission error does not show it. A hypoid
pair with a smaller transmission error and without this limit can excite its bearings more than
before, above all at low speeds. [optimise.md](optimise.md) has an example. In a helical pair the
lever arm is constant.

All limits except the two edge shares are relative to the original pair. The loss is computed with
one coefficient of friction, without oil and film. The border includes no strip along the root of a
flank. In a helical pair it includes both ends of the face.

Both flanks of a hypoid member are cut in one set-up. So if machine or cutter may change, the coast
side changes too. Two limits hold there: the slopes between the coast flanks at the mean point stay
below 4 mrad, and the reference plane of the pinion's cutter stays within 0.05 mm of mid-depth.

These two limits are not enough: the contact may still move to an edge of the coast flanks. Give
`other_side_torques_n_m` and the limits of that side. These torques are not part of what is
minimised. With them the fields of the coast flanks, for example `pinion.coast_flank.lead_crown_um`,
and the blade angle that cuts them can be parameters too.

## How it is found

1. The region around the contact is divided into cells once, for every torque, error and phase. The
   region is 1.25 times as wide as the contact and 1.5 times as deep. The compliance of these cells
   is stored. If values change, only the gaps change: exactly for reliefs and crowns, to first order
   for machine settings. An active-set method solves the contact of these cells again, which takes
   milliseconds.
2. The derivatives of rotation, pressure, sliding loss and edge share follow from the equilibrium of
   the loaded cells. The mesh orders are linear in the rotation. SLSQP (scipy) changes the values
   within a trust region under the limits. A limit that is exceeded has a price, so that the search
   finds its way back.
3. The cells are made again at the new values. If the pair is better, it is the next start. If it is
   not, what the new cells added to each limit is added in the next rounds too. If they added
   nothing, the trust region becomes smaller.
4. The standard loaded analysis, with its own cells and twice the number of phases, evaluates the
   original pair and the better pair. All numbers of the report come from it. If it finds a limit
   exceeded, the search continues with a tighter limit, at most twice. A pair that keeps all limits
   is chosen before a quieter one that does not.

The search finds the best pair near its start, not the best of all. Try other starts. The compliance
of the teeth stays that of the original pair. The report says which values are on a bound, which
limits are exceeded, and whether the search had no success.

## Results

| File | |
|---|---|
| NAME.toml | gear file with the better values |
| report.html | change in dB at each torque, active limits, what became worse, all measures |
| optimise.nc | the same as arrays, transmission error over the mesh, all errors, Pareto front |
| figures/ | transmission error, mesh orders, whine under each error, Pareto front |
| evaluations/, positions/ | intermediate results; after a stop the same command uses them |

`--front N` computes a Pareto front: the smallest loss under N limits of the mesh orders. The limits
go from the smallest mesh orders found to those of the original pair. The front is computed on cells
held at the better pair. Where a search wants to move values by more than 0.35 of their bounds, the
cells are made again there. Of all pairs that these searches meet and that keep the limits, those
are shown that no other one beats in both measures. They can be fewer than N.

In Python:

```python
import gearlube as gl

found = gl.run_optimise(gl.OptimisationFile.from_toml("my_problem.toml"), folder="my_pair")
found.dataset["whine"].sel(error="none")  # rad, by design and torque
```

The mesh orders are those of the static loaded transmission error. Resonances of the driveline are
not included. To include them, use the mesh table of the better pair in `gearlube sweep` or in the
FMU. `gearlube map` accepts this table too.
"""


def page() -> str:
    """Return docs/problem_file.md."""
    return HEAD + "\n## Fields\n" + field_tables(OptimisationFile, SECTIONS) + TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
