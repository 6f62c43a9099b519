"""Outputs of the axle, gathered from what its train writes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from gearlube_core.arrays import Array, Offsets
from gearlube_core.dynamics.hypoid_axle.output_names import (
    AXLE_EFFICIENCY,
    AXLE_EFFICIENCY_BOUND,
    BEARING_LOSS,
    BEARING_QUANTITIES,
    BEARING_SHARE_OUTSIDE,
    BOUNDARY_LOSS,
    CHURNING_LOSS,
    DAMPING_LOSS,
    DRAG_LOSS_BOUND,
    EFFICIENCY,
    EFFICIENCY_BOUND,
    EVENT_INDICATORS,
    EVENTS,
    FILM_QUANTITIES,
    FRICTION_LOSS,
    HOLD_TORQUE,
    LOSS_BOUND,
    LOSS_HIGH,
    LOSS_LOW,
    N_BEARINGS,
    N_OUTPUTS,
    OUTPUT_NAMES,
    PINION_ACCELERATION,
    RATE_NAMES,
    RATES,
    ROLLING_LOSS,
    SEAL_LOSS,
    STATE_NAMES,
    WHEEL_ACCELERATION,
)
from gearlube_core.dynamics.hypoid_axle.state import W_G, W_P
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import FLANK_BOUNDS, FLANK_OUTPUTS
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshForceConstants
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.dynamics.train.assemble import Assembly
from gearlube_core.dynamics.train.element import W
from gearlube_core.dynamics.train.elements import held_port
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import (
    AT_KEPT,
    AT_X,
    KEPT_LOAD,
    force_at_load,
)
from gearlube_core.dynamics.train.elements.mesh_outputs import OWN
from gearlube_core.dynamics.train.outputs import IDLE_WORK, outputs_at, write_state
from gearlube_core.dynamics.train.plan import Sizes
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel

BODIES = {"pinion": "pinion", "wheel": "gear"}


def _bearing(j: int) -> str:
    return f"{'pinion' if j <= 2 else 'gear'} bearings.{'first' if j % 2 else 'second'}"


def _of_body(name: str) -> str:
    member, _, rest = name.partition(".")
    return f"{BODIES[member]}.{rest}"


# what stands in the outputs of the train, by its name there
_SHOWN: Mapping[str, str] = {
    **{
        f"{member}.{one}": f"{body}.{one}"
        for member, body in BODIES.items()
        for one in ("angle", "speed", "acceleration", *(f"displacement.{c}" for c in "xyz"))
    },
    **{
        f"mesh.{one}": f"mesh.{one}"
        for one in ("dte", "force", "separated", "stiffness", "frequency", "load_torque")
    },
    **{one: f"mesh.{one}" for one in (*FLANK_OUTPUTS, *FLANK_BOUNDS, *RANGE_OUTPUTS)},
    "film.share_outside": "mesh.film.share_outside",
    "friction.power_loss_boundary": "friction_boundary.power_loss",
    "friction.power_loss_rolling": "friction_rolling.power_loss",
    "friction.power_loss_bound": "friction_bound.power",
    "bearing.power_loss": "bearing_torque.power_loss",
    "bearing.power_loss_bound": "bearing_bound.power",
    "seal.power_loss": "seals.power_loss",
    "churning.power_loss": "churning.power_loss",
    **{
        f"bearing[{j}].{one}": f"{_bearing(j)}.{one}"
        for j in range(1, N_BEARINGS + 1)
        for one in (*BEARING_QUANTITIES, *FILM_QUANTITIES)
    },
    "bearing[1].roller[1].load": "pinion bearings.rollers.first_load",
    "energy.stored": "energy.stored",
}
# the continuous states of the axle, by their names among those of the train
STATES: Mapping[str, str] = {
    name: {
        "mesh.dte": "mesh.transmission_error",
        "bearing[1].cage.angle": "pinion bearings.cage.angle",
        "bearing[3].cage.angle": "gear bearings.cage.angle",
        "energy.pinion_work": "energy.input.work",
        "energy.wheel_work": "energy.output.work",
    }.get(name, _of_body(name) if name.partition(".")[0] in BODIES else name)
    for name in STATE_NAMES
}
AGAINST = ("energy.wheel_work", "der(energy.wheel_work)")  # a load takes work out
# behind the outputs: what some of them are made of
_SOURCES = (
    "friction_viscous.power_loss",
    "mesh_damping.power_loss",
    "bearing_damping.power_loss",
    "input.power",
    "output.power",
    "pinion bearings.rollers.load",
    "pinion bearings.rollers.share_outside",
    "gear bearings.rollers.load",
    "gear bearings.rollers.share_outside",
)
(
    _VISCOUS, _OF_MESH, _OF_BEARINGS, _PINION, _WHEEL,
    _LOAD_P, _SHARE_P, _LOAD_G, _SHARE_G, _DURATION,
) = range(N_OUTPUTS, N_OUTPUTS + len(_SOURCES) + 1)  # fmt: skip
N_GATHERED = N_OUTPUTS + len(_SOURCES) + 1
N_BAND = 64  # numbers of `loss_sensitivities`: eight losses in eight directions
NO_BAND = np.zeros(N_BAND)
_END, _WIDEST = 1.96, 7.0  # standard deviations that hold 95 %; of the logarithm of a band's end
_OF_INPUT = len(held_port.HeldPort.outputs)  # which come before those of the mesh
_NOWHERE = 0.5  # a place of an output that is made of others


def output_places(made: Assembly) -> Array:
    """Return where each output of the axle stands, for `gather_outputs`; pairs with a sign.

    A place of 0 and above is one in what WRITE leaves in `work`, one of -1 - i is place i of the
    state.
    """
    first = outputs_at(made.sizes)
    shown = {one.name: first + i for i, one in enumerate(made.outputs)}
    states = {one.record.name: one for one in made.continuous}
    places = {name: shown[of] for name, of in _SHOWN.items()}
    for name, rate in zip(STATE_NAMES, RATE_NAMES, strict=True):
        places[name] = -1 - states[STATES[name]].place
        places[rate] = states[STATES[name]].rate
    places["pinion.acceleration"], places["wheel.acceleration"] = W_P, W_G  # among the rates
    places[OUTPUT_NAMES[HOLD_TORQUE]] = -1 - (made.kept["input"] + held_port.HOLD_TORQUE)
    of_events = [one.place for one in made.events]
    places |= dict(zip(EVENT_INDICATORS, of_events, strict=True))
    found = [
        (float(places.get(name, _NOWHERE)), -1.0 if name in AGAINST else 1.0)
        for name in OUTPUT_NAMES
    ]
    found += [(float(shown[name]), 1.0) for name in _SOURCES]
    found.append((-float(made.sizes.states), 1.0))
    return np.array(found).ravel()


@inside
def _value(s: Array, work: Array, places: Array, i: int) -> float:
    place = places[2 * i]
    if place < 0.0:
        return places[2 * i + 1] * s[int(-1.0 - place)]
    return places[2 * i + 1] * work[int(place)]


@kernel
def _write_band(s: Array, work: Array, places: Array, band: Array, out: Array) -> None:
    """Write the ends of 95 % of the power lost in all; the power itself without a band.

    low, high = P exp(-+1.96 sd), sd^2 = sum over directions of (sum over losses of P_i s_i)^2/P^2
    """
    viscous, boundary = _value(s, work, places, _VISCOUS), out[BOUNDARY_LOSS]
    of_mesh, of_bearings = _value(s, work, places, _OF_MESH), _value(s, work, places, _OF_BEARINGS)
    total = viscous + boundary + of_mesh + of_bearings + out[BEARING_LOSS]
    total += out[CHURNING_LOSS] + out[SEAL_LOSS] + out[ROLLING_LOSS]
    variance = 0.0
    for k in range(0, N_BAND, 8):
        moved = band[k] * viscous + band[k + 1] * boundary + band[k + 2] * of_mesh
        moved += band[k + 3] * of_bearings + band[k + 4] * out[BEARING_LOSS]
        moved += band[k + 5] * out[CHURNING_LOSS] + band[k + 6] * out[SEAL_LOSS]
        moved += band[k + 7] * out[ROLLING_LOSS]
        variance += moved * moved
    wide = 1.0
    if total > 0.0:  # powers of damping may cancel others for an instant
        wide = math.exp(min(_END * math.sqrt(variance) / total, _WIDEST))
    out[LOSS_LOW], out[LOSS_HIGH] = total / wide, total * wide


@kernel
def _write_losses(s: Array, work: Array, places: Array, band: Array, out: Array) -> None:
    """Write what sums up powers, and efficiencies.

    Efficiency is 1 - loss/input with the work put in at the side that drives; 0 where no work is
    put in.

    References
    ----------
    [mohammadpour_2015 (20)] [mohammadpour_2015 (21)]
    """
    _write_band(s, work, places, band, out)
    duration = _value(s, work, places, _DURATION)
    friction = _value(s, work, places, _VISCOUS) + out[BOUNDARY_LOSS]
    damping = _value(s, work, places, _OF_MESH) + _value(s, work, places, _OF_BEARINGS)
    out[FRICTION_LOSS], out[DAMPING_LOSS] = friction, damping
    put_in = _value(s, work, places, _PINION)
    if put_in <= 0.0:
        put_in = _value(s, work, places, _WHEEL)
    out[EFFICIENCY] = out[AXLE_EFFICIENCY] = 0.0
    out[EFFICIENCY_BOUND] = out[AXLE_EFFICIENCY_BOUND] = 0.0
    if put_in > (IDLE_WORK * (1.0 / duration) if duration > 0.0 else IDLE_WORK):
        others = damping + out[BEARING_LOSS] + out[CHURNING_LOSS] + out[SEAL_LOSS]
        out[EFFICIENCY] = 1.0 - friction / put_in
        out[AXLE_EFFICIENCY] = 1.0 - (friction + (others + out[ROLLING_LOSS])) / put_in
        out[EFFICIENCY_BOUND] = out[LOSS_BOUND] / put_in
        out[AXLE_EFFICIENCY_BOUND] = (out[LOSS_BOUND] + out[DRAG_LOSS_BOUND]) / put_in


@kernel
def gather_outputs(s: Array, work: Array, places: Array, band: Array, out: Array) -> None:
    """Write all outputs, in the order of OUTPUT_NAMES, into `out` of shape (N_OUTPUTS,).

    Powers are means over the last step, as those of the train.

    Parameters
    ----------
    s : ndarray
        State of the train.
    work : ndarray
        As WRITE has left it.
    places : ndarray of shape (2 * N_GATHERED,)
        Of `output_places`.
    band : ndarray of shape (64,)
        Of `loss_sensitivities`, rows one after the other; `NO_BAND` for none.
    """
    for i in range(N_OUTPUTS):
        out[i] = _value(s, work, places, i)
    _write_losses(s, work, places, band, out)
    _write_share(s, work, places, out)


@kernel
def _write_share(s: Array, work: Array, places: Array, out: Array) -> None:
    """Write the share of the rollers' load outside the film model."""
    load_p, load_g = _value(s, work, places, _LOAD_P), _value(s, work, places, _LOAD_G)
    beyond = load_p * _value(s, work, places, _SHARE_P) + load_g * _value(s, work, places, _SHARE_G)
    load = load_p + load_g
    out[BEARING_SHARE_OUTSIDE] = beyond / load if load > 0.0 else 0.0


@kernel
def gather_group(s: Array, work: Array, places: Array, group: Offsets, out: Array) -> None:
    """Write the outputs at these places, of flanks or of bearings; the others stay."""
    for i in group:
        out[i] = _value(s, work, places, i)


@kernel
def gather_rates(s: Array, work: Array, places: Array, out: Array) -> None:
    """Write rates, accelerations and event indicators that EXCHANGE has left in `work`."""
    out[PINION_ACCELERATION] = _value(s, work, places, PINION_ACCELERATION)
    out[WHEEL_ACCELERATION] = _value(s, work, places, WHEEL_ACCELERATION)
    out[HOLD_TORQUE] = _value(s, work, places, HOLD_TORQUE)
    for i in range(RATES, EVENTS + len(EVENT_INDICATORS)):
        out[i] = _value(s, work, places, i)


@kernel
def gather_motion(
    s: Array,
    p: MeshForceConstants,
    at: Any,
    memory: Array,
    series: Array,
    numbers: Array,
    sizes: Sizes,
    work: Array,
    places: Array,
    band: Array,
    motion: Offsets,
    out: Array,
) -> None:
    """Write `MOTION_OUTPUTS` of a state that a step has left.

    Parameters
    ----------
    at, memory : tuple, ndarray
        Places and memory of the mesh.
    series : ndarray of shape (coefficients at a load,)
        Scratch memory, its values are lost.
    numbers, sizes
        Packed numbers and sizes of the train.
    motion : ndarray of int
        Places of `MOTION_OUTPUTS`.
    """
    first = write_state(s, part(work, 0, sizes.integrated), numbers, sizes, work)
    first += _OF_INPUT
    mesh, x = force_at_load(p, at, memory, s, series), s[at[AT_X]]
    work[first], work[first + 1] = x, mesh.stiffness
    work[first + 2] = 1.0 if -p.backlash < x < 0.0 else 0.0
    work[first + 4] = p.z_p * s[at[0] + W] / (2.0 * math.pi)
    work[first + 5] = s[at[AT_KEPT] + KEPT_LOAD]
    work[first + OWN] = mesh.force
    for i in motion:
        out[i] = _value(s, work, places, i)
    _write_losses(s, work, places, band, out)
