"""What a film model gave for a contact, kept between its evaluations in a time step.

Evaluating the model takes longer than all else of a flank. Its corrections, and the friction
coefficients that follow, change slowly while the teeth turn. So most of the time they are carried
on: linearly in the angle of the pinion, from the last evaluation with the slope since the one before.
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
_LOAD = 5  # there; 0: they cannot be carried on [N]
_COEFFICIENTS = 6  # viscous and boundary friction over load, slopes, where they hold, load or 0
_N_COEFFICIENTS = 6
_BOUND = _COEFFICIENTS + _N_COEFFICIENTS  # of the friction, relative [-]
N_KEPT = _BOUND + 1
# How much the load may change before what is kept is no longer carried on, relative. A pair that
# comes into contact passes pressures where film and friction change fast.
_CORRECTION_REACH = 0.1
_COEFFICIENT_REACH = 0.05
_MOST = 0.05  # that a correction may be carried on, so that a shock cannot throw it


@kernel
def forget(kept: Array) -> None:
    """Mark that nothing is kept; `kept` has the shape (N_KEPT,)."""
    kept[_LOAD] = 0.0
    kept[_COEFFICIENTS + 5] = 0.0


@kernel
def can_carry(kept: Array, load: float) -> bool:
    """Whether there are corrections that hold for a load [N] too.

    The contact that they are of lay inside the model's domain.
    """
    return bool(abs(load - kept[_LOAD]) < _CORRECTION_REACH * kept[_LOAD])


@kernel
def keep_corrections(
    kept: Array, now: FilmCorrections, load: float, angle: float, with_slope: bool
) -> None:
    """Keep corrections under a load [N] at an angle [rad], with slopes since the last if wanted.

    Those of a contact outside the domain are not carried on: there the share outside changes fast.
    """
    turned = angle - kept[_ANGLE]
    use = with_slope and kept[_LOAD] > 0.0 and turned != 0.0
    kept[_FILM_SLOPE] = (now.film - kept[_FILM]) / turned if use else 0.0
    kept[_FRICTION_SLOPE] = (now.friction - kept[_FRICTION]) / turned if use else 0.0
    kept[_FILM] = now.film
    kept[_FRICTION] = now.friction
    kept[_ANGLE] = angle
    kept[_LOAD] = load if now.outside == 0.0 else 0.0


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


@kernel
def keep_coefficients(
    kept: Array, viscous: float, boundary: float, load: float, angle: float, with_slope: bool
) -> None:
    """Keep viscous and boundary friction over load [-], as `keep_corrections`."""
    own = kept[_COEFFICIENTS : _COEFFICIENTS + _N_COEFFICIENTS]
    turned = angle - own[4]
    use = with_slope and own[5] > 0.0 and turned != 0.0
    own[2] = (viscous - own[0]) / turned if use else 0.0
    own[3] = (boundary - own[1]) / turned if use else 0.0
    own[0] = viscous
    own[1] = boundary
    own[4] = angle
    own[5] = load


@kernel
def can_carry_coefficients(kept: Array, load: float) -> bool:
    """Whether there are friction coefficients that hold for a load [N] too."""
    of_load = kept[_COEFFICIENTS + 5]
    return bool(abs(load - of_load) < _COEFFICIENT_REACH * of_load)


@kernel
def carried_coefficients(kept: Array, angle: float) -> tuple[float, float]:
    """Return viscous and boundary friction over load [-], carried on to an angle [rad]."""
    own = kept[_COEFFICIENTS : _COEFFICIENTS + _N_COEFFICIENTS]
    turned = angle - own[4]
    return max(own[0] + own[2] * turned, 0.0), max(own[1] + own[3] * turned, 0.0)
