"""Corrections of a film model kept between two evaluations of a time step.

Evaluating the model takes longer than all else of a flank. Its corrections change slowly with the
turning of the teeth, so most of the time they are carried on linearly from the last evaluation.
"""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.film_model.solved_film import FilmCorrections
from gearlube_core.kernels.jit import kernel

# places in what is kept of one contact
_VALUES = 0  # corrections
_SLOPES = 3  # their slopes with the angle [1/rad]
_ANGLE = 6  # where they were evaluated [rad]
_BOUND = 7  # of the friction there, relative [-]
N_KEPT = 8
_NOTHING = -1.0  # in place of the share outside: nothing is kept
_MOST = 0.05  # that a correction may be carried on, so that a shock cannot throw it


@kernel
def forget(kept: Array) -> None:
    """Mark that nothing is kept; `kept` has the shape (N_KEPT,)."""
    kept[_VALUES + 2] = _NOTHING


@kernel
def is_kept(kept: Array) -> bool:
    """Whether corrections are kept."""
    return bool(kept[_VALUES + 2] >= 0.0)


@kernel
def keep(kept: Array, now: FilmCorrections, angle: float, with_slope: bool) -> None:
    """Keep corrections at an angle [rad], with their slopes since the last ones if wanted."""
    turned = angle - kept[_ANGLE]
    use = with_slope and is_kept(kept) and turned != 0.0
    for i in range(3):
        kept[_SLOPES + i] = (now[i] - kept[_VALUES + i]) / turned if use else 0.0
        kept[_VALUES + i] = now[i]
    kept[_ANGLE] = angle


@kernel
def carried(kept: Array, angle: float) -> FilmCorrections:
    """Return the kept corrections carried on to an angle [rad]."""
    turned = angle - kept[_ANGLE]
    film = min(max(kept[_SLOPES] * turned, -_MOST), _MOST)
    friction = min(max(kept[_SLOPES + 1] * turned, -_MOST), _MOST)
    outside = min(max(kept[_VALUES + 2] + kept[_SLOPES + 2] * turned, 0.0), 1.0)
    return FilmCorrections(kept[_VALUES] + film, kept[_VALUES + 1] + friction, outside)


@kernel
def keep_bound(kept: Array, bound: float) -> None:
    """Keep the relative bound of the friction."""
    kept[_BOUND] = bound


@kernel
def kept_bound(kept: Array) -> float:
    """Return the relative bound of the friction that is kept."""
    return float(kept[_BOUND])
