"""Where the theory of thin films between half-spaces has ended."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array

THICKEST_FILM = 0.01  # smallest film over the radius [-]
FARTHEST_PRESSURE = 0.5  # from the middle, over the radius [-]
_PRESSED = 0.01  # share of the largest pressure that counts


def thick_film_words(what: str, share: float) -> str:
    """Return that a film is too thick for its radius, `share` of it [-], or an empty string."""
    if share > THICKEST_FILM:
        return f"{what} is {share:.2g} of the radius, above {THICKEST_FILM:g}"
    return ""


def thin_film_sentence(
    pressure: Array, film: Array, places: tuple[Array, ...], radii: tuple[float, ...]
) -> str:
    """Return a warning where thin-film theory has ended, else an empty string.

    Parameters
    ----------
    pressure, film : ndarray
        On the nodes [Pa], [m], one axis for each array of `places`.
    places
        Of the nodes along each axis, from the middle of the contact [m].
    radii
        Relative radius along each axis [m]; infinite for a straight one.

    Notes
    -----
    Reynolds' equation neglects the square of the gap's slope. Half of the pressure is made within
    x = (2 R h)^(1/2), where the slope is (2 h/R)^(1/2): 0.14 at h = 0.01 R, whose square is 2 %.
    At x = 0.5 R the gap of a circle is 7 % above that of the parabola that stands for it, and
    solids that press on so wide an area are no half-spaces ([johnson_1985] ch. 4 has a << R). These
    limits are where the neglected terms reach some per cent, not where films stop.

    Examples
    --------
    >>> x = np.array([-1e-3, 0.0, 1e-3])
    >>> thin_film_sentence(np.array([0.0, 1e5, 0.0]), np.full(3, 2e-4), (x,), (0.01,))
    ' Thin-film theory has ended: the smallest film is 0.02 of the radius, above 0.01.'
    """
    thick = thick_film_words("the smallest film", float(film.min()) / min(radii))
    found = [thick] if thick else []
    pressed = pressure > _PRESSED * pressure.max()
    for axis, (x, radius) in enumerate(zip(places, radii, strict=True)):
        other = tuple(n for n in range(pressed.ndim) if n != axis)
        far = float(np.abs(x[pressed.any(axis=other)]).max(initial=0.0)) / radius
        if far > FARTHEST_PRESSURE:
            found.append(
                f"pressure reaches {far:.2g} of the radius along {'xy'[axis]}, beyond "
                f"{FARTHEST_PRESSURE:g}"
            )
    return f" Thin-film theory has ended: {' and '.join(found)}." if found else ""
