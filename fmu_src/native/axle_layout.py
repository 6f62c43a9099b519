"""Where the parts of a native axle's data and memory lie, and what its parameters write there."""

from __future__ import annotations

from typing import Any, NamedTuple, get_args

import numpy as np

from fmu_src.native.axle_data import N_SIZES, DataEnds, DataSizes, memory_of_mesh
from fmu_src.native.axle_numbers import AxleTrain
from fmu_src.native.parameter_map import AxleSettings, ParameterMap, write_packed
from gearlube_core.arrays import Array, Offsets
from gearlube_core.bearings.bearing_type import ShaftBearings, write_derived
from gearlube_core.dynamics.hypoid_axle.train_outputs import N_BAND
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_force import equivalent_mass, modal_damping
from gearlube_core.dynamics.hypoid_mesh.parameters import MeshStiffness
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import ASKED, OF_LOAD, TABLE
from gearlube_core.dynamics.train.rest_search import OK
from gearlube_core.film_model.net import N_ARRAY
from gearlube_core.friction.flank_film import N_FLANK_MODEL
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.kernels.flat_tuples import count_floats, flatten, tuple_from_array
from gearlube_core.kernels.jit import kernel

MODAL_WITHOUT_LOSS, PRINTED_FILM = 20, 21  # statuses, beside those of the kernels
_N_SETTINGS = count_floats(AxleSettings)
_STIFFNESSES = len(get_args(MeshStiffness))


class AxlePlaces(NamedTuple):
    """Where the parts of `data` and `work` begin; whole numbers, alike for all axles of a kind.

    In data `DataSizes` come first, then the packed floats of the start values. What has any length
    lies from the options on, see `data_ends`; in work from the series on.
    """

    # in data
    lossless: int  # for each float of `AxleParameters` its value without losses, or NaN: unchanged
    numbers: int  # of the train; those that parameters change are written over
    film_model: int
    roller_model: int
    options: int
    # in work
    settings: int
    without_losses: int
    own_numbers: int
    at_rest: int  # numbers of the train without losses
    plan: int
    trial: int
    scratch: int
    series: int  # of a load, then the memory of the train
    # sizes
    n_numbers: int
    n_plan: int
    states: int
    others: int  # numbers of the memory of all elements but the mesh
    # packed floats that are written here or by the bearings
    preload_g: int
    modal_damping: int
    bearing_p: int
    bearing_g: int


@kernel
def write_parameters(
    parameters: Array,
    data: Array,
    at: AxlePlaces,
    ends: DataEnds,
    bearing: type[ShaftBearings],
    law: type[FlankLaw],
    work: Array,
) -> int:
    """Write everything that follows from the FMI parameters into `work`; return a status."""
    write_packed(
        parameters,
        data[N_SIZES : at.lossless],
        data[at.options : ends.options],
        data[ends.options : ends.rows],
        data[ends.rows : ends.numbers],
        work,
    )
    p: AxleParameters = tuple_from_array(work, AxleParameters, bearing, law)
    settings: AxleSettings = tuple_from_array(work[at.settings :], AxleSettings)
    preload = p.preload_g if p.preload_g >= 0.0 else p.preload_p
    work[at.preload_g] = preload
    write_derived(p.bearing_p, p.preload_p, work[at.bearing_p :])
    write_derived(p.bearing_g, preload, work[at.bearing_g :])
    work[at.modal_damping] = 0.0
    if settings.modal != 0.0:
        mass = equivalent_mass(settings.mean_pinion_radius, p.ratio, p.I_p, p.I_g)
        work[at.modal_damping] = modal_damping(
            settings.modal_loss_factor, settings.reference_stiffness, mass
        )
    for i in range(at.settings):
        value = data[at.lossless + i]
        work[at.without_losses + i] = value if value == value else work[i]
    if settings.modal != 0.0 and settings.modal_loss_factor == 0.0:
        return MODAL_WITHOUT_LOSS
    if settings.solved != 0.0 and settings.own_film != 0.0:
        return PRINTED_FILM
    return OK


@kernel
def write_memory(
    settings: AxleSettings,
    data: Array,
    head: DataSizes,
    ends: DataEnds,
    at: AxlePlaces,
    films: Offsets,
    memory: Array,
) -> None:
    """Write the mesh table by the options that are set, and all film models."""
    variant = int(settings.radii) * _STIFFNESSES + int(settings.stiffness)
    series = ends.levels + variant * ends.series_size
    windows = ends.series + int(settings.pressure) * ends.windows_size
    for i in range(memory.size):
        memory[i] = 0.0
    memory[OF_LOAD], memory[ASKED] = np.nan, 1.0
    k, levels = TABLE, int(head.levels)
    for i in range(levels):
        memory[k + i] = data[ends.numbers + i]
    k += levels
    for i in range(ends.series_size):
        memory[k + i] = data[series + i]
    k += ends.series_size
    for i in range(ends.windows_size):
        memory[k + i] = data[windows + i]
    of_mesh = memory_of_mesh(head)
    for i in range(N_FLANK_MODEL):
        memory[of_mesh - N_FLANK_MODEL + i] = data[at.film_model + i]
    for bearing in range(films.size):
        for i in range(N_ARRAY):
            memory[of_mesh + films[bearing] + i] = data[at.roller_model + i]


def axle_places(found: ParameterMap, place: Any, axle: AxleTrain) -> AxlePlaces:
    """Return the layout of data and work; `place` is that of `place_of_each`."""
    n_parameters, n_numbers = flatten(place).size, axle.n_numbers
    lossless = N_SIZES + found.base.size
    numbers = lossless + n_parameters
    film_model = numbers + n_numbers
    roller_model = film_model + N_FLANK_MODEL
    without = n_parameters + _N_SETTINGS
    own_numbers = without + n_parameters
    plan = own_numbers + 2 * n_numbers
    trial = plan + axle.plan.size
    scratch = trial + axle.sizes.states
    return AxlePlaces(
        lossless=lossless,
        numbers=numbers,
        film_model=film_model,
        roller_model=roller_model,
        options=roller_model + N_ARRAY + N_BAND,  # between them the sensitivities of the losses
        settings=n_parameters,
        without_losses=without,
        own_numbers=own_numbers,
        at_rest=own_numbers + n_numbers,
        plan=plan,
        trial=trial,
        scratch=scratch,
        series=scratch + axle.work,
        n_numbers=n_numbers,
        n_plan=axle.plan.size,
        states=axle.sizes.states,
        others=axle.others,
        preload_g=int(place.preload_g),
        modal_damping=int(place.mesh.modal_damping),
        bearing_p=int(flatten(place.bearing_p)[0]),
        bearing_g=int(flatten(place.bearing_g)[0]),
    )
