"""The kernels that Python and C call: the start, one communication step, the outputs of a state.

They take the parameters as one flat array, whose meaning depends on the type of the bearings
and on the law of flank friction. So they are made once for each pair of these; every kernel below
takes any `AxleParameters`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftBearings
from gearlube_core.dynamics.hypoid_axle.continuous import change_side
from gearlube_core.dynamics.hypoid_axle.force_derivatives import (
    force_derivatives,
    write_step_control,
)
from gearlube_core.dynamics.hypoid_axle.integrate import (
    DIVERGED_UM,
    NOT_FINITE,
    OK,
    TOO_FAST,
    StepControl,
    advance,
)
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARING_SHARE_OUTSIDE,
    FIRST_BEARING_FILM,
    write_raceways,
)
from gearlube_core.dynamics.hypoid_axle.outputs import (
    raceways_of,
    write_bearing_group,
    write_derivatives,
    write_flank_group,
    write_motion_after_step,
    write_outputs,
)
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, mesh_motion
from gearlube_core.dynamics.hypoid_axle.start import rest
from gearlube_core.dynamics.hypoid_axle.state import (
    CAGE_G,
    CAGE_P,
    DRAG_BOUND,
    FILM_NODES,
    FRICTION_BOUND,
    LOAD_TORQUE,
    N_ENERGIES,
    N_ODE,
    N_STATE,
    PHI_G,
    PHI_P,
    PINION_WORK,
    SIDE,
    TIME_IN_STEP,
    W_G,
    W_P,
    WORK_MARK,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.flanks import FILMS
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshFields,
    blend_mesh,
    mesh_levels,
    place_at_load,
    series_size,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import mesh_force
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS
from gearlube_core.dynamics.mean_power import LEAST_WINDOW, keep_means
from gearlube_core.dynamics.ranges import MAX_ANGLE, MAX_SPEED, TOO_FAR
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import lubricant_state

OF_FLANKS, OF_BEARINGS, OF_RACEWAYS = range(3)  # groups of outputs


class AxleKernels(NamedTuple):
    """Compiled functions of an axle with one type of bearing and one law of flank friction."""

    static_state: Callable[..., tuple[int, float]]
    step_control: Callable[..., int]
    derivatives: Callable[..., None]
    communication_step: Callable[..., int]
    step_without_outputs: Callable[..., int]
    motion_outputs: Callable[..., None]
    group_outputs: Callable[..., None]
    outputs: Callable[..., None]
    continuous_rates: Callable[..., None]
    event: Callable[..., None]


@kernel
def state_status(s: Array) -> int:
    """Return OK, or why the model says nothing of a state: NOT_FINITE, TOO_FAST or TOO_FAR."""
    if not abs(s[X]) <= DIVERGED_UM:
        return NOT_FINITE
    if not max(abs(s[W_P]), abs(s[W_G])) <= MAX_SPEED:
        return TOO_FAST
    angle = max(abs(s[PHI_P]), abs(s[PHI_G]), abs(s[CAGE_P]), abs(s[CAGE_G]))
    return OK if angle <= MAX_ANGLE else TOO_FAR


@cache
def axle_kernels(bearing: type[ShaftBearings], law: type[FlankLaw]) -> AxleKernels:
    """Return the compiled step and outputs of an axle with these bearings and flanks.

    Parameters
    ----------
    bearing : type
        The bearing type, a NamedTuple class; see `bearing_type.ShaftBearings`.
    law : type
        The law of flank friction, likewise; see `flank_law.FlankLaw`.
    """

    @kernel
    def static_state(
        s: Array,
        speed: float,
        inputs: Array,
        mesh: MeshFields,
        lossless: Array,
        work: Array,
    ) -> tuple[int, float]:
        """Write the static equilibrium into `s`; return a status and the largest error [N].

        Parameters
        ----------
        lossless : ndarray
            Flattened AxleParameters without losses.

        Others as in `start.rest`; inputs, mesh as in `communication_step`.
        """
        p: AxleParameters = tuple_from_array(lossless, AxleParameters, bearing, law)
        return rest(s, speed, inputs[0], inputs[2], mesh_levels(*mesh), p, work)

    @kernel
    def step_control(
        s: Array,
        steps_per_mesh_period: float,
        steps_per_highest_period: float,
        inputs: Array,
        mesh: MeshFields,
        lossless: Array,
        work: Array,
        control_values: Array,
    ) -> int:
        """Write the flattened StepControl about the equilibrium `s`; return a status.

        Arguments as in `static_state` and `force_derivatives.write_step_control`.
        """
        p: AxleParameters = tuple_from_array(lossless, AxleParameters, bearing, law)
        return write_step_control(
            s,
            steps_per_mesh_period,
            steps_per_highest_period,
            inputs[0],
            inputs[2],
            mesh_levels(*mesh),
            p,
            work,
            control_values,
        )

    @kernel
    def derivatives(
        s: Array,
        of_speeds: float,
        torque: float,
        oil_temperature: float,
        mesh: MeshFields,
        parameters: Array,
        work: Array,
        matrix: Array,
    ) -> None:
        """Write derivatives of the forces into `matrix`, as in `force_derivatives`."""
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        table = mesh_levels(*mesh)
        force_derivatives(s, of_speeds, torque, oil_temperature, table, p, work, matrix)

    @kernel
    def step_without_outputs(
        s: Array,
        trial: Array,
        duration: float,
        inputs: Array,
        mesh: MeshFields,
        parameters: Array,
        control_values: Array,
        work: Array,
    ) -> int:
        """Advance the axle by `duration` [s]; arguments and status as in `communication_step`."""
        table = mesh_levels(*mesh)
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        control: StepControl = tuple_from_array(control_values, StepControl)
        torques = (inputs[0], inputs[1])
        for i in range(N_STATE):
            trial[i] = s[i]
        status = state_status(s)
        if status == OK:
            status = advance(trial, duration, torques, inputs[2], table, p, control, work)
        if status == OK:
            status = state_status(trial)
        if status == OK:
            if duration < LEAST_WINDOW:
                keep_means(s, trial, PINION_WORK, WORK_MARK, N_ENERGIES, TIME_IN_STEP)
                trial[FRICTION_BOUND], trial[DRAG_BOUND] = s[FRICTION_BOUND], s[DRAG_BOUND]
            for i in range(N_STATE):
                s[i] = trial[i]
        return status

    @kernel
    def outputs(
        s: Array,
        inputs: Array,
        mesh: MeshFields,
        parameters: Array,
        work: Array,
        rollers: Array,
        out: Array,
    ) -> None:
        """Write the outputs of the state `s`; arguments as in `communication_step`."""
        table = mesh_levels(*mesh)
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        torques = (inputs[0], inputs[1])
        write_outputs(s, torques, inputs[2], table, p, work, rollers, out)

    @kernel
    def communication_step(
        s: Array,
        trial: Array,
        duration: float,
        inputs: Array,
        mesh: MeshFields,
        parameters: Array,
        control_values: Array,
        work: Array,
        rollers: Array,
        out: Array,
    ) -> int:
        """Advance the axle by `duration` [s] and write its outputs; return a status.

        Parameters
        ----------
        s, trial : ndarray of shape (N_STATE,)
            State, unchanged when the status is not OK; work space.
        inputs : ndarray of shape (3,)
            Torques of pinion and wheel [N.m], oil temperature [K].
        mesh : tuple
            Fields of `MeshLevels`.
        parameters, control_values : ndarray
            Flattened AxleParameters and StepControl.

        Others as in `advance` and `write_outputs`.
        """
        status = step_without_outputs(
            s, trial, duration, inputs, mesh, parameters, control_values, work
        )
        if status == OK:
            outputs(s, inputs, mesh, parameters, work, rollers, out)
        return status

    @kernel
    def motion_outputs(
        s: Array, mesh: MeshFields, parameters: Array, work: Array, out: Array
    ) -> None:
        """Write `MOTION_OUTPUTS` of the state that a step has left, as in `outputs`."""
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        write_motion_after_step(s, mesh_levels(*mesh), p, work, out)

    @kernel
    def group_outputs(
        group: int,
        s: Array,
        inputs: Array,
        mesh: MeshFields,
        parameters: Array,
        work: Array,
        rollers: Array,
        out: Array,
    ) -> None:
        """Write group OF_FLANKS, OF_BEARINGS or OF_RACEWAYS of a state that a step has left.

        Other arguments as in `outputs`.
        """
        table = mesh_levels(*mesh)
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        oil = lubricant_state(p.oil, inputs[2], table.laws)
        at_series = N_ODE + SCRATCH
        at_window = at_series + series_size(table)
        scratch = work[N_ODE:at_series]
        if group == OF_RACEWAYS:
            raceways = raceways_of(s, oil, p, table.roller_model, scratch)
            write_raceways(raceways, FIRST_BEARING_FILM, BEARING_SHARE_OUTSIDE, out)
            return
        data = place_at_load(table, work[at_series:at_window], work[at_window:])
        blend_mesh(s[LOAD_TORQUE], s[SIDE], table, data)
        force = mesh_force(mesh_motion(s), data.series, data.n_orders, p.mesh)
        if group == OF_BEARINGS:
            write_bearing_group(s, force.stiffness, oil, p, rollers, out)
            return
        if data.film_model.size > 0:
            for i in range(N_FILMS):
                scratch[FILMS + i] = s[FILM_NODES + i]
        write_flank_group(s, force.force, inputs[2], oil, data, p, scratch, out)

    @kernel
    def continuous_rates(
        s: Array, inputs: Array, mesh: MeshFields, parameters: Array, work: Array, out: Array
    ) -> None:
        """Write rates and event indicators as in `write_derivatives`; arguments as in `outputs`."""
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        table = mesh_levels(*mesh)
        write_derivatives(s, (inputs[0], inputs[1]), inputs[2], table, p, work, out)

    @kernel
    def event(s: Array, mesh: MeshFields, parameters: Array, work: Array) -> None:
        """Take the other side's mesh data if the teeth have crossed, as in `change_side`."""
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        change_side(s, mesh_levels(*mesh), p.mesh, work)

    return AxleKernels(
        static_state,
        step_control,
        derivatives,
        communication_step,
        step_without_outputs,
        motion_outputs,
        group_outputs,
        outputs,
        continuous_rates,
        event,
    )
