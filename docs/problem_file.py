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

What of a gear pair may change, and for which torques and errors it shall be quiet.
[optimise.md](optimise.md) shows three pairs before and after.

```
gearlube optimise helical --example > my_problem.toml     # or hypoid
gearlube optimise my_problem.toml --out my_pair
gearlube helical my_pair/he_2007_quiet.toml               # the better gear file; contact for hypoid
```

**Parameters** are fields of the [gear file](gear_file.md) or its [helical
twin](helical_gear_file.md), each with bounds in the unit of the field:

```
[parameters]
pinion.flank.tip_relief_um = { low = 0.0, high = 30.0, start = 8.0 }
```

Of a helical pair: `pinion.flank` and `gear.flank`. Of a hypoid pair: reliefs, crowns and twist of
the flanks that carry (`pinion.drive_flank`, `gear.drive_flank`), `machine` and `cutter`. The blank
stays. A field that is not named keeps its value: so a gear, or the blades of both, are kept.
`[settings]` frees the machine settings of the pinion at once, without its blades, within small
ranges; modified roll and helical motion are named in `[parameters]` where the machine has them.
"""

TAIL = """
## What is made least

The loaded transmission error at N mesh phases gives the mesh orders

c_k = (2/N) sum_n theta_n exp(-2 pi i k n/N)

at each torque and error. All orders together, at one torque and error: W^2 = sum |c_k|^2. `mean`
makes the mean of W^2 over torques and errors least, each torque relative to the pair as it is. The
mean square holds the scatter: it is the square of the mean plus the variance. So this is the
robust pair, and `--nominal` finds the one that is best without errors, to compare. `worst` makes
the highest W^2 of all torques and errors least.

## Limits

| Limit | Measure, at each torque |
|---|---|
| `pressure` | highest pressure of all phases and errors |
| `loss` | sliding power of the normal forces over the pinion's power, mean over phases and errors |
| `sensitivity` | how far errors move the mesh orders, complex numbers; root mean square |
| `force_swing` | mesh orders of the normal force over its mean, rms over errors; of hypoid pairs |
| `edge_share` | largest part of the load in a border along tip, toe and heel of either flank |
| `other_side_pressure` | `pressure` of the other flanks, at each of `other_side_torques_n_m` |
| `other_side_edge_share` | `edge_share` of the other flanks, likewise |

`force_swing` needs a word. The arm of the mesh force about the pinion's axis swings with the mesh.
At constant torque so does the force, and bearings feel it though the transmission error does not
show it. A hypoid pair with less error and no such limit can shake its bearings more than before, at
low speeds above all; [optimise.md](optimise.md) has an example. A helical pair's force keeps its
arm.

All but the edge shares are relative to the pair as it is. The loss is that at one coefficient of
friction: oil and film are not in it. The root of a flank has no border; of a helical pair both ends
of the face have.

Both flanks of a hypoid member are cut in one set-up: where machine or cutter may change, the slopes
between the flanks of the other side at the mean point stay below 4 mrad, and the reference plane of
the pinion's cutter within 0.05 mm of mid-depth. That is not enough: the bias of those flanks may
change until they bear on an edge. `other_side_torques_n_m` lets them carry torques of their own, of
coast where `side` is drive, under two limits; they are no part of what is made least. Then their
corrections, as `pinion.coast_flank.lead_crown_um`, and the blade angle that cuts them may be named
as parameters too, so that they can follow.

## How it is found

1. Cells of the loaded contact are cut once about the contact, 1.25 times wider and for 1.5 times
   its depth, at every torque, error and phase, and their compliance is kept. For other values
   only gaps change: removal of reliefs and crowns exactly, machine settings to first order. The
   contact of these cells is solved anew by an active set, which takes milliseconds.
2. Rates of rotation, pressure, sliding and edge share follow from the carrying cells' equilibrium.
   Mesh orders are linear in the rotation. SLSQP (scipy) moves the values within a region under the
   limits.
3. Cells are cut anew at what it found. Is the pair better, the next region is larger, else smaller.
   Limits that a round broke are tightened.
4. The plain loaded analysis, with its own cells and twice the phases, judges the pair as it is and
   the better one; all numbers of the report are from it. Where it finds a limit broken, the search
   goes on with that limit tighter, twice at most.

The search finds the best near its start, not the best of all: try other starts. The teeth's
compliance stays that of the pair as it is. Values that stand on a bound, limits that are not kept,
and a search without success are said in the report.

## Results

| File | |
|---|---|
| NAME.toml | gear file with the better values |
| report.html | dB at each torque, active limits, what got worse, values, all measures |
| optimise.nc | the same as arrays, error over the mesh, all errors; with `--front` the front |
| figures/ | transmission error, mesh orders, whine under each error, front |
| evaluations/, positions/ | what is computed; the same command goes on from there after a stop |

`--front N` asks for the least loss under N limits of the mesh orders, from the least to those of
the pair as it is, on the cells of the search; points that others beat are left out.

In Python:

```python
import gearlube as gl

found = gl.run_optimise(gl.OptimisationFile.from_toml("my_problem.toml"), folder="my_pair")
found.dataset["whine"].sel(error="none")  # rad, by design and torque
```

What is not here: the mesh orders count at the static loaded error, not at a resonance of the
driveline; `gearlube map`, `sweep` and the FMU take the better pair's mesh table as any other.
"""


def page() -> str:
    """Return docs/problem_file.md."""
    return HEAD + "\n## Fields\n" + field_tables(OptimisationFile, SECTIONS) + TAIL


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
