"""The hypoid axle of Mohammadpour et al. 2015 as a list of bodies and elements.

`axle_train` moves as `HypoidAxle`, and `axle_values` are the outputs under the names of that class.
"""

from __future__ import annotations

from collections.abc import Mapping

from gearlube_core.dynamics.hypoid_axle.continuous import EVENT_INDICATORS, RATE_NAMES, STATE_NAMES
from gearlube_core.dynamics.hypoid_axle.model import MARCH_WITH_WARM_FLANKS
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARING_QUANTITIES,
    FILM_QUANTITIES,
    N_BEARINGS,
    OUTPUT_NAMES,
)
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import FLANK_BOUNDS, FLANK_OUTPUTS
from gearlube_core.dynamics.hypoid_mesh.mesh_force import reference_frequency
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.dynamics.train.elements.drag import Churning, Seal
from gearlube_core.dynamics.train.elements.hypoid_mesh import HypoidMesh
from gearlube_core.dynamics.train.elements.opposed_bearings import OpposedBearings
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.outputs import IDLE_WORK
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.errors import ParameterError

_BODY = {"pinion": "pinion", "wheel": "gear"}


def _bearing(j: int) -> str:
    return f"{'pinion' if j <= 2 else 'gear'} bearings.{'first' if j % 2 else 'second'}"


def _of_body(name: str) -> str:
    member, _, rest = name.partition(".")
    return f"{_BODY[member]}.{rest}"


# what stands in the outputs of the train, by its name there
OUTPUTS: Mapping[str, str] = {
    **{
        f"{member}.{one}": f"{body}.{one}"
        for member, body in _BODY.items()
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
    }.get(name, _of_body(name) if name.partition(".")[0] in _BODY else name)
    for name in STATE_NAMES
}
_MEAN_OVER = -3  # place in `Train.get_state` of the length of the step that powers are over [s]
_AGAINST = ("energy.wheel_work",)  # what counts the other way: a load takes work out

_PINION_AXES = (2, 1, 0)  # the shaft lies along x; z is turned towards y in the drive direction


def hypoid_axle(parameters: HypoidAxleParameters) -> tuple[list[Body], list[Element]]:
    """Return the bodies and elements of an axle, in the frame of `HypoidAxle`.

    Ports are "input" on the pinion and "output", a load on the gear.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> bodies, elements = hypoid_axle(mohammadpour_2015_axle())
    >>> [one.name for one in elements[:4]]
    ['input', 'output', 'mesh', 'pinion bearings']
    """
    given, held = parameters, ("rx", "ry")
    bodies = [
        Body(name=name, mass=mass, inertia=1.0, polar_inertia=inertia, held=held)
        for name, mass, inertia in (
            ("pinion", given.pinion_mass, given.pinion_inertia),
            ("gear", given.gear_mass, given.gear_inertia),
        )
    ]
    mesh = HypoidMesh(
        name="mesh", pinion="pinion", gear="gear", parameters=given, torque_of="input"
    )
    at_rest = reference_frequency(given.kernel_parameters().mesh, 0.0)
    teeth = float(given.mesh.pinion_teeth), float(given.mesh.gear_teeth)
    bearings = [
        OpposedBearings(
            name=f"{name} bearings",
            body=name,
            bearing=bearing,
            torque_loss=given.bearing_torque_loss,
            film_model=given.roller_film_model,
            orders=orders,
            least_frequency=at_rest,
            steps_per_highest_period=given.steps_per_highest_period,
            axes=axes,
        )
        for name, bearing, orders, axes in zip(
            ("pinion", "gear"), given.bearings, teeth, (_PINION_AXES, (0, 1, 2)), strict=True
        )
    ]
    drags: list[Element] = [
        Seal(name="pinion seal", body="pinion", torque=given.pinion_seal_torque),
        Seal(name="wheel seals", body="gear", torque=given.wheel_seal_torque),
    ]
    if given.churning != "none":
        drags.append(
            Churning(
                name="sump",
                body="gear",
                law=given.churning,
                ring_diameter=given.ring_diameter,
                ring_width=given.ring_width,
                immersion=given.immersion,
                oil_volume=given.oil_volume,
            )
        )
    ports = [
        Port(name="input", body="pinion"),
        Port(name="output", body="gear", sign=-1.0),
    ]
    return bodies, [*ports, mesh, *bearings, *drags]


def axle_train(parameters: HypoidAxleParameters) -> Train:
    """Return the axle as a train that moves as `HypoidAxle`: `hypoid_axle` with its oil.

    Its ports are "input" and "output"; give its start speed to "pinion" or "gear".

    Raises
    ------
    ParameterError
        Equations as printed, or flanks that warm up: the train has neither.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> train = axle_train(mohammadpour_2015_axle())
    >>> train.initialise({"pinion": 209.4}, {"input": 50.0, "output": 140.0}, 333.15)
    >>> train.step(1e-4, {"input": 50.0, "output": 140.0}, 333.15)
    >>> round(axle_values(train)["pinion.speed"])  # rad/s
    209
    """
    given = parameters
    if given.equations != "consistent":
        raise ParameterError(
            f"equations of an axle as a train must be consistent, got {given.equations!r}, which "
            "leave out the moment of the cages. Take `HypoidAxle` for those."
        )
    if given.flank_bulk_resistance > 0.0:
        raise ParameterError(f"{MARCH_WITH_WARM_FLANKS} Got {given.flank_bulk_resistance:g} K/W.")
    bodies, elements = hypoid_axle(given)
    steps = given.steps_per_highest_period
    return Train(bodies, elements, given.oil, steps_per_highest_period=steps)


def axle_values(train: Train) -> dict[str, float]:
    """Return all outputs of `HypoidAxle` in the present state of its train, SI units, by name.

    Before the first step films are those at the nodes of the mesh table, where `HypoidAxle` has
    those of the contacts themselves.

    Parameters
    ----------
    train : Train
        As `axle_train` returns it.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> train = axle_train(mohammadpour_2015_axle())
    >>> train.initialise({"pinion": 209.4}, {"input": 50.0, "output": 140.0}, 333.15)
    >>> round(1e-3 * axle_values(train)["mesh.force"], 1)  # kN
    2.4
    """
    shown, now = train.outputs(), train.continuous
    index = {name: i for i, name in enumerate(train.continuous_names)}
    rates, indicators = train.derivative(now), train.indicators(now)
    found = {name: shown.get(of, 0.0) for name, of in OUTPUTS.items()}
    for name, rate in zip(STATE_NAMES, RATE_NAMES, strict=True):
        at, sign = index.get(STATES[name]), -1.0 if name in _AGAINST else 1.0
        # without a sump there is no churning
        found[name] = 0.0 if at is None else sign * float(now[at])
        found[rate] = 0.0 if at is None else sign * float(rates[at])
    found |= dict(zip(EVENT_INDICATORS, indicators.tolist(), strict=True))
    friction = shown["friction_viscous.power_loss"] + shown["friction_boundary.power_loss"]
    found["friction.power_loss"] = friction
    damping = shown["mesh_damping.power_loss"] + shown["bearing_damping.power_loss"]
    found["damping.power_loss"] = damping
    _add_efficiencies(found, shown, float(train.get_state()[_MEAN_OVER]))
    loads = [shown[f"{body} bearings.rollers.load"] for body in _BODY.values()]
    shares = [shown[f"{body} bearings.rollers.share_outside"] for body in _BODY.values()]
    beyond = sum(load * share for load, share in zip(loads, shares, strict=True))
    found["bearing.share_outside"] = beyond / sum(loads) if sum(loads) > 0.0 else 0.0
    return {name: found[name] for name in OUTPUT_NAMES}


def _add_efficiencies(found: dict[str, float], shown: Mapping[str, float], over: float) -> None:
    """Add efficiencies and their bounds; 0 where no work is put in, as in `write_losses`."""
    pinion, wheel = shown["input.power"], shown["output.power"]
    put_in = pinion if pinion > 0.0 else wheel
    others = ("damping", "bearing", "churning", "seal")
    lost = sum(found[f"{one}.power_loss"] for one in others) + found["friction.power_loss_rolling"]
    friction, bound = found["friction.power_loss"], found["friction.power_loss_bound"]
    works = put_in > (IDLE_WORK / over if over > 0.0 else IDLE_WORK)
    found["efficiency"] = 1.0 - friction / put_in if works else 0.0
    found["axle.efficiency"] = 1.0 - (friction + lost) / put_in if works else 0.0
    found["efficiency_bound"] = bound / put_in if works else 0.0
    both = bound + found["bearing.power_loss_bound"]
    found["axle.efficiency_bound"] = both / put_in if works else 0.0
