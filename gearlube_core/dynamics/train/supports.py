"""Which parts of a train nothing holds in place, so that it finds no rest."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.elements.housing_motion import CarriedInterface
from gearlube_core.dynamics.train.part import GROUND, Body, Element
from gearlube_core.errors import ParameterError

_TURNS_ALONE = frozenset({"port", "motor", "half_shaft", "differential", "seal", "churning"})
_MESHES = frozenset({"gear_mesh", "helical_mesh", "hypoid_mesh"})
_HOLDS_NOTHING = _TURNS_ALONE | _MESHES | {"orbit"}
_FORCELESS = 1e-10  # of the largest squared frequency: what differences leave
_MOVES = 0.03  # share of a coordinate in motions without force
_ENOUGH = 3  # meshes that can hold a body: x, y and its turning against a torque


def whole(name: str) -> str:
    """Return the body that has a node or modes of this name.

    Examples
    --------
    >>> whole("rotor.left"), whole("wheel")
    ('rotor', 'wheel')
    """
    return name.partition(".")[0]


def holds(element: Element) -> bool:
    """Return whether an element keeps bodies in place: bearings, springs and joints do.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.port import Port
    >>> holds(Port(name="motor", body="rotor"))
    False
    """
    return element.kind not in _HOLDS_NOTHING and not element.carries


def free_motions(stiffness: Array, mobility: Array, names: Sequence[str]) -> list[str]:
    """Return the bodies that can move without force, but for turning about z, and along what.

    Parameters
    ----------
    stiffness : ndarray of shape (m, m)
        M^-1 K of the free coordinates.
    mobility : ndarray of shape (m,)
        Their diagonal of M^-1.
    names : sequence of str
        Of the coordinates, as "rotor.x".

    Examples
    --------
    >>> free_motions(np.diag([1e8, 0.0, 0.0]), np.ones(3), ["rotor.x", "rotor.z", "rotor.rz"])
    ['rotor along z']
    """
    scale = np.sqrt(mobility)
    _, sizes, ways = np.linalg.svd(stiffness * scale / scale[:, None])
    free = np.linalg.norm(ways[sizes <= _FORCELESS * sizes[0]], axis=0) > _MOVES
    words = {"x": "along x", "y": "along y", "z": "along z", "rx": "about x", "ry": "about y"}
    moved = [name.rpartition(".") for name, one in zip(names, free, strict=True) if one]
    return [f"{body} {words[way]}" for body, _, way in moved if way in words and "." not in body]


def check_supports(bodies: Sequence[Body], elements: Sequence[Element]) -> None:
    """Raise ParameterError where bodies in mesh find no rest, whatever the loads.

    No bearing, spring or joint leads from them to the ground, and fewer than three meshes to other
    bodies: each holds one of the three motions in a plane. A sun between three planets may float.
    A body that holds x is as the ground, and so is a housing that is fixed somewhere.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
    >>> rotors = [Body(name=one, mass=1.0, inertia=0.1, polar_inertia=0.1) for one in ("a", "b")]
    >>> gears = {"teeth_1": 20, "teeth_2": 40, "normal_module": 0.005, "face_width": 0.05}
    >>> pair = GearMesh(name="pair", first="a", second="b", backlash=1e-4, **gears)
    >>> check_supports(rotors, [pair])
    Traceback (most recent call last):
    gearlube_core.errors.ParameterError: a must be held in place, got no ...
    """
    links = [{GROUND, one.name} for one in bodies if "x" in one.held and "." not in one.name]
    links += [
        # an element without a housing or second body stands on the ground
        {whole(getattr(one, field)) for field in one.on} | ({GROUND} if len(one.on) == 1 else set())
        for one in elements
        if holds(one)
    ]
    links += [
        {GROUND, whole(one.nodes)}
        for one in elements
        if isinstance(one, CarriedInterface) and all(one.motion.stiffness > 0.0)
    ]
    meshes = [  # their first two fields are those of the gears
        {whole(getattr(one, field)) for field in one.on[:2]}
        for one in elements
        if one.kind in _MESHES
    ]
    groups = {name: {name} for name in (GROUND, *(whole(one.name) for one in bodies))}
    for link in links:
        joined = set[str]().union(*(groups[name] for name in link))
        groups |= dict.fromkeys(joined, joined)
    for name, group in groups.items():
        touching = [mesh for mesh in meshes if mesh & group]
        outside = sum(not mesh <= group for mesh in touching)
        if GROUND not in group and touching and outside < _ENOUGH:
            named = ", ".join(one for one in groups if one in group)
            raise ParameterError(
                f"{named} must be held in place, got no bearing, spring or joint that leads from "
                f"{name} to the ground, and {outside} mesh(es) with other bodies, of which "
                f"{_ENOUGH} could hold it. Give it a bearing, or its housing a mount."
            )
