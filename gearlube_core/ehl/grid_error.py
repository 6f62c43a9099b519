"""Errors of a film's grid and domain, from the same film on coarser grids and a wider domain."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol, Self, TypeVar

import numpy as np
from scipy.interpolate import interpn

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within

SECOND_ORDER = 2.0  # of pressure, deflection and all wedges but `upwind-1`
FIRST_ORDER = 1.0
SAFETY = 2.0  # where three grids go one way
SAFETY_OTHERWISE = 3.0  # on two grids, or where the third turns back
LARGE_ERROR = 0.05  # relative grid error above which a solution warns [-]
FEWEST_NODES = 17  # of a coarser grid along a side
COARSER_GRIDS = 2
SAFETY_DOMAIN = 2.0  # twice the size takes half of an error that falls with the first power


class FilmNumbers(NamedTuple):
    """Film quantities whose grid error is estimated; NaN where unknown."""

    central_film: float  # [m]
    minimum_film: float  # [m]
    maximum_pressure: float  # [Pa]
    friction: float  # coefficient of friction [-]


_UNKNOWN = FilmNumbers(*4 * (math.nan,))
_NAMES = ("central film", "smallest film", "largest pressure", "friction")


class OnGrid(Protocol):
    """A film on a grid of `nodes`, with those on coarser grids of which its error is estimated."""

    @property
    def nodes(self) -> tuple[int, ...]:
        """Number of nodes along each side."""

    @property
    def axes(self) -> tuple[Array, ...]:
        """Places of the nodes along each side [m]."""

    @property
    def pressure(self) -> Array:
        """Pressure on the nodes [Pa]."""

    @property
    def numbers(self) -> FilmNumbers:
        """Film quantities whose grid error is estimated."""

    @property
    def formal_order(self) -> float:
        """Order of its grid."""

    @property
    def converged(self) -> bool:
        """Whether it is a solution."""

    @property
    def coarser(self) -> tuple[Self, ...]:
        """The same film on coarser grids, finest first."""

    @property
    def wider(self) -> Self | None:
        """The last of these on a domain twice as wide, of the same spacing; None: not known."""


def formal_order(wedge: str) -> float:
    """Return the order of a film's grid with a stencil of the wedge."""
    return FIRST_ORDER if wedge == "upwind-1" else SECOND_ORDER


def estimated_error(
    values: Sequence[float], ratio: float = 2.0, formal: float = SECOND_ORDER
) -> float:
    """Return the relative error of a value on the finest of several grids [-].

    E = s max(d_1, d_2/r^q)/(r^p - 1),  d_k = |f_k - f_(k+1)|,  p = log(d_2/d_1)/log r

    Parameters
    ----------
    values
        Of one quantity, finest grid first: two or three.
    ratio
        r, spacing of a grid over that of the next finer one [-].
    formal
        q, order of the discretisation: 1 or 2.

    Returns
    -------
    float
        Over the value on the finest grid; not a number where a value is not known or there is
        one grid alone.

    Notes
    -----
    The grid convergence index of [roache_1994] with the observed order p held between 1 and q. A
    difference that is small by chance counts as large as the one before it would leave at order
    q. s is 2, and 3 where the values do not go one way or there are two grids, with p = q. With s =
    1.25, as he has it, it would bound the true error of fewer than 19 in 20 contacts; see
    docs/film_error.md.

    Examples
    --------
    A value that converges at second order to 1: twice its true error.

    >>> round(estimated_error([1.01, 1.04, 1.16]), 4)
    0.0198
    """
    used = [float(value) for value in values[:3]]
    if len(used) < 2 or not all(map(math.isfinite, used)):
        return math.nan
    if used[0] == 0.0:
        return 0.0 if not any(used) else math.nan
    last, before = abs(used[0] - used[1]), 0.0
    safety, order = SAFETY_OTHERWISE, formal
    if len(used) == 3:
        before = abs(used[1] - used[2])
        if (used[0] - used[1]) * (used[1] - used[2]) >= 0.0:
            safety = SAFETY
        last = max(last, before / ratio**formal)
        seen = math.log(max(before / last, 1.0)) / math.log(ratio) if last > 0.0 else formal
        order = min(max(seen, FIRST_ORDER), formal)
    return safety * last / (ratio**order - 1.0) / abs(used[0])


def peak_error(fine: OnGrid, coarse: OnGrid) -> float:
    """Return how far above the largest pressure any node may come, over it [-].

    max(p + |p - p_c|)/max p - 1, with the pressure p_c of the coarser grid between its nodes

    Notes
    -----
    A narrow spike behind the contact hardly shows on a grid whose largest pressure lies
    elsewhere, and may pass it on the next one. Each node counts as if its pressure converged at
    first order.
    """
    places = np.stack(np.meshgrid(*fine.axes, indexing="ij"), axis=-1)
    # a graded grid of half the nodes may end a rounding error earlier, rows of cells half a cell
    for side, axis in enumerate(coarse.axes):
        places[..., side] = np.clip(places[..., side], axis[0], axis[-1])
    beside = interpn(coarse.axes, coarse.pressure, places)
    most = float(fine.pressure.max())
    return float((fine.pressure + np.abs(fine.pressure - beside)).max()) / most - 1.0


@dataclass(frozen=True, slots=True)
class FilmError:
    """Estimated relative errors of grid and domain [-]; not a number: not known.

    The domain's are twice the differences to a film on a domain twice as wide.
    """

    central_film: float
    minimum_film: float
    maximum_pressure: float
    friction: float
    nodes: tuple[tuple[int, ...], ...]  # of the grids compared, the film's own first
    domain: FilmNumbers = _UNKNOWN  # errors of the domain

    @classmethod
    def of(cls, solution: OnGrid) -> FilmError:
        """Return the errors of a film from itself and its coarser ones."""
        grids = (solution, *solution.coarser)
        nodes = tuple(one.nodes for one in grids)
        ratio = spacing_ratio(nodes[0], nodes[1]) if len(nodes) > 1 else math.nan
        columns = zip(*(one.numbers for one in grids), strict=True)
        errors = FilmNumbers(
            *(estimated_error(column, ratio, solution.formal_order) for column in columns)
        )
        if solution.coarser:
            peak = max(errors.maximum_pressure, peak_error(solution, solution.coarser[0]))
            errors = errors._replace(maximum_pressure=peak)
        domain, wider = _UNKNOWN, solution.wider
        if wider is not None:
            pairs = zip(solution.coarser[-1].numbers, wider.numbers, strict=True)
            domain = FilmNumbers(*(_off(own, wide) for own, wide in pairs))
        return cls(*errors, nodes, domain)

    @property
    def film(self) -> float:
        """Return the larger error of the central and the smallest film [-]."""
        return max(self.minimum_film, _or_zero(self.central_film))

    @property
    def largest(self) -> float:
        """Return the largest error that is known [-]; not a number: none is."""
        return _largest(self._all())

    @property
    def largest_of_domain(self) -> float:
        """Return the largest error of the domain [-]; not a number: not known."""
        return _largest(self.domain)

    @property
    def sentence(self) -> str:
        """Return the errors in words, with a warning where one is large or none is known."""
        grids = ", ".join(" x ".join(map(str, nodes)) for nodes in self.nodes[1:])
        if not math.isfinite(self.film):
            return " The error of the grid is not known: no film on a coarser grid to compare with."
        text = f" Estimated error of the grid, from {grids} nodes: {_reported(self._all())}."
        if self.largest > LARGE_ERROR:
            text += f" That is above {100.0 * LARGE_ERROR:g} %: take more nodes."
        if not math.isfinite(self.largest_of_domain):
            return text + " The error of the domain is not known."
        text += f" Of the domain, from one twice as wide: {_reported(self.domain)}."
        if self.largest_of_domain > LARGE_ERROR:
            text += f" That is above {100.0 * LARGE_ERROR:g} %: take a wider domain."
        return text

    def _all(self) -> tuple[float, float, float, float]:
        return self.central_film, self.minimum_film, self.maximum_pressure, self.friction


def spacing_ratio(fine: tuple[int, ...], coarse: tuple[int, ...]) -> float:
    """Return the spacing of the coarser grid over that of the finer, the least of all sides [-]."""
    return min((f - 1) / (c - 1) for f, c in zip(fine, coarse, strict=True))


def halved(nodes: tuple[int, ...], closed: bool = False) -> tuple[int, ...] | None:
    """Return the nodes of a grid of twice the spacing; None: they would be too few.

    `closed`: those along y are cells between closed sides, whose number stays even.
    """
    coarse = tuple((n - 1) // 2 + 1 for n in nodes)
    if closed:
        even = coarse[1] % 2 == 0 and coarse[1] >= FEWEST_NODES - 1
        return coarse if even and coarse[0] >= FEWEST_NODES else None
    return coarse if min(coarse) >= FEWEST_NODES else None


def doubled(nodes: tuple[int, ...], closed: bool = False) -> tuple[int, ...]:
    """Return the nodes of a grid of half the spacing; `closed` as in `halved`."""
    finer = tuple(2 * n - 1 for n in nodes)
    return (finer[0], 2 * nodes[1]) if closed else finer


def twice_as_wide(limits: tuple[float, float], nodes: int) -> tuple[tuple[float, float], int]:
    """Return limits on both sides of 0 about twice as far away, and nodes: old ones are kept.

    Examples
    --------
    >>> twice_as_wide((-1.0, 0.5), 4)
    ((-2.0, 1.0), 7)
    """
    step = (limits[1] - limits[0]) / (nodes - 1)
    more = [max(round(abs(limit) / step), 1) for limit in limits]
    return (limits[0] - more[0] * step, limits[1] + more[1] * step), nodes + sum(more)


def check_search(film_error: float | None, most_nodes: int, limit: int) -> None:
    """Refuse a goal or a largest grid that is out of range."""
    if film_error is not None:
        check_within("film_error", film_error, 1e-4, 1.0, "", "1 % is 0.01.")
    check_within("most_nodes", most_nodes, FEWEST_NODES, limit)


Solution = TypeVar("Solution", bound=OnGrid)


def coarser_films(
    solution: Solution,
    on_grid: Callable[[tuple[int, ...], Solution], Solution | None],
    closed: bool = False,
) -> tuple[Solution, ...]:
    """Return the film on two coarser grids, fewer where the nodes become too few or one fails.

    Parameters
    ----------
    solution
        Converged, on the finest grid.
    on_grid
        Returns the converged film on a grid of so many nodes, with the next finer film to start
        from; None: not found.
    closed
        As in `halved`.
    """
    found: list[Solution] = []
    last, nodes = solution, halved(solution.nodes, closed)
    while nodes is not None and len(found) < COARSER_GRIDS:
        coarse = on_grid(nodes, last)
        if coarse is None:
            break
        found.append(coarse)
        last, nodes = coarse, halved(nodes, closed)
    return tuple(found)


def refined_film(
    solution: Solution,
    goal: float,
    most: int,
    on_grid: Callable[[tuple[int, ...]], Solution],
    closed: bool = False,
) -> tuple[Solution, str]:
    """Return the film on the first grid that meets an error of its films, and what happened.

    Parameters
    ----------
    solution
        With its coarser films.
    goal
        Largest estimated error of the central and the smallest film [-].
    most
        Nodes along a side that no grid may exceed.
    on_grid
        Returns the film on a finer grid.
    closed
        As in `halved`.

    Returns
    -------
    tuple
        Film, and a sentence that is empty where the first grid was good enough.
    """
    first = solution.nodes
    while not FilmError.of(solution).film <= goal:
        finer = doubled(solution.nodes, closed)
        if max(finer) > most:
            return solution, (
                f" The films' error of {100.0 * goal:g} % that was asked for is not met: the next "
                f"grid, {_words(finer)} nodes, has more than {most} along a side. Allow more "
                "nodes, or a larger error."
            )
        coarser = (solution, *solution.coarser)[:COARSER_GRIDS]
        trial = replace(on_grid(finer), coarser=coarser)  # type: ignore[type-var]
        if not trial.converged:
            return solution, (
                f" The films' error of {100.0 * goal:g} % that was asked for is not met: the film "
                f"on {_words(finer)} nodes was not found."
            )
        solution = trial
    if solution.nodes == first:
        return solution, ""
    return solution, f" Refined from {_words(first)} to {_words(solution.nodes)} nodes."


def if_converged(film: Solution) -> Solution | None:
    """Return a film, or None where it is no solution."""
    return film if film.converged else None


def with_grids(
    solution: Solution,
    goal: float | None,
    most: int,
    on_grid: Callable[[tuple[int, ...]], Solution],
    near: Callable[[tuple[int, ...], Solution], Solution | None],
    closed: bool = False,
) -> tuple[Solution, str]:
    """Return a film with its coarser ones, refined where an error is asked for, and what happened.

    Parameters
    ----------
    solution, goal, most, closed
        As in `refined_film`; no goal: the film's own grid.
    on_grid
        Returns the film on a grid.
    near
        As `on_grid` of `coarser_films`.
    """
    solution = replace(solution, coarser=coarser_films(solution, near, closed))  # type: ignore[type-var]
    return (solution, "") if goal is None else refined_film(solution, goal, most, on_grid, closed)


def _off(own: float, wide: float) -> float:
    return SAFETY_DOMAIN * abs(wide - own) / abs(wide) if wide else 0.0 if own == wide else math.nan


def _largest(errors: Sequence[float]) -> float:
    return max((one for one in errors if math.isfinite(one)), default=math.nan)


def _reported(errors: Sequence[float]) -> str:
    listed = zip(_NAMES, errors, strict=True)
    return ", ".join(f"{name} {100.0 * one:.2g} %" for name, one in listed if math.isfinite(one))


def _words(nodes: tuple[int, ...]) -> str:
    return " x ".join(map(str, nodes))


def _or_zero(value: float) -> float:
    return value if math.isfinite(value) else 0.0
