"""Constants of an axle that depend on its mesh table and oils, and their checks.

    DataSizes | packed floats of the start values | without losses | numbers of the train |
    film models | sensitivities of the losses | options | rows | numbers | levels |
    series of all options | windows of all options

An axle's library is the same for all mesh tables, so it checks the constants that it is given.
"""

from __future__ import annotations

from typing import Any, NamedTuple, get_args

import numpy as np

from fmu_src.native.parameter_map import AxleSettings, KernelClasses, ParameterMap
from fmu_src.object_code import array_at
from gearlube_core.arrays import Array
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle.train_outputs import N_BAND
from gearlube_core.dynamics.hypoid_mesh.flanks import N_FRICTION
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters, MeshStiffness, Radii
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, PackedMesh, pack_mesh
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import TABLE
from gearlube_core.film_model.net import UNITS, WIDTH
from gearlube_core.friction.flank_film import N_FLANK_MODEL
from gearlube_core.friction.thermal_eyring_data import PRESSURES
from gearlube_core.kernels.checked_numbers import all_finite, is_whole
from gearlube_core.kernels.flat_tuples import count_floats, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, SHAFT_HEAD

VARIANTS = len(get_args(Radii)) * len(get_args(MeshStiffness))
_PRESSURES = len(PRESSURES)
_MOST = 1e6  # of anything in a mesh table


class DataSizes(NamedTuple):
    """Whole numbers at the head of the constants."""

    levels: float
    series: float  # coefficients at one level
    orders: float
    nodes: float
    options: float  # numbers of the map of parameters, see `ParameterMap`
    rows: float
    numbers: float

    @classmethod
    def of(cls, mesh: PackedMesh, found: ParameterMap) -> DataSizes:
        """Return the sizes of a packed mesh and of a map of parameters."""
        of_mesh = mesh.levels.size, mesh.series_size, mesh.orders, mesh.nodes
        return cls(*of_mesh, found.options.size, found.rows.size, found.numbers.size)


N_SIZES = count_floats(DataSizes)


class DataEnds(NamedTuple):
    """Where the parts of any length end among the constants, and how long one option's are."""

    options: int
    rows: int
    numbers: int
    levels: int
    series: int
    windows: int
    series_size: int
    windows_size: int


@kernel
def data_ends(start: int, sizes: DataSizes) -> DataEnds:
    """Return where the parts end that begin with the options, at `start`."""
    options = start + int(sizes.options)
    rows = options + int(sizes.rows)
    numbers = rows + int(sizes.numbers)
    levels = int(sizes.levels)
    series_size = levels * int(sizes.series)
    windows_size = levels * (int(sizes.nodes) + 1) * N_CHANNELS
    series = numbers + levels + VARIANTS * series_size
    windows = series + _PRESSURES * windows_size
    return DataEnds(
        options, rows, numbers, numbers + levels, series, windows, series_size, windows_size
    )


@kernel
def memory_of_mesh(sizes: DataSizes) -> int:
    """Return the length of the memory of the mesh, with room for its film model."""
    windows = (int(sizes.nodes) + 1) * N_CHANNELS
    at_loads = (int(sizes.levels) + 1) * (int(sizes.series) + windows)
    return TABLE + int(sizes.levels) + at_loads + N_FRICTION + N_CHANNELS + N_FLANK_MODEL


@kernel
def work_behind(sizes: DataSizes, others: int) -> int:
    """Return the length of what stands last in the work array.

    One load's series, the memory of the mesh, and so many numbers of the memory of all others.
    """
    return int(sizes.series) + memory_of_mesh(sizes) + others


def mesh_data(axle: HypoidAxleParameters) -> tuple[PackedMesh, list[Array], list[Array]]:
    """Return the mesh as packed by default, and the series and windows of all options."""
    modulus = contact_modulus(axle.solid, axle.solid)
    series = [
        pack_mesh(axle.mesh, modulus, radii, stiffness).series
        for radii in get_args(Radii)
        for stiffness in get_args(MeshStiffness)
    ]
    by_pressure = [
        pack_mesh(axle.mesh, modulus, "consistent", "tangent", pressure) for pressure in PRESSURES
    ]
    return by_pressure[0], series, [one.windows for one in by_pressure]


class AxleStructure(NamedTuple):
    """Whole numbers that all axles of a kind have in common."""

    parameters: int
    # places in data, as in `_Places` of `hypoid_axle`
    lossless: int
    film_model: int
    roller_model: int
    options: int
    numbers: int  # how many the train has
    series: int  # in work
    others: int  # numbers of the memory of all elements but the mesh


def axle_structure(at: Any, n_parameters: int) -> AxleStructure:
    """Return the structure of an axle with these places."""
    return AxleStructure(
        n_parameters,
        at.lossless,
        at.film_model,
        at.roller_model,
        at.options,
        at.n_numbers,
        at.series,
        at.others,
    )


def counting_floats(place: Any, at: Any) -> Array:
    """Return place, lowest and highest value of each packed float that is an index or a count."""
    highest = {
        "radii": len(get_args(Radii)) - 1,
        "stiffness": len(get_args(MeshStiffness)) - 1,
        "pressure": _PRESSURES - 1,
    }
    counting = [
        (at.settings + AxleSettings._fields.index(name), 0, most) for name, most in highest.items()
    ]
    for bearing in (place.bearing_p, place.bearing_g):
        counting += [(int(p), 3, ROLLERS_MAX) for p in _roller_counts(bearing)]
    return np.array(counting, dtype=float).ravel()


def _roller_counts(bearing: Any) -> list[float]:
    """Return the places of the numbers of rollers in nested places of a bearing."""
    names = getattr(bearing, "_fields", ())
    inside = [
        count for part in bearing if isinstance(part, tuple) for count in _roller_counts(part)
    ]
    return [*inside, bearing.n_rollers] if "n_rollers" in names else inside


@kernel
def _fits_map(
    data: Array, s: AxleStructure, ends: DataEnds, literals: Array, counting: Array
) -> bool:
    """Whether the map of parameters stays in its arrays and leaves counting floats as they are."""
    fits = True
    packed = max(s.lossless - N_SIZES, 1)
    rows = (ends.rows - ends.options) // packed
    for k in range((ends.options - s.options) // 2):
        index, row = data[s.options + 2 * k], data[s.options + 2 * k + 1]
        fits = fits and is_whole(index, 0.0, s.parameters - 1.0)
        fits = fits and is_whole(row, 0.0, float(rows))
        if fits:
            options = literals[int(index)]
            fits = options >= 1.0 and row + options <= rows
    for k in range((ends.numbers - ends.rows) // 2):
        place, index = data[ends.rows + 2 * k], data[ends.rows + 2 * k + 1]
        fits = fits and is_whole(place, 0.0, packed - 1.0)
        fits = fits and is_whole(index, 0.0, s.parameters - 1.0)
        for i in range(counting.size // 3):
            fits = fits and place != counting[3 * i]
    for i in range(counting.size // 3):
        counts, low, high = int(counting[3 * i]), counting[3 * i + 1], counting[3 * i + 2]
        fits = fits and is_whole(data[N_SIZES + counts], low, high)
        for row in range(rows):
            value = data[ends.options + row * packed + counts]
            fits = fits and (value != value or is_whole(value, low, high))
    return fits


@kernel
def _fits_mesh(data: Array, ends: DataEnds, sizes: DataSizes) -> bool:
    """Whether a mesh table whose sizes are sound has an end of its levels and of its series."""
    tail = N_SERIES * (2 * int(sizes.orders) + 1)
    room = float(int(sizes.series) - tail - SHAFT_HEAD)
    fits = data[ends.levels - 1] >= 0.0 and all_finite(data, ends.numbers, ends.windows)
    if fits and int(sizes.series) > tail:
        for k in range(VARIANTS * int(sizes.levels)):
            at = ends.levels + k * int(sizes.series) + tail
            p, q = data[at], data[at + 1]
            fits = fits and is_whole(p, 0.0, _MOST) and is_whole(q, 0.0, _MOST)
            fits = fits and 2.0 * (p + q) <= room
    return fits


@kernel
def check_axle_data(
    data: Any, lengths: Array, s: AxleStructure, literals: Array, counting: Array
) -> int:
    """Return 0 if constants can be used by an entry of this structure, else 1.

    Parameters
    ----------
    data : C pointer
    lengths : ndarray of shape (2,)
        Of data and work.
    s : AxleStructure
    literals : ndarray of shape (s.parameters,)
        How many options each parameter has; none for numbers.
    counting : ndarray
        Of `counting_floats`.
    """
    if not lengths[0] >= s.options:
        return 1
    sizes: DataSizes = tuple_from_array(array_at(data, N_SIZES), DataSizes)
    whole = is_whole(sizes.levels, 1.0, _MOST) and is_whole(sizes.orders, 0.0, _MOST)
    whole = whole and is_whole(sizes.nodes, 1.0, _MOST) and is_whole(sizes.series, 1.0, _MOST)
    packed = s.lossless - N_SIZES
    whole = whole and is_whole(sizes.options, 0.0, _MOST) and is_whole(sizes.rows, 0.0, _MOST)
    whole = whole and is_whole(sizes.numbers, 0.0, _MOST) and int(sizes.rows) % packed == 0
    if not (whole and int(sizes.options) % 2 == 0 and int(sizes.numbers) % 2 == 0):
        return 1
    least = N_SERIES * (2 * int(sizes.orders) + 1)
    behind = int(sizes.series) - least
    if behind < 0 or 0 < behind < SHAFT_HEAD:
        return 1
    ends = data_ends(s.options, sizes)
    if lengths[0] != ends.windows or lengths[1] != s.series + work_behind(sizes, s.others):
        return 1
    values = array_at(data, ends.windows)
    fits = _fits_map(values, s, ends, literals, counting) and _fits_mesh(values, ends, sizes)
    fits = fits and all_finite(values, 0, s.lossless)
    fits = fits and all_finite(values, s.film_model - s.numbers, s.film_model)
    fits = fits and all_finite(values, s.options - N_BAND, s.options)
    fits = fits and is_whole(values[s.film_model + UNITS], 1.0, float(WIDTH))
    fits = fits and is_whole(values[s.roller_model + UNITS], 1.0, float(WIDTH))
    return 0 if fits else 1


def kind_of_classes(kinds: KernelClasses, compiled_for: tuple[Any, ...]) -> str:
    """Return what an entry for these classes is compiled for; nothing if one is a user's own."""
    names = [f"{one.__module__}.{one.__qualname__}" for one in kinds]
    shipped = all(name.startswith("gearlube_core.") for name in names)
    return f"{names} {compiled_for}" if shipped else ""
