"""Motion of a free shaft: rigid, with its modes below a limit and the flexibility of all others.

What the modes above the limit add to the static flexibility at the nodes stays, as shapes of its
own. Their frequencies would be far above the limit and ask for short steps; they get 1.5 times
the limit. So statics are exact. Below a tenth of the limit frequencies of a long shaft on bearings
are right to 1e-5, those of a short one, which has no mode below it, to 1e-4.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy.linalg

from gearlube_core.arrays import Array, Indices
from gearlube_core.shafts.beam import Beam

_PLANE = 2  # rigid motions in a plane: it shifts and tilts
_RESIDUAL_RATIO = 1.5  # frequency of the remaining shapes over the limit
# of a coordinate's own flexibility; shapes with less are left out: of bending, of all others
_RESIDUAL_SHARES = (1e-5, 1e-3)


class Modes(NamedTuple):
    """Shapes at the nodes, each with a modal mass of the shaft's mass, so that they have metres.

    Shapes are (modes, nodes).
    """

    stiffness: Array  # of each [N/m]
    deflection: Array  # [-]; of torsion the angle [rad/m]
    slope: Array  # [rad/m]; zero for axial and torsional modes


class ShaftMotion(NamedTuple):
    """A shaft as a rigid body with modes.

    `gyroscopic` couples both planes, (1 + bending modes) squared, its first row and column those of
    the tilt: times the speed it gives moments and modal forces from the rates of the other plane.
    """

    mass: float  # [kg]
    centre: float  # of mass along z [m]
    inertia: float  # about a diameter through it [kg m2]
    polar_inertia: float
    arms: Array  # of the nodes along z, from the centre of mass [m]
    bending: Modes
    axial: Modes
    torsion: Modes
    gyroscopic: Array


class Shapes(NamedTuple):
    """Squares of frequencies, whole shapes of modal mass 1, (coordinates, modes)."""

    squares: Array
    shapes: Array


def shaft_motion(beam: Beam, nodes: Array, highest_frequency: float) -> ShaftMotion:
    """Return the motion of a free beam at its nodes.

    Parameters
    ----------
    beam : Beam
    nodes : ndarray of shape (n,)
        Their places along z, which are places of the beam [m].
    highest_frequency : float
        Modes above it [Hz] give their static flexibility alone; 0: the shaft is rigid.

    Examples
    --------
    >>> from gearlube_core.shafts.beam import shaft_beam
    >>> from gearlube_core.shafts.section import ShaftMaterial, ShaftSection
    >>> tube = [ShaftSection(start=0.0, end=1.0, outer_diameter=0.05)]
    >>> beam = shaft_beam(tube, [], [], ShaftMaterial(), 0.02)
    >>> motion = shaft_motion(beam, np.array([0.0, 1.0]), 2e3)
    >>> first = math.sqrt(motion.bending.stiffness[0] / motion.mass) / (2.0 * math.pi)
    >>> round(first, 1)  # Hz, free at both ends
    226.5
    """
    at = np.argmin(abs(beam.places[:, None] - nodes[None, :]), axis=0)
    n, bending = beam.places.size, beam.bending
    along = np.zeros(2 * n)
    along[::2] = 1.0
    turned = np.ones(2 * n)
    turned[::2] = beam.places
    mass = float(along @ bending.mass @ along)
    centre = float(along @ bending.mass @ turned) / mass
    turned[::2] -= centre
    ones = np.ones(n)
    loaded = np.append(2 * at, 2 * at + 1)  # by forces and by moments
    bends = _kept(bending.stiffness, bending.mass, loaded, _PLANE, highest_frequency)
    scale = math.sqrt(mass)
    of_tilts = np.column_stack([turned, scale * bends.shapes])
    axial = _kept(beam.axial_stiffness, beam.axial_mass, at, 1, highest_frequency)
    torsion = _kept(beam.torsion_stiffness, beam.torsion_inertia, at, 1, highest_frequency)
    return ShaftMotion(
        mass=mass,
        centre=centre,
        inertia=float(turned @ bending.mass @ turned),
        polar_inertia=float(ones @ beam.torsion_inertia @ ones),
        arms=np.asarray(nodes, float) - centre,
        bending=Modes(
            mass * bends.squares, scale * bends.shapes[2 * at].T, scale * bends.shapes[2 * at + 1].T
        ),
        axial=_along(axial, at, mass),
        torsion=_along(torsion, at, mass),
        gyroscopic=2.0 * of_tilts.T @ bending.tilting @ of_tilts,
    )


def _along(kept: Shapes, at: Array, mass: float) -> Modes:
    shapes = math.sqrt(mass) * kept.shapes[at].T
    return Modes(mass * kept.squares, shapes, np.zeros_like(shapes))


def _kept(
    stiffness: Array, mass: Array, loaded: Indices, rigid: int, highest_frequency: float
) -> Shapes:
    """Return modes below the limit with the shapes of the remaining flexibility."""
    if highest_frequency == 0.0:
        return Shapes(np.zeros(0), np.zeros((mass.shape[0], 0)))
    squares, shapes = scipy.linalg.eigh(stiffness, mass)
    squares, shapes = squares[rigid:], shapes[:, rigid:]
    share = _RESIDUAL_SHARES[0 if rigid == _PLANE else 1]
    return kept_shapes(squares, shapes, loaded, highest_frequency, share)


def kept_shapes(
    squares: Array, shapes: Array, loaded: Indices, highest_frequency: float, share: float
) -> Shapes:
    """Return elastic modes below a limit with the shapes of the remaining flexibility.

    Parameters
    ----------
    squares : ndarray of shape (m,)
        Of the frequencies of all elastic modes [rad2/s2].
    shapes : ndarray of shape (coordinates, m)
        Of modal mass 1.
    loaded : ndarray of int
        Coordinates on which loads act.
    highest_frequency : float
        The limit [Hz].
    share : float
        Of the own elastic flexibility of a coordinate [-]; remaining shapes with less are left out.

    Examples
    --------
    >>> squares = np.array([1.0, 1e6])
    >>> kept = kept_shapes(squares, np.ones((1, 2)), np.array([0]), 1.0, 1e-9)
    >>> bool(np.isclose((kept.shapes[0] ** 2 / kept.squares).sum(), 1.0 + 1e-6))
    True
    """
    limit = (2.0 * math.pi * highest_frequency) ** 2
    below = squares <= limit
    above, rest = squares[~below], shapes[:, ~below]
    own = np.sqrt((shapes[loaded] ** 2 / squares).sum(axis=1, keepdims=True))
    at_nodes = rest[loaded] / np.where(own > 0.0, own, 1.0)  # so that forces and moments compare
    found, ways = np.linalg.eigh((at_nodes / above) @ at_nodes.T)
    chosen = found > share
    moved = ((at_nodes / above).T @ ways[:, chosen]) / np.sqrt(found[chosen])  # of stiffness 1
    lowered = np.minimum(1.0 / (moved**2).sum(axis=0), _RESIDUAL_RATIO**2 * limit)
    residual = (rest @ moved) * np.sqrt(lowered)
    return Shapes(np.append(squares[below], lowered), np.hstack([shapes[:, below], residual]))
