"""Constants of HelicalPair.fmu that only gear files, line meshes and oils decide, as one array.

    places of the cases | film model of shipped pairs | of the custom one | oils | case | case | ...

A case is one gear.name with one mesh.stiffness_model, in the order of the literals:

    CaseHead | GivenPair | stations | torque levels | density | offset

The place of a case is zero where the FMU has no such pair.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from fmu_src.definition import Definition
from fmu_src.helical_pair import EmbeddedPair, chosen_pair, embedded_pair, line_model_of
from fmu_src.helical_variables import CUSTOM, HELICAL_PAIR
from fmu_src.object_code import array_at, pointer_at
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_model.model import torque_limits
from gearlube_core.dynamics.helical_pair.gear_file_pair import USUAL_OIL
from gearlube_core.dynamics.helical_pair.march.flanks import LINES_MAX
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.helical_pair.march.given_pair import GivenOil, GivenPair
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    all_stations,
    data_size,
    pack_march_mesh,
)
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.ranges import Range
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import pair_data_at
from gearlube_core.errors import GearLubeError
from gearlube_core.film_model.model import LINE, shipped_model
from gearlube_core.film_model.net import N_ARRAY, UNITS, WIDTH
from gearlube_core.kernels.checked_numbers import all_finite, is_whole
from gearlube_core.kernels.flat_tuples import count_floats, flatten, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import Lubricant

STIFFNESS_MODELS = 2
OIL_FLOATS = count_floats(GivenOil)
GIVEN_FLOATS = count_floats(GivenPair)


class CaseHead(NamedTuple):
    """Sizes and limits of one case."""

    levels: float  # torque levels of the line mesh
    stations: float  # places along a line
    size: float  # of the density at one level
    pinion_low: float  # torques beyond which no step is taken [N.m]
    pinion_high: float
    wheel: float  # of its magnitude


HEAD_FLOATS = count_floats(CaseHead)
_LITERALS = np.array([float(len(v.literals)) for v in HELICAL_PAIR if v.is_model_parameter])
_MOST = 1e6  # of anything in a line mesh


class CasePlaces(NamedTuple):
    """Where the parts of the constants begin, and what else all cases have in common."""

    film_models: int  # as many numbers of cases lie before
    oils: int
    oil: int  # among the parameters: as many oils as it has options
    work: int  # without the memory of the mesh


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalCases:
    """Constants of all cases, and words.

    Parameters
    ----------
    data : ndarray of shape (n,)
        Packed data in the order given above.
    missing : dict of int to str
        Why a case is missing, by its number.
    ranges : tuple of Range
        Words of the ranges.
    longest_memory : int
        Length of the longest memory of a mesh.
    """

    data: Array
    missing: dict[int, str]
    ranges: tuple[Range, ...]
    longest_memory: int


def helical_cases(definition: Definition) -> HelicalCases:
    """Return the cases of an FMU with its gear file and line mesh, if it carries them."""
    literals = {v.name: v.literals for v in definition.variables}
    names = [
        (gear, model)
        for gear in literals["gear.name"]
        for model in literals["mesh.stiffness_model"]
    ]
    embedded = embedded_pair(definition.resources)
    models = [line_model_of(name, embedded).copied_numbers() for name in ("", CUSTOM)]
    blocks: list[Array] = []
    places = np.zeros(len(names))
    missing: dict[int, str] = {}
    longest = 0
    oils: Array = np.empty(0)
    ranges: tuple[Range, ...] = ()
    for number, (name, model) in enumerate(names):
        try:
            gear, line_mesh = chosen_pair(name, model, embedded)
            # any oil and film model: the FMU's parameters choose among those before the cases
            parameters = helical_march_parameters(
                gear, line_mesh=line_mesh, oil=USUAL_OIL, line_film_model=shipped_model(LINE)
            )
        except GearLubeError as error:
            missing[number] = str(error).removesuffix(".")
            continue
        if not oils.size:
            oils = _oils(parameters, literals["oil.name"], embedded)
            ranges = _words(parameters)
        places[number] = sum(one.size for one in (places, *models, oils, *blocks))
        block, length = _case(parameters)
        blocks.append(block)
        longest = max(longest, length)
    return HelicalCases(
        data=np.concatenate([places, *models, oils, *blocks]),
        missing=missing,
        ranges=ranges,
        longest_memory=longest,
    )


def _oils(
    parameters: HelicalMarchParameters, names: tuple[str, ...], embedded: EmbeddedPair | None
) -> Array:
    """Return GivenOil of every oil."""
    own = None if embedded is None else embedded.oil
    oils = [own if name == CUSTOM and own else Lubricant.named(name) for name in names]
    return np.concatenate([flatten(replace(parameters, oil=one).given_oil()) for one in oils])


def _words(parameters: HelicalMarchParameters) -> tuple[Range, ...]:
    """Return the ranges in words that hold for every oil."""
    name = parameters.oil.name
    return tuple(
        one._replace(beyond=one.beyond.replace(name, "the oil")) for one in parameters.ranges
    )


def _case(parameters: HelicalMarchParameters) -> tuple[Array, int]:
    """Return the constants of one case and the length of the memory of its mesh."""
    mesh = pack_march_mesh(parameters.mesh)
    station = all_stations(parameters.mesh)
    limits = torque_limits(parameters)
    size = mesh.density.shape[1]
    head = CaseHead(
        levels=mesh.torque.size,
        stations=station.size,
        size=size,
        pinion_low=limits.pinion_low,
        pinion_high=limits.pinion_high,
        wheel=limits.wheel,
    )
    fields = mesh.density.ravel(), mesh.offset.ravel()
    block = np.concatenate(
        [flatten(head), flatten(parameters.given()), station, mesh.torque, *fields]
    )
    return block, pair_data_at(mesh.torque.size, size) + data_size(station.size, size)


@kernel
def _case_length(case: Any) -> tuple[int, int]:
    """Return the lengths of a case and of the memory of its mesh; 0, 0 if its sizes cannot be."""
    head: CaseHead = tuple_from_array(array_at(case, HEAD_FLOATS), CaseHead)
    given: GivenPair = tuple_from_array(
        array_at(pointer_at(case, HEAD_FLOATS), GIVEN_FLOATS), GivenPair
    )
    fits = is_whole(head.levels, 1.0, _MOST) and is_whole(head.stations, 2.0, _MOST)
    fits = fits and is_whole(head.size, 2.0, _MOST) and is_whole(given.lines, 1.0, LINES_MAX)
    fits = fits and is_whole(given.phases, 1.0, _MOST) and given.stations == head.stations
    if not (fits and given.lines * given.phases * given.stations == head.size):
        return 0, 0
    levels, stations, size = int(head.levels), int(head.stations), int(head.size)
    length = HEAD_FLOATS + GIVEN_FLOATS + stations + levels + 2 * levels * size
    return length, pair_data_at(levels, size) + data_size(stations, size)


@kernel
def check_cases(data: Any, lengths: Array, literals: Array, places: CasePlaces) -> int:
    """Return 0 if constants of this length can be used, else 1; `data` is a C pointer.

    `lengths` are those of data and work, and `literals` how many options each parameter has.
    """
    for i in range(_LITERALS.size):
        if literals[i] != _LITERALS[i] and i != places.oil:
            return 1
    first = places.oils + OIL_FLOATS * literals[places.oil]
    if not (literals[places.oil] >= 1.0 and first <= lengths[0] <= 1e9):
        return 1
    values = array_at(data, int(lengths[0]))
    fits = True
    fits = fits and is_whole(values[places.film_models + UNITS], 1.0, float(WIDTH))
    fits = fits and is_whole(values[places.film_models + N_ARRAY + UNITS], 1.0, float(WIDTH))
    for number in range(places.film_models):
        place = values[number]
        if not fits or place == 0.0:
            continue
        last = lengths[0] - HEAD_FLOATS - GIVEN_FLOATS
        fits = is_whole(place, first, last)
        if fits:
            length, own = _case_length(pointer_at(data, int(place)))
            fits = length > 0 and place + length <= lengths[0]
            fits = fits and places.work + own <= lengths[1]
            if fits:
                mesh = int(place) + HEAD_FLOATS + GIVEN_FLOATS
                fits = all_finite(values, mesh, int(place) + length)
    return 0 if fits else 1


@kernel
def within_limits(inputs: Array, limits: Array) -> bool:
    """Return whether every input is within its limits."""
    within = True
    for i in range(inputs.size):
        within = within and limits[2 * i] <= inputs[i] <= limits[2 * i + 1]
    return within
