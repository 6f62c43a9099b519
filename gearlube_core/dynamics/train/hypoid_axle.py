"""The hypoid axle of Mohammadpour et al. 2015 as a list of bodies and elements."""

from __future__ import annotations

from gearlube_core.dynamics.hypoid_axle.mesh_force import reference_frequency
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.dynamics.train.elements.drag import Churning, Seal
from gearlube_core.dynamics.train.elements.hypoid_mesh import HypoidMesh
from gearlube_core.dynamics.train.elements.opposed_bearings import OpposedBearings
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.part import Body, Element

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
