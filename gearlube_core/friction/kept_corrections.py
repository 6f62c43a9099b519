"""Corrections of a film model, kept between two evaluations within a time step.

Evaluating the model takes longer than all else of a flank, and its corrections change slowly while
the teeth turn. Within a step they are carried on, linearly in the angle of the pinion.
"""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.film_model.solved_film import FilmCorrections
from gearlube_core.kernels.jit import kernel

# places in what is kept of one contact
_FILM = 0  # corrections of film and friction, their slopes [1/rad], and where they hold [rad]
_FRICTION = 1
_FILM_SLOPE = 2
_FRICTION_SLOPE = 3
_ANGLE = 4
_INSIDE = 5  # 1: the contact lay inside the model's domain; else 0, and nothing can be carried on
_BOUND = 6  # of the friction, relative [-]
N_KEPT = 7
_MOST = 0.05  # that a correction may be carried on, so that a shock cannot throw it


@kernel
def forget(kept: Array) -> None:
    """Mark that nothing is kept; `kept` has the shape (N_KEPT,)."""
    kept[_INSIDE] = 0.0


@kernel
def can_carry(kept: Array) -> bool:
    """Whether there are corrections to carry on."""
    return bool(kept[_INSIDE] != 0.0)


@kernel
def keep_corrections(kept: Array, now: FilmCorrections, angle: float, with_slope: bool) -> None:
    """Keep corrections at an angle [rad], with their slopes since the last ones if wanted.

    Those of a contact outside the domain are not carried on: there the share outside changes fast.
    """
    turned = angle - kept[_ANGLE]
    use = with_slope and can_carry(kept) and turned != 0.0
    kept[_FILM_SLOPE] = (now.film - kept[_FILM]) / turned if use else 0.0
    kept[_FRICTION_SLOPE] = (now.friction - kept[_FRICTION]) / turned if use else 0.0
    kept[_FILM] = now.film
    kept[_FRICTION] = now.friction
    kept[_ANGLE] = angle
    kept[_INSIDE] = 1.0 if now.outside == 0.0 else 0.0


@kernel
def carried_corrections(kept: Array, angle: float) -> FilmCorrections:
    """Return the kept corrections carried on to an angle [rad]."""
    turned = angle - kept[_ANGLE]
    film = min(max(kept[_FILM_SLOPE] * turned, -_MOST), _MOST)
    friction = min(max(kept[_FRICTION_SLOPE] * turned, -_MOST), _MOST)
    return FilmCorrections(kept[_FILM] + film, kept[_FRICTION] + friction, 0.0)


@kernel
def keep_bound(kept: Array, bound: float) -> None:
    """Keep the relative bound of the friction."""
    kept[_BOUND] = bound


@kernel
def kept_bound(kept: Array) -> float:
    """Return the relative bound of the friction that is kept."""
    return float(kept[_BOUND])
