"""Pressure that lifts a film off the few nodes where a trial has left none."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.terms.solids import NoContact, TouchingSolids
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.transient.level import MovingLevel

_MOST_NODES = 0.05  # share of the nodes with pressure; more are no peaks of roughness
_CALLS = 12
_SHARE = 0.7  # of what is missing, in one call: neighbours lift each other
_BEYOND = 1.5  # the least film, which is aimed at


def lifted(level: MovingLevel, state: FilmState, least: Array | float) -> FilmState | None:
    """Return the state with pressure added where its film is too thin.

    Parameters
    ----------
    level
        Grid.
    state
        A trial; its film may be below zero.
    least : ndarray, shape (ny, nx), or float
        Film that every node should have [-].

    Returns
    -------
    FilmState or None
        None: more than a few nodes are too thin, or they are still after twelve calls.

    Notes
    -----
    A linearised film overshoots at peaks. To shorten the step everywhere for their sake, or to part
    the solids, costs far more steps than to press these peaks down by themselves.
    """
    pressure, film = state.pressure.copy(), state.film
    own, limit = level.grid.own_deflection, np.broadcast_to(least, film.shape)
    few = _MOST_NODES * np.count_nonzero(pressure > 0.0)
    for _ in range(_CALLS):
        low = film < limit
        count = np.count_nonzero(low)
        if count == 0:
            return level.state(pressure, state.approach)
        if count > few:
            return None
        pressure[low] += _SHARE * (_BEYOND * limit - film)[low] / own[low]
        film = level.film(pressure, state.approach)
    return None


def lifted_off_solids(level: MovingLevel, state: FilmState) -> FilmState:
    """Return the state lifted where solids press on each other far more than the pressure says.

    Parameters
    ----------
    level
        Grid.
    state
        A trial; its film is above zero.

    Returns
    -------
    FilmState
        As given where no node, or more than a few, are pressed too far.

    Notes
    -----
    The pressure of a layer rises with the second power of 1/h: a Newton step that left a node with
    too thin a film is followed by steps that each make it thicker by a third or so. Such nodes get
    the film at which their layer carries the pressure, at once.
    """
    contact, solids = state.contact, level.terms.solids
    if isinstance(contact, NoContact) or not isinstance(solids, TouchingSolids):
        return state
    carrying = solids.layer.film(np.maximum(state.pressure, 0.0))
    least = np.where(contact.left < 0.0, carrying / _BEYOND, 0.0)
    if not (state.film < least).any():
        return state
    return lifted(level, state, least) or state
