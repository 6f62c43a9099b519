"""The train of a native axle: its plan, and its numbers out of packed floats."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from fmu_src.native.parameter_map import AxleSettings
from gearlube_core.arrays import Array, Offsets
from gearlube_core.bearings.followed_shaft import EXPANSION_REACH
from gearlube_core.dynamics.hypoid_axle.as_train import hypoid_axle
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARING_GROUP,
    FLANK_GROUP,
    MOTION_OUTPUTS,
    OUTPUT_INDEX,
    STATE_NAMES,
)
from gearlube_core.dynamics.hypoid_axle.train_outputs import AGAINST, STATES, output_places
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_force import reference_frequency
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.train.assemble import Assembly, assemble
from gearlube_core.dynamics.train.choice import generated_kernel
from gearlube_core.dynamics.train.element import N_COORDINATES
from gearlube_core.dynamics.train.elements.drag import Churning, Seal
from gearlube_core.dynamics.train.elements.held_port import HeldPort
from gearlube_core.dynamics.train.elements.hypoid_mesh import HypoidMesh
from gearlube_core.dynamics.train.elements.opposed_bearings import OpposedBearings
from gearlube_core.dynamics.train.march import work_size
from gearlube_core.dynamics.train.part import Element
from gearlube_core.dynamics.train.plan import (
    AT,
    FIRST_ROW,
    MEMORY,
    N_MEMORY,
    N_PLACES,
    NUMBER,
    Sizes,
)
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.kernels.flat_tuples import count_floats, flatten, tuple_from_array
from gearlube_core.kernels.jit import kernel

_SIZES_OF_MESH = 5
_TORQUES = {
    "pinion seal": "pinion_seal_torque",
    "wheel seals": "wheel_seal_torque",
    "wheel hubs": "hub_torque",
}


class NumberMap(NamedTuple):
    """Places of the numbers of a train that parameters change."""

    copied: Offsets  # pairs: place, and that of the packed float that stands there
    dragging: Offsets  # what is zero at rest
    compliance: int  # of the mesh
    steps_per_period: int  # likewise
    reaches: tuple[int, int]  # of the bearings
    mobilities: tuple[int, int]  # first of pinion and of gear
    holder: int  # first of those of the holder of the speed


class AxleTrain(NamedTuple):
    """The train of all axles of a kind."""

    operate: Callable[..., float]
    sizes: Sizes
    numbers: NumberMap
    constants: Array  # numbers that no parameter changes, the others as at the start
    n_numbers: int
    work: int
    # the plan without what the mesh table decides, and the places of that in it
    plan: Offsets
    mesh_memory: int
    mesh_sizes: int  # the first of five
    roller_films: Offsets
    behind: Offsets  # where memory begins, counted from the end of that of the mesh
    films: Offsets  # where the film models of rollers begin, likewise
    others: int  # numbers of the memory of all elements but the mesh
    mesh: tuple[int, ...]  # places `at` of the mesh without its sizes
    outputs: Array
    motion: Offsets  # outputs that follow from the state and the mesh force
    of_flanks: Offsets  # likewise from the flanks
    of_bearings: Offsets
    bits: tuple[int, int]  # of the mesh, and of both bearings, for SHOW
    state_places: tuple[int, ...]
    state_units: tuple[float, ...]

    @property
    def words(self) -> list[Any]:
        """All of it that is compiled into an entry."""
        groups = self.motion, self.of_flanks, self.of_bearings
        arrays = (self.plan, self.roller_films, self.behind, self.films, self.outputs, *groups)
        copied = self.numbers._replace(
            copied=self.numbers.copied.tolist(),  # type: ignore[arg-type]
            dragging=self.numbers.dragging.tolist(),  # type: ignore[arg-type]
        )
        whole = (self.sizes, self.n_numbers, self.work, self.mesh_memory, self.mesh_sizes)
        return [*whole, self.others, self.mesh, copied, *(one.tolist() for one in arrays)]


@kernel
def write_numbers(
    packed: Array,
    p: AxleParameters,
    settings: AxleSettings,
    numbers: NumberMap,
    drags: float,
    out: Array,
) -> None:
    """Write the numbers of the train that parameters change.

    Parameters
    ----------
    packed : ndarray
        Flattened AxleParameters, as they are or without losses, then AxleSettings.
    p, settings
        Parameters and settings as given.
    drags : float
        0 for the state at rest, without drag.
    """
    for i in range(numbers.copied.size // 2):
        out[numbers.copied[2 * i]] = packed[numbers.copied[2 * i + 1]]
    if drags == 0.0:
        for i in range(numbers.dragging.size):
            out[numbers.dragging[i]] = 0.0
    R_p = settings.mean_pinion_radius
    R_g = R_p * p.ratio
    of_turning = R_p * R_p / p.I_p + R_g * R_g / p.I_g
    out[numbers.steps_per_period] = settings.steps_per_mesh_period
    out[numbers.compliance] = of_turning + 1.0 / p.m_p + 1.0 / p.m_g
    per_period = settings.steps_per_highest_period
    for i in range(2):
        out[numbers.reaches[i]] = EXPANSION_REACH / (per_period * per_period)
        first = numbers.mobilities[i]
        for j in range(3):
            out[first + j] = 1.0 / (p.m_p if i == 0 else p.m_g)
        out[first + 5] = 1.0 / (p.I_p if i == 0 else p.I_g)


def axle_of_kind(axle: HypoidAxleParameters, place: Any) -> AxleTrain:
    """Return the train of all axles that share bearing types, flank law and oil laws with one.

    It has room for solved films, which a parameter may choose.

    Parameters
    ----------
    axle : HypoidAxleParameters
    place : AxleParameters
        With the place of each float among the packed ones, see `place_of_each`.
    """
    shipped = isinstance(place.flank_law, MixedFlankFriction)
    solved = shipped or axle.friction_law.solved_film
    largest = replace(
        axle,
        bearing_torque_loss="solved_films",
        film="solved" if solved else "formula",
        friction="consistent" if shipped else axle.friction,
    )
    bodies, elements = hypoid_axle(largest)
    made = assemble(bodies, elements, largest.oil, kinds=())
    rows = _rows(made, elements)
    at_mesh = rows["mesh"]
    of_mesh = made.plan[at_mesh + N_MEMORY]
    plan = made.plan.copy()
    first_size = at_mesh + AT + plan[at_mesh + N_PLACES] - _SIZES_OF_MESH
    plan[at_mesh + N_MEMORY] = 0
    plan[first_size : first_size + _SIZES_OF_MESH] = 0
    bearings = [rows[one.name] for one in elements if isinstance(one, OpposedBearings)]
    roller_films = np.array([row + AT + plan[row + N_PLACES] - 1 for row in bearings])
    plan[roller_films] = 0
    behind = [row + MEMORY for row in rows.values() if row > at_mesh]
    plan[behind] -= of_mesh
    ends = [plan[row + MEMORY] + plan[row + N_MEMORY] for row in bearings]
    states = {one.record.name: one for one in made.continuous}
    return AxleTrain(
        operate=generated_kernel(made),
        sizes=made.sizes,
        numbers=_number_map(made, elements, rows, place),
        constants=made.numbers,
        n_numbers=made.numbers.size,
        work=work_size(made.sizes),
        plan=plan,
        mesh_memory=int(at_mesh + N_MEMORY),
        mesh_sizes=int(first_size),
        roller_films=roller_films,
        behind=np.array(behind),
        films=np.array(ends) - N_ARRAY,
        others=int(made.memory.size - of_mesh),
        mesh=tuple(made.plan[at_mesh + AT : first_size].tolist()),
        outputs=output_places(made),
        motion=np.array([OUTPUT_INDEX[name] for name in MOTION_OUTPUTS]),
        of_flanks=np.array([OUTPUT_INDEX[name] for name in FLANK_GROUP]),
        of_bearings=np.array([OUTPUT_INDEX[name] for name in BEARING_GROUP]),
        bits=(_bits(elements, HypoidMesh), _bits(elements, OpposedBearings)),
        state_places=tuple(states[STATES[name]].place for name in STATE_NAMES),
        state_units=tuple(-1.0 if name in AGAINST else 1.0 for name in STATE_NAMES),
    )


def _bits(elements: list[Element], kind: type[Element]) -> int:
    return sum(1 << i for i, one in enumerate(elements) if isinstance(one, kind))


def _rows(made: Assembly, elements: list[Element]) -> dict[str, int]:
    """Return where the row of each element begins in the plan."""
    found, at = {}, FIRST_ROW
    for one in elements:
        found[one.name] = at
        at += AT + int(made.plan[at + N_PLACES])
    return found


def _number_map(
    made: Assembly, elements: list[Element], rows: Mapping[str, int], place: Any
) -> NumberMap:
    copied, dragging, reaches = [*enumerate(flatten(place.oil).tolist())], [], []
    compliance = steps = holder = 0
    nan = math.nan
    for one, listed in zip(elements, made.listed, strict=True):
        first = int(made.plan[rows[one.name] + NUMBER])
        count = count_floats(listed.numbers, *listed.variants)
        own: Any = tuple_from_array(
            first + np.arange(float(count)), listed.numbers, *listed.variants
        )
        of_pinion = one.name.startswith("pinion")
        if isinstance(one, HypoidMesh):
            compliance, steps = int(own.compliance), int(own.steps_per_period)
            found = own._replace(
                **{name: getattr(place, name) for name in own._fields if hasattr(place, name)},
                steps_per_period=nan,
                compliance=nan,
                pinion_radius=nan,
            )
        elif isinstance(one, OpposedBearings):
            dragging += [int(own.law), int(own.on_cage)]
            reaches.append(int(own.reach))
            found = own._replace(
                bearings=place.bearing_p if of_pinion else place.bearing_g,
                preload=place.preload_p if of_pinion else place.preload_g,
                law=place.drag,
                orders=nan,
                least_frequency=reference_frequency(place.mesh, 0.0),  # its place, as of the number
                reach=nan,
                on_cage=place.mesh.consistent,
            )
        elif isinstance(one, HeldPort):
            holder = int(own.mode)
            found = own._replace(
                inertia=place.I_p, **dict.fromkeys(("sign", *own._fields[2:]), nan)
            )
        elif isinstance(one, Seal):
            dragging.append(int(own.torque))
            found = own._replace(torque=getattr(place, _TORQUES[one.name]))
        elif isinstance(one, Churning):
            dragging.append(int(own.gear.law))
            found = own._replace(gear=place.churning)
        else:
            continue
        pairs = enumerate(flatten(found).tolist(), first)
        copied += [(to, of) for to, of in pairs if not math.isnan(of)]
    pinion = made.sizes.first_mobility
    return NumberMap(
        np.array(copied, dtype=np.int64).ravel(),
        np.array(dragging),
        compliance,
        steps,
        (reaches[0], reaches[1]),
        (pinion, pinion + N_COORDINATES),
        holder,
    )
