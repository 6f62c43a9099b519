"""The hypoid axle of Mohammadpour et al. 2015 as a list of bodies and elements."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import without_loss
from gearlube_core.dynamics.hypoid_axle.output_names import N_OUTPUTS, OUTPUT_NAMES
from gearlube_core.dynamics.hypoid_axle.train_outputs import (
    NO_BAND,
    gather_outputs,
    output_places,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import reference_frequency
from gearlube_core.dynamics.hypoid_mesh.parameters import (
    MARCH_WITH_WARM_FLANKS,
    HypoidAxleParameters,
)
from gearlube_core.dynamics.train.assemble import Assembly
from gearlube_core.dynamics.train.elements.drag import Churning, Seal
from gearlube_core.dynamics.train.elements.held_port import HeldPort, SpeedHolder
from gearlube_core.dynamics.train.elements.hypoid_mesh import HypoidMesh
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import AT_MEANS
from gearlube_core.dynamics.train.elements.opposed_bearings import OpposedBearings
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.oil.lubricant import Lubricant

_PINION_AXES = (2, 1, 0)  # the shaft lies along x; z is turned towards y in the drive direction


def hypoid_axle(
    parameters: HypoidAxleParameters, holder: SpeedHolder | None = None
) -> tuple[list[Body], list[Element]]:
    """Return the bodies and elements of an axle, in the frame of `HypoidAxle`.

    Ports are "input" on the pinion, whose speed `holder` may hold, and "output", a load on the
    gear.

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
            cage_moment=given.equations == "consistent",
        )
        for name, bearing, orders, axes in zip(
            ("pinion", "gear"), given.bearings, teeth, (_PINION_AXES, (0, 1, 2)), strict=True
        )
    ]
    drags: list[Element] = [
        Seal(name="pinion seal", body="pinion", torque=given.pinion_seal_torque),
        Seal(name="wheel seals", body="gear", torque=given.wheel_seal_torque),
        Seal(name="wheel hubs", body="gear", torque=given.hub_torque),
        Churning(
            name="sump",
            body="gear",
            law=given.churning,
            ring_diameter=given.ring_diameter,
            ring_width=given.ring_width,
            immersion=given.immersion,
            oil_volume=given.oil_volume,
        ),
    ]
    ports = [
        HeldPort(name="input", body="pinion", holder=holder or SpeedHolder()),
        Port(name="output", body="gear", sign=-1.0),
    ]
    return bodies, [*ports, mesh, *bearings, *drags]


def numbers_at_rest(
    elements: list[Element],
    made: Assembly,
    oil: Lubricant,
    *,
    hysteresis: bool = False,
    cages: bool = False,
) -> Array:
    """Return the numbers of an axle's train without losses: what is in static equilibrium.

    Parameters
    ----------
    elements, made
        Of `hypoid_axle`, and put together.
    oil : Lubricant
    hysteresis : bool
        Whether mesh and rollers keep theirs.
    cages : bool
        Whether shafts carry the moment on their cages, which turns on with the cages.
    """
    found = [flatten(oil.parameters())]
    for one in elements:
        given: Any = one.numbers_among(made.bodies)
        if isinstance(one, HypoidMesh):
            given = given._replace(friction=0.0)
        if isinstance(one, OpposedBearings):
            given = given._replace(law=0.0, on_cage=given.on_cage if cages else 0.0)
        if isinstance(one, HypoidMesh) and not hysteresis:
            mesh = given.mesh._replace(hysteretic_loss=0.0)
            given = given._replace(mesh=mesh, rolling=0.0)
        if isinstance(one, OpposedBearings) and not hysteresis:
            given = given._replace(bearings=without_loss(given.bearings))
        if isinstance(one, Seal):
            given = given._replace(torque=0.0)
        if isinstance(one, Churning):
            given = given._replace(gear=given.gear._replace(law=0.0))
        found.append(flatten(given))
    return np.concatenate([*found, made.numbers[made.sizes.first_mobility :]])


def memory_of_means(made: Assembly) -> Array:
    """Return the memory of an axle's train whose periodic data are held at their means."""
    memory = made.memory.copy()
    memory[AT_MEANS] = 1.0  # the mesh comes first of all that have memory
    return memory


def axle_train(parameters: HypoidAxleParameters) -> Train:
    """Return the axle as a train that moves as `HypoidAxle`: `hypoid_axle` with its oil.

    Its ports are "input" and "output"; give its start speed to "pinion" or "gear".

    Raises
    ------
    ParameterError
        Flanks that warm up: the train has none.

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
    if given.flank_bulk_resistance > 0.0:
        raise ParameterError(f"{MARCH_WITH_WARM_FLANKS} Got {given.flank_bulk_resistance:g} K/W.")
    bodies, elements = hypoid_axle(given)
    steps = given.steps_per_highest_period
    return Train(bodies, elements, given.oil, steps_per_highest_period=steps)


def axle_values(train: Train) -> dict[str, float]:
    """Return all outputs of `HypoidAxle` in the present state of its train, SI units, by name.

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
    made, out = train.assembly, np.zeros(N_OUTPUTS)
    gather_outputs(*train.written(), output_places(made), NO_BAND, out)
    return dict(zip(OUTPUT_NAMES, out.tolist(), strict=True))
