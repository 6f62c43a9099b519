"""Which parts of a train nothing holds in place, to name them where it finds no rest."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from gearlube_core.dynamics.train.part import GROUND, Body, Element

_TURNS_ALONE = frozenset({"port", "motor", "half_shaft", "differential", "seal", "churning"})
_MESHES = frozenset({"gear_mesh", "helical_mesh", "hypoid_mesh"})
_HOLDS_NOTHING = _TURNS_ALONE | _MESHES | {"orbit"}


def whole(name: str) -> str:
    """Return the body that has a node or modes of this name.

    Examples
    --------
    >>> whole("rotor.left"), whole("wheel")
    ('rotor', 'wheel')
    """
    return name.partition(".")[0]


def unsupported(bodies: Iterable[Body], elements: Sequence[Element]) -> list[str]:
    """Return bodies from which no bearing, spring or joint leads to the ground.

    A body that holds x is as the ground. Meshes alone can hold a body, such as a sun that floats:
    this explains a rest that is not found, and forbids nothing.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
    >>> rotors = [Body(name=one, mass=1.0, inertia=0.1, polar_inertia=0.1) for one in ("a", "b")]
    >>> unsupported(rotors, [SpringSupport(name="springs", body="a", K_xx=1e8)])
    ['b']
    """
    listed = list(bodies)
    held = {GROUND} | {whole(one.name) for one in listed if "x" in one.held and "." not in one.name}
    links = [
        # an element without a housing or second body stands on the ground
        {whole(getattr(one, field)) for field in one.on} | ({GROUND} if len(one.on) == 1 else set())
        for one in elements
        if one.kind not in _HOLDS_NOTHING and not one.carries
    ]
    reached = True
    while reached:
        reached = False
        for link in links:
            if link & held and not link <= held:
                held |= link
                reached = True
    return [one for one in dict.fromkeys(whole(body.name) for body in listed) if one not in held]
