"""Planetary sets as lists of bodies and elements: of Lin and Parker 1999, and a helical one."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from gearlube_core.dynamics.train.choice import Driver
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.gear_geometry import fitting_angle
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.oil.lubricant import Lubricant

OIL = Lubricant.named("mohammadpour_2015")
KELVIN = 333.15
FLAT = ("z", "rx", "ry")  # held by bodies that move in a plane


def planetary(
    planets: int,
    bodies: Mapping[str, Body],
    gears: Mapping[str, Any],
    stiffness: tuple[float, float],
    supports: Mapping[str, Mapping[str, float]],
    twists: Mapping[str, float],
    *,
    errors: Sequence[float] = (),
    driver: Driver = "automatic",
    held: Sequence[str] = (),
    more: Sequence[Element] = (),
    mesh: Mapping[str, Any] | None = None,
    keyed: bool = False,
) -> Train:
    """Return sun, ring, carrier and equal planets at equal distances.

    `gears` has the fields that both meshes share, `stiffness` those of sun and ring mesh, `twists`
    stiffness against ground about z. `supports` of the planet are its pins, `errors` their place
    errors along the orbit, one for each planet. `keyed` planets have their teeth between those of
    the sun; so they do where the mesh has a `keyed_angle`, which is that of the sun.
    """
    z_s, z_p = gears["teeth"]
    shared = {name: value for name, value in gears.items() if name != "teeth"}
    shared |= {"backlash": 1e-4, "face_width": 0.03, "carrier": "carrier"} | dict(mesh or {})
    radius = 0.5 * (z_s + z_p) * gears["normal_module"] / math.cos(gears.get("helix_angle", 0.0))
    hand, angle = gears.get("right_hand", False), shared.pop("keyed_angle", 0.0)
    shared.pop("right_hand", None)
    central = [bodies[name] for name in ("sun", "ring", "carrier")]
    found: list[Body] = [*central]
    parts: list[Element] = [
        Joint(name=f"{one.name} bearing", first=one.name, second="ground", **supports[one.name])
        for one in central
    ]
    parts += [
        HalfShaft(name=f"{name} twist", first=name, second="ground", stiffness=k)
        for name, k in twists.items()
    ]
    parts += [Port(name=f"{one.name} torque", body=one.name) for one in central]
    for n in range(planets):
        azimuth, name = 2.0 * math.pi * n / planets, f"p{n + 1}"
        body = bodies["planet"]
        found.append(
            Body(name=name, mass=body.mass, inertia=body.inertia,
                 polar_inertia=body.polar_inertia, held=body.held)
        )  # fmt: skip
        tooth = fitting_angle(z_s, z_p, angle, azimuth) if keyed or angle else 0.0
        error = errors[n] if errors else 0.0
        parts += [
            Orbit(name=f"{name} orbit", body=name, carrier="carrier", mass=body.mass,
                  radius=radius, azimuth=azimuth),
            Joint(name=f"{name} pin", first=name, second="carrier", radius=radius,
                  azimuth=azimuth, error_y=error, **supports["planet"]),
            GearMesh(name=f"{name} sun", first="sun", second=name, teeth_1=z_s, teeth_2=z_p,
                     azimuth=azimuth, stiffness=stiffness[0], right_hand=hand, keyed_angle=angle,
                     **shared),
            GearMesh(name=f"{name} ring", first=name, second="ring", teeth_1=z_p,
                     teeth_2=z_s + 2 * z_p, azimuth=azimuth, ring=True, drives_forward=False,
                     stiffness=stiffness[1], right_hand=not hand,
                     keyed_angle=tooth, **shared),
        ]  # fmt: skip
    return Train(found, [*parts, *more], OIL, driver=driver)


class FlatSet(NamedTuple):
    """A set whose bodies move in a plane, as printed: its coordinates of turning are lengths.

    They are rotations times base radius, of the carrier times the radius of the pins, so that any
    radii serve: those of 30, 30 and 90 teeth.
    """

    bodies: Mapping[str, tuple[float, float]]  # mass, inertia over radius squared [kg]
    supports: Mapping[str, float]  # [N/m]
    twists: Mapping[str, float]  # [N/m]
    mesh: float  # [N/m]
    pressure_angle: float  # [rad]
    sun_radius: float  # base [m]


LIN_PARKER_1999 = FlatSet(
    {"sun": (0.4, 0.39), "ring": (2.35, 3.0), "carrier": (5.43, 6.29), "planet": (0.66, 0.61)},
    {"sun": 1e8, "ring": 1e8, "carrier": 1e8, "planet": 1e8},
    {"ring": 1e9},
    5e8,
    math.radians(24.6),
    38.7e-3,
)
COOLEY_PARKER_2012 = FlatSet(
    {"sun": (3.0, 1.75), "ring": (7.64, 8.09), "carrier": (12.0, 6.80), "planet": (1.86, 1.25)},
    {"sun": 20e6, "ring": 100e6, "carrier": 50e6, "planet": 10e6},
    {"sun": 20e6, "ring": 100e6, "carrier": 100e6},
    100e6,
    math.radians(20.0),
    27.875e-3,
)


def flat_set(
    planets: int,
    given: FlatSet = LIN_PARKER_1999,
    *,
    held: Sequence[str] = (),
    damper: float = 0.0,
    **more: Any,
) -> Train:
    """Return a set with so many planets; the carrier holds the coordinates `held` too.

    `damper` is that of all supports and pins along x and y [N s/m].
    """
    cos = math.cos(given.pressure_angle)
    base = {"sun": 1.0, "planet": 1.0, "ring": 3.0, "carrier": 2.0 / cos}
    base = {name: share * given.sun_radius for name, share in base.items()}
    bodies = {
        name: Body(name=name, mass=m, inertia=1.0, polar_inertia=i * base[name] ** 2,
                   held=(*FLAT, *(held if name == "carrier" else ())))
        for name, (m, i) in given.bodies.items()
    }  # fmt: skip
    gears = {
        "teeth": (30, 30),
        "normal_module": given.sun_radius / cos / 15.0,
        "normal_pressure_angle": given.pressure_angle,
    }
    supports = {
        name: {"K_xx": k, "K_yy": k, "c_x": damper, "c_y": damper}
        for name, k in given.supports.items()
    }
    twists = {name: k * base[name] ** 2 for name, k in given.twists.items()}
    return planetary(planets, bodies, gears, (given.mesh, given.mesh), supports, twists, **more)


def helical_set(planets: int, **given: Any) -> Train:
    """Return a helical set whose numbers are invented; its oracle was computed apart."""
    angle, module = math.radians(20.0), 2e-3
    table = {"carrier": (6.0, 9.784578e-3), "ring": (2.5, 2.063934e-2),
             "sun": (0.5, 2.548068e-4), "planet": (0.7, 3.924024e-4)}  # fmt: skip
    bodies = {
        name: Body(name=name, mass=m, inertia=0.6 * i, polar_inertia=i)
        for name, (m, i) in table.items()
    }
    springs = {"carrier": (1e8, 5e7, 1e5), "ring": (1e9, 1e9, 1e6), "sun": (2e7, 1e7, 2e4),
               "planet": (2e8, 1e8, 2e4)}  # fmt: skip
    supports = {
        name: {"K_xx": k, "K_yy": k, "K_zz": k_z, "K_ax": k_a, "K_ay": k_a}
        for name, (k, k_z, k_a) in springs.items()
    }
    gears = {"teeth": (30, 30), "normal_module": module, "helix_angle": angle,
             "right_hand": True}  # fmt: skip
    return planetary(planets, bodies, gears, (3e8, 3.5e8), supports, {"ring": 5e6}, **given)
