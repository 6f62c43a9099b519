"""How the values of FMI parameters become packed floats, found by asking the Python model.

A packed float is what it is by default, or what one literal of one enumeration makes it, or the
value of one number as it stands, or it follows from several by a kernel of the model. Which holds
is found by packing once for every literal and twice for every number, so that no option's meaning
is written a second time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, get_args

import numpy as np

from fmu_src.definition import Value
from fmu_src.variable import Variable
from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftBearings, write_derived
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters, MeshStiffness, Radii
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.errors import ParameterError
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.friction.thermal_eyring_data import PRESSURES
from gearlube_core.kernels.flat_tuples import count_floats, flatten, tuple_from_array
from gearlube_core.kernels.jit import kernel

Pack = Callable[[Mapping[str, Value]], Array]  # parameters by `Variable.argument` -> packed floats


class AxleSettings(NamedTuple):
    """Other data of an axle that a parameter can change, packed behind its `AxleParameters`."""

    torque_low: float  # N.m, limits of the inputs in their order
    torque_high: float
    wheel_low: float  # N.m
    wheel_high: float
    oil_low: float  # K
    oil_high: float
    speed_low: float  # rad/s, of the reference
    speed_high: float
    steps_per_mesh_period: float
    steps_per_highest_period: float
    radii: float  # place of the option in `Radii`
    stiffness: float  # the same in `MeshStiffness`
    pressure: float  # the same in `PRESSURES`
    modal: float  # 1 with modal damping of the mesh, 0 with hysteresis
    modal_loss_factor: float
    reference_stiffness: float  # N/m, of the modal damping
    mean_pinion_radius: float  # m, the same
    solved: float  # 1 with solved films of the flanks
    own_film: float  # 1 if the law of friction has a film that a solved one cannot replace


def axle_settings(axle: HypoidAxleParameters) -> AxleSettings:
    """Return the settings of an axle."""
    torques = torque_limits(axle)
    return AxleSettings(
        torques.pinion_low,
        torques.pinion_high,
        -torques.wheel,
        torques.wheel,
        axle.oil.temperature_low,
        axle.oil.temperature_high,
        -MAX_SPEED,
        MAX_SPEED,
        float(axle.steps_per_mesh_period),
        float(axle.steps_per_highest_period),
        float(get_args(Radii).index(axle.radii)),
        float(get_args(MeshStiffness).index(axle.mesh_stiffness)),
        float(list(PRESSURES).index(axle.friction_law.pressure)),
        1.0 if axle.mesh_damping == "modal" else 0.0,
        float(axle.modal_loss_factor),
        axle.reference_stiffness,
        axle.mean_pinion_radius,
        1.0 if axle.film == "solved" else 0.0,
        0.0 if axle.friction_law.solved_film else 1.0,
    )


@dataclass(frozen=True, eq=False)
class ParameterMap:
    """The map as arrays for `write_packed`.

    Parameters
    ----------
    base : ndarray of shape (m,)
        Packed floats of the start values.
    options : ndarray of shape (2 n,)
        For each enumeration its place among the parameters and its first row.
    rows : ndarray of shape (r * m,)
        For each literal the floats that it sets, NaN for the others.
    numbers : ndarray of shape (2 k,)
        For each packed float that is a parameter as it stands: its place, and the parameter's.
    """

    base: Array
    options: Array
    rows: Array
    numbers: Array

    @property
    def arrays(self) -> tuple[Array, Array, Array, Array]:
        """The arrays in the order of the arguments of `write_packed`."""
        return self.base, self.options, self.rows, self.numbers


def parameter_map(
    variables: Sequence[Variable], pack: Pack, derived: frozenset[int]
) -> ParameterMap:
    """Return the map of the parameters among `variables`.

    Parameters
    ----------
    variables : sequence of Variable
        Of a definition.
    pack : callable
        Parameters by argument -> packed floats, shape (m,).
    derived : frozenset of int
        Places that a kernel of the model writes.

    Raises
    ------
    ParameterError
        A number changes a packed float that is neither equal to it nor derived.
    """
    parameters = [v for v in variables if v.is_model_parameter]
    start = {v.argument: v.decoded(v.start or 0.0) for v in parameters}
    base = pack(start)
    by_kernel = np.isin(np.arange(base.size), list(derived))
    taken = np.zeros(base.size, dtype=bool)  # by an enumeration
    options: list[int] = []
    rows: list[Array] = []
    numbers: list[int] = []
    for index, variable in enumerate(parameters):
        if variable.literals:
            options += [index, len(rows)]
            own = [pack(start | {variable.argument: literal}) for literal in variable.literals]
            sets = np.any(own != base, axis=0) & ~by_kernel
            if np.any(sets & taken):
                raise ParameterError(
                    f"{variable.name} must set packed floats of its own, got some that another "
                    "enumeration sets. Derive them by a kernel that the native entry calls too."
                )
            taken |= sets
            rows += [np.where(sets, packed, np.nan) for packed in own]
            continue
        low, high = variable.range
        one, two = (low + share * (high - low) for share in (0.25, 0.5))
        ends = [variable.decoded(round(v) if variable.type == "Integer" else v) for v in (one, two)]
        first, second = (pack(start | {variable.argument: value}) for value in ends)
        for place in np.flatnonzero(first != second).tolist():
            if first[place] == ends[0] and second[place] == ends[1]:
                numbers += [place, index]
            elif not by_kernel[place]:
                raise ParameterError(
                    f"{variable.name} must stand in the packed parameters as it is, got another "
                    f"number at place {place}. Write the formula as a kernel that the native "
                    "entry calls too."
                )
    return ParameterMap(
        base,
        np.array(options, dtype=float),
        np.concatenate(rows) if rows else np.zeros(0),
        np.array(numbers, dtype=float),
    )


@kernel
def write_packed(
    parameters: Array, base: Array, options: Array, rows: Array, numbers: Array, out: Array
) -> None:
    """Write the packed floats of FMI parameters, without those that kernels derive.

    Parameters
    ----------
    parameters : ndarray
        Values in the order of the variables, enumerations from 1.
    base, options, rows, numbers : ndarray
        Of a `ParameterMap`.
    out : ndarray of shape (m,)
    """
    m = base.size
    for i in range(m):
        out[i] = base[i]
    for k in range(options.size // 2):
        literal = int(parameters[int(options[2 * k])]) - 1
        row = (int(options[2 * k + 1]) + literal) * m
        for i in range(m):
            if rows[row + i] == rows[row + i]:
                out[i] = rows[row + i]
    for k in range(numbers.size // 2):
        out[int(numbers[2 * k])] = parameters[int(numbers[2 * k + 1])]


class KernelClasses(NamedTuple):
    """Classes for which the kernels of a model are compiled."""

    bearing: type[ShaftBearings]
    law: type[FlankLaw]


def place_of_each(kinds: KernelClasses) -> Any:
    """Return `AxleParameters` with the place of each float among the packed ones."""
    count = count_floats(AxleParameters, *kinds)
    return tuple_from_array(np.arange(float(count)), AxleParameters, *kinds)


def derived_places(place: Any, p: AxleParameters) -> frozenset[int]:
    """Return the places of the packed floats that are written here or by the bearings."""
    found = {int(place.preload_g), int(place.mesh.modal_damping)}
    pairs = (p.bearing_p, place.bearing_p, p.preload_p), (p.bearing_g, place.bearing_g, p.preload_g)
    for bearing, places, preload in pairs:
        places = flatten(places)
        written = np.full(places.size, np.nan)
        write_derived(bearing, preload, written)
        found |= set(map(int, places[~np.isnan(written)]))
    return frozenset(found)
