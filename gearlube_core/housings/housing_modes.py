"""Modes of a housing, and checks that its model is a housing in the units that it names."""

from __future__ import annotations

import itertools
import logging
import math
from typing import NamedTuple

import numpy as np
import scipy.linalg

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.housings.reduced_model import LENGTHS, MASSES, ReducedModel
from gearlube_core.shafts.free_modes import kept_shapes

logger = logging.getLogger(__name__)

_HELD = 1e-5  # share of the stiffness against a rigid motion of a free model: seven digits
_SINGULAR = 1e-12  # of the largest stiffness
_FASTEST = 2.0 * math.pi * 1e9  # rad/s, of what has no mass
_RESIDUAL_SHARE = 1e-9  # of the own flexibility of a coordinate; remaining shapes with less go
_COUPLED = 0.1  # share of damping between modes that is worth a warning
# what a housing can be
_MASS = 1e-3, 1e5  # kg
_RADIUS = 1e-3, 10.0  # m, of gyration
_DENSITY = 20.0, 1e6  # kg/m3, mass over the cube of that radius: thin plastic to solid steel
_FIRST = 1.0, 1e6  # Hz


class HousingMotion(NamedTuple):
    """A housing by its modes, each with a modal mass of the housing's mass."""

    mass: float  # [kg]
    shapes: Array  # (modes, nodes with a name, 6): x, y, z [-], rx, ry, rz [rad/m]
    stiffness: Array  # of each mode [N/m], 0 for rigid ones
    damping: Array  # [N s/m]


def housing_motion(
    model: ReducedModel,
    free: bool,
    highest_frequency: float,
    damping_ratio: float = 0.0,
    name: str = "housing",
) -> HousingMotion:
    """Return the modes of a housing at those of its nodes that have a name.

    Modes above the limit give their static flexibility at these nodes, see `free_modes`.

    Parameters
    ----------
    model : ReducedModel
    free : bool
        Whether six rigid motions cost no force.
    highest_frequency : float
        [Hz]; 0: the housing is rigid.
    damping_ratio : float
        Of the elastic modes [-], where the model has no damping.
    name : str
        Name used in error messages.

    Raises
    ------
    ParameterError
        A free model is held, another one is singular, or mass, size and first frequency are none
        of a housing, so that units are wrong.

    Examples
    --------
    >>> from gearlube_core.housings.reduced_model import InterfaceNode
    >>> held = ReducedModel(
    ...     stiffness=np.diag([4e8, 1e8, 1e8]),
    ...     mass=np.eye(3),
    ...     nodes=[InterfaceNode("bore", 0.0, 0.0, 0.0)],
    ...     owner=np.zeros(3, int),
    ...     direction=np.arange(3),
    ... )
    >>> motion = housing_motion(held, False, 1e4)
    >>> bool(np.allclose(motion.stiffness, [1e8, 1e8, 4e8]))
    True
    """
    given, model = model, model.si()
    rigid = model.rigid_motions()
    mass = _plausible_mass(given, rigid, free, name)
    least = np.diag(model.stiffness)
    if least.min() <= 0.0:
        raise ParameterError(
            f"stiffness of {name} must hold every coordinate, got {least.min():g} on the diagonal "
            f"for {model.coordinate(int(least.argmin()))}. Leave it out of the reduction."
        )
    scale = 1.0 / np.sqrt(least)
    stiffness = model.stiffness * np.outer(scale, scale)
    _check_rigid(stiffness, rigid / scale[:, None], free, name)
    ways = np.diag(scale)
    if free:
        # the motions without momentum
        ways = ways @ scipy.linalg.qr((model.mass @ rigid) * scale[:, None])[0][:, 6:]
        rigid = rigid @ np.linalg.inv(np.linalg.cholesky(rigid.T @ model.mass @ rigid)).T
    else:
        rigid = rigid[:, :0]
    squares, shapes = _elastic(model, ways, name)
    _check_first(squares, name)
    if highest_frequency == 0.0:
        squares, shapes = squares[:0], shapes[:, :0]
    named = [i for i, one in enumerate(model.nodes) if one.name]
    loaded = np.flatnonzero(np.isin(model.owner, named))
    kept = kept_shapes(squares, shapes, loaded, highest_frequency, _RESIDUAL_SHARE)
    all_squares = np.append(np.zeros(rigid.shape[1]), kept.squares)
    whole = np.hstack([rigid, kept.shapes])
    at_nodes = np.zeros((all_squares.size, len(model.nodes), 6))
    at_nodes[:, model.owner[loaded], model.direction[loaded]] = whole[loaded].T
    damping = 2.0 * damping_ratio * np.sqrt(all_squares)
    if model.damping is not None:
        damping = _projected(whole.T @ model.damping @ whole, name)
    return HousingMotion(
        mass, math.sqrt(mass) * at_nodes[:, named], mass * all_squares, mass * damping
    )


def _elastic(model: ReducedModel, ways: Array, name: str) -> tuple[Array, Array]:
    """Return squares of frequencies, rising, and shapes of modal mass 1 in a space of motions."""
    stiffness, mass = (ways.T @ one @ ways for one in (model.stiffness, model.mass))
    values, vectors = np.linalg.eigh(stiffness)
    if values.size and values[0] < _SINGULAR * values[-1]:
        row = int(abs(ways @ vectors[:, 0]).argmax())
        raise ParameterError(
            f"stiffness of {name} must hold all motions but rigid ones of a free housing, got "
            f"{values[0] / values[-1]:.1e} of the largest for one of mainly "
            f"{model.coordinate(row)}. Set free if the model floats; else a part of it is loose."
        )
    # by flexibility: there may be coordinates without mass
    slow, shapes = scipy.linalg.eigh(mass, stiffness)
    slow = np.maximum(slow[::-1], _FASTEST**-2.0)
    return 1.0 / slow, (ways @ shapes[:, ::-1]) / np.sqrt(slow)


def _check_rigid(stiffness: Array, rigid: Array, free: bool, name: str) -> None:
    """Raise ParameterError where rigid motions cost force and should not."""
    force = np.linalg.norm(stiffness @ rigid, axis=0)
    whole = np.linalg.norm(abs(stiffness) @ abs(rigid), axis=0)
    share = force / np.where(whole > 0.0, whole, 1.0)
    worst = int(share.argmax())
    words = ("along x", "along y", "along z", "about x", "about y", "about z")[worst]
    if free and share[worst] > _HELD:
        raise ParameterError(
            f"stiffness of {name} must not hold a free housing, got forces of {share[worst]:.2g} "
            f"of its scale in a rigid motion {words}, at most {_HELD:g}. Set free to false if the "
            "model is fixed somewhere; else check the nodes' places and their unit, which must be "
            "that of the matrices."
        )
    if not free and share[worst] <= _HELD:
        raise ParameterError(
            f"{name} must be held by its model, got one that floats. Set free to true, and give it "
            "mounts."
        )


def _plausible_mass(given: ReducedModel, rigid: Array, free: bool, name: str) -> float:
    """Return the mass [kg]; raise ParameterError where it and the size are none of a housing."""
    inertia = rigid.T @ given.si().mass @ rigid
    mass = float(np.diag(inertia)[:3].max())
    held = np.linalg.pinv(inertia[:3, :3], hermitian=True)
    about = inertia[3:, 3:] - inertia[3:, :3] @ held @ inertia[:3, 3:]
    radius = math.sqrt(max(float(np.linalg.eigvalsh(about)[-1]), 0.0) / mass) if mass > 0.0 else 0.0
    if not free:  # a part of the mass alone moves with the nodes
        places = np.array([one[1:] for one in given.nodes]) * LENGTHS[given.length_unit]
        radius = float(np.ptp(places, axis=0).max())
    if _is_plausible(mass, radius, free):
        return mass
    length, unit = LENGTHS[given.length_unit], MASSES[given.mass_unit]
    others = [
        f'length_unit = "{a}" and mass_unit = "{b}" give {mass * MASSES[b] / unit:.3g} kg and '
        f"{radius * LENGTHS[a] / length:.3g} m"
        for a, b in itertools.product(LENGTHS, MASSES)
        if _is_plausible(mass * MASSES[b] / unit, radius * LENGTHS[a] / length, free)
    ]
    size = "radius of gyration" if free else "largest distance of nodes"
    cure = "; ".join(others) or "No unit explains that: check the matrices and the nodes' places"
    raise ParameterError(
        f"{name} must have {_MASS[0]:g} to {_MASS[1]:g} kg and a {size} of at most {_RADIUS[1]:g} "
        f"m that fits it, got {mass:.3g} kg and {radius:.3g} m. {cure}."
    )


def _is_plausible(mass: float, radius: float, free: bool) -> bool:
    fits = _MASS[0] <= mass <= _MASS[1] and radius <= _RADIUS[1]
    if free:
        dense = _DENSITY[0] * radius**3 <= mass <= _DENSITY[1] * radius**3
        fits = fits and dense and radius >= _RADIUS[0]
    return fits


def _check_first(squares: Array, name: str) -> None:
    first = math.sqrt(squares[0]) / (2.0 * math.pi) if squares.size else _FIRST[0]
    if not _FIRST[0] <= first <= _FIRST[1]:
        raise ParameterError(
            f"the first elastic mode of {name} must have {_FIRST[0]:g} to {_FIRST[1]:g} Hz, got "
            f"{first:.3g} Hz. Stiffness and mass must be of one system of units: N/m with kg, or "
            "N/mm with t."
        )


def _projected(damping: Array, name: str) -> Array:
    """Return the damping of each mode, without that between modes."""
    own = np.maximum(np.diag(damping), 0.0)
    between = float(np.linalg.norm(damping - np.diag(own)))
    whole = float(np.linalg.norm(damping))
    if between > _COUPLED * whole:
        logger.warning(
            "%s: damping between its modes, %.0f %% of all, is left out. Damping ratios for all "
            "modes are then as good: leave the damping matrix out.",
            name,
            100.0 * between / whole,
        )
    return own
