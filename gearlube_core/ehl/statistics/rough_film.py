"""Statistics of a rough film over time: contact, load of solids, distributions, friction."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.ehl.statistics.zone import Distribution, FilmZone, weighted_percentiles
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil import FilmOil

_NANOMETRE = 1e-9
THRESHOLDS = (1e-9, 5e-9, 10e-9, 25e-9)  # m, below which a film counts as contact
PERCENT = (0.1, 1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0, 99.9)
# 1 nm to 25 nm as [jamali_2015 Fig. 7.30], then 2 % a bin to 10 um
FILM_EDGES = np.append(_NANOMETRE * np.arange(25.0), np.geomspace(25.0 * _NANOMETRE, 10e-6, 304))
PRESSURE_EDGES = np.linspace(0.0, 10e9, 1001)  # Pa


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmFriction:
    """Oil, sliding and solid friction, from which the friction of a rough film is computed.

    Parameters
    ----------
    oil
        Oil with its shear law and limiting stress.
    sliding
        u_2 - u_1 along x and y [m/s]; (0, 0) in pure rolling.
    solid_coefficient
        Friction coefficient where solids touch [-]. No law gives it: take that of the oil's
        boundary layers. Without sliding it is not used, and touching solids have no friction.

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> oil = film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=10e6)
    >>> FilmFriction(oil=oil, sliding=(2.4, 0.0), solid_coefficient=0.1).solid_coefficient
    0.1
    """

    oil: FilmOil
    sliding: tuple[float, float]
    solid_coefficient: float

    def __post_init__(self) -> None:
        check_within("solid_coefficient", self.solid_coefficient, 0.0, 2.0)


@dataclass(eq=False, kw_only=True)
class RoughFilmStatistics:
    """Statistics of films that are added one after another; the films themselves are not kept.

    Parameters
    ----------
    zone
        Nodes that are counted, the Hertzian contact. Friction and the load of solids are those of
        the whole film.
    roughness
        Rq of both surfaces together, sqrt(Rq_1^2 + Rq_2^2) [m].
    smooth_film
        Central film of the smooth contact [m]; divided by `roughness` it is the lambda ratio of
        design rules; None: not known.
    solids
        Law by which touching solids carried load where the film vanished; None: only the oil did.
    friction
        Data for the friction; None: friction is not computed.
    gather_from
        Time [s] from which films count in the distributions over all films; before it the contact
        is not yet fully rough.

    Examples
    --------
    >>> x, y = np.linspace(-1e-4, 1e-4, 21), np.linspace(0.0, 1e-3, 16)
    >>> zone = FilmZone.line(x, y, 5.5e-5)
    >>> found = RoughFilmStatistics(zone=zone, roughness=4e-7)
    >>> film = np.where(np.abs(x)[:, None] < 1.5e-5, 4e-9, 8e-7) + 0.0 * y
    >>> found.add(0.0, film, np.full((21, 16), 1e9))
    >>> [round(float(share), 4) for share in found.dataset().contact_share[0]]
    [0.0, 0.2727, 0.2727, 0.2727]
    """

    zone: FilmZone
    roughness: float
    smooth_film: float | None = None
    solids: SolidContact | None = None
    friction: FilmFriction | None = None
    gather_from: float = -math.inf
    _rows: list[tuple[float, ...]] = field(init=False, repr=False, default_factory=list)
    _films: Distribution = field(init=False, repr=False)
    _pressures: Distribution = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_positive("roughness", self.roughness, "m")
        if self.smooth_film is not None:
            check_positive("smooth_film", self.smooth_film, "m")
        self._films = Distribution(FILM_EDGES)
        self._pressures = Distribution(PRESSURE_EDGES)

    def add(self, time: float, film: Array, pressure: Array) -> None:
        """Add a film at a time [s]: film [m] and pressure of oil and solids [Pa], (nx, ny).

        Raises
        ------
        ParameterError
            Another shape, a number that is not finite, a film below 0, a pressure that is one of
            another unit, or a time before the last one.
        """
        self._check(time, film, pressure)
        zone, inside = self.zone, self.zone.inside
        areas, h, p = zone.cells[inside], film[inside], pressure[inside]
        if time >= self.gather_from:
            self._films.add(h, areas)
            self._pressures.add(p, areas)
        below = [h < limit for limit in THRESHOLDS]
        load = float((pressure * zone.cells).sum())
        solid_pressure = np.zeros_like(film) if self.solids is None else self.solids(film)
        solid_load = float((solid_pressure * zone.cells).sum())
        percent = np.array(PERCENT)
        self._rows.append(
            (
                time,
                load,
                float(pressure.max()),
                float(film.min()),
                float((h * areas).sum() / areas.sum()),
                float((p * areas).sum() / areas.sum()),
                solid_load,
                *self._forces(film, pressure, solid_pressure),
                *(float(areas[one].sum() / areas.sum()) for one in below),
                *(float(one.sum()) for one in below),
                *weighted_percentiles(h, areas, percent),
                *weighted_percentiles(p, areas, percent),
            )
        )

    def gathered(self) -> Array:
        """Return all that was gathered as one array, shape (n,), for `resume`."""
        rows = np.array(self._rows, dtype=np.float64).ravel()
        return np.concatenate(
            ([float(len(self._rows))], rows, self._films.areas, self._pressures.areas)
        )

    def resume(self, gathered: Array) -> None:
        """Go on from what `gathered` returned, to the bit as if it had not stopped.

        Raises
        ------
        ParameterError
            The array does not hold such statistics.
        """
        films, pressures = self._films.areas.size, self._pressures.areas.size
        count = int(gathered[0]) if gathered.size else 0
        rest = gathered.size - 1 - films - pressures
        if count < 1 or rest <= 0 or rest % count:
            raise ParameterError(
                f"gathered must hold statistics of at least one film, got {gathered.size} numbers. "
                "Start again."
            )
        rows = gathered[1 : 1 + rest].reshape(count, -1)
        self._rows = [tuple(row) for row in rows.tolist()]
        self._films.areas = gathered[1 + rest : 1 + rest + films].copy()
        self._pressures.areas = gathered[1 + rest + films :].copy()

    def _forces(self, film: Array, pressure: Array, solids: Array) -> tuple[float, float]:
        given = self.friction
        if given is None:
            return math.nan, math.nan
        x, y = self.zone.x, self.zone.y
        # oil between touching solids has its own pressure, not theirs
        oil_pressure = np.maximum(pressure - solids, 0.0)
        shear = point_traction(x, y, oil_pressure, film, given.sliding, given.oil)
        cells = self.zone.cells
        sheared = float((shear.mean_stress * cells).sum())
        # friction is against the sliding: without any it has no direction
        coefficient = given.solid_coefficient if any(given.sliding) else 0.0
        return sheared, coefficient * float((solids * cells).sum())

    def _check(self, time: float, film: Array, pressure: Array) -> None:
        shape = self.zone.inside.shape
        for name, values in (("film", film), ("pressure", pressure)):
            if values.shape != shape:
                raise ParameterError(f"{name} must have the shape {shape}, got {values.shape}.")
            if not np.isfinite(values).all():
                raise ParameterError(f"{name} must be finite at {time:g} s.")
        if float(film.min()) < 0.0 or float(film.max()) > 0.1:
            raise ParameterError(
                f"film must be within 0 to 0.1 m, got {film.min():.3g} to {film.max():.3g} m. "
                "Give it in m."
            )
        if not float(pressure.max()) < 1e12:
            raise ParameterError(
                f"pressure must be below 1e12 Pa, got {pressure.max():.3g} Pa. Give it in Pa."
            )
        if self._rows and time <= self._rows[-1][0]:
            raise ParameterError(f"Times must rise, got {time:g} s after {self._rows[-1][0]:g} s.")

    def dataset(self) -> xr.Dataset:
        """Return the statistics with units.

        Returns
        -------
        xr.Dataset
            Over `time` [s]: load, largest pressure, smallest and mean film, share of the load on
            solids, shares of the zone and numbers of nodes with a film below each `threshold`,
            percentiles, friction. Over all films from `gather_from` on: shares and distribution
            functions over `film_edge` and `pressure_edge`.

        Raises
        ------
        ParameterError
            No film was added.
        """
        if not self._rows:
            raise ParameterError("Add at least one film before the statistics are asked for.")
        table = np.array(self._rows)
        m, n = len(THRESHOLDS), len(PERCENT)
        ends = np.cumsum((1, 1, 1, 1, 1, 1, 1, 2, m, m, n, n))
        parts = np.split(table, ends[:-1], axis=1)
        times, load, largest, least, mean, mean_p, solid, force, shares, counts, of_h, of_p = parts
        percent = np.array(PERCENT)
        of_film, of_pressure = self._films, self._pressures
        variables = {
            "film_load": (load[:, 0], "N", "load of the film"),
            "pressure_max": (largest[:, 0], "Pa", "largest pressure"),
            "pressure_mean": (mean_p[:, 0], "Pa", "mean pressure of the zone"),
            "film_min": (least[:, 0], "m", "smallest film"),
            "film_mean": (mean[:, 0], "m", "mean film of the zone"),
            "lambda_mean": (mean[:, 0] / self.roughness, "1", "mean film over roughness"),
            "solid_share": (solid[:, 0] / load[:, 0], "1", "share of the load on solids"),
            "film_friction": (force[:, 0], "N", "friction of the film"),
            "solid_friction": (force[:, 1], "N", "friction of touching solids"),
            "friction_coefficient": (force.sum(axis=1) / load[:, 0], "1", "friction over load"),
        }
        data: dict[str, tuple[tuple[str, ...], Array, dict[str, str]]] = {
            name: (("time",), values, _notes(unit, words))
            for name, (values, unit, words) in variables.items()
        }
        by_limit, by_percent = ("time", "threshold"), ("time", "percent")
        data |= {
            "contact_share": (by_limit, shares, _notes("1", "share of the zone in contact")),
            "contact_nodes": (by_limit, counts, _notes("1", "nodes of the zone in contact")),
            "film_percentile": (by_percent, of_h, _notes("m", "percentile of the film")),
            "pressure_percentile": (by_percent, of_p, _notes("Pa", "percentile of the pressure")),
        }
        for name, unit, one in (("film", "m", of_film), ("pressure", "Pa", of_pressure)):
            data[f"{name}_function"] = (
                (f"{name}_edge",),
                one.function,
                _notes("1", f"share of the zone with no more {name}, all times"),
            )
            data[f"{name}_histogram"] = (
                (f"{name}_bin",),
                one.shares,
                _notes("1", f"share of the zone in a bin of {name}, all times"),
            )
            data[f"{name}_percentile_all"] = (
                ("percent",),
                one.percentiles(percent),
                _notes(unit, f"percentile of the {name}, all times"),
            )
        coordinates = {
            "time": ("time", times[:, 0], _notes("s", "time")),
            "threshold": ("threshold", np.array(THRESHOLDS), _notes("m", "film of contact")),
            "percent": ("percent", percent, _notes("%", "share of the zone")),
            "film_edge": ("film_edge", of_film.edges, _notes("m", "film")),
            "pressure_edge": ("pressure_edge", of_pressure.edges, _notes("Pa", "pressure")),
        }
        attributes = {
            "roughness": self.roughness,
            "lambda_smooth": (
                math.nan if self.smooth_film is None else self.smooth_film / self.roughness
            ),
            "zone_nodes": int(self.zone.inside.sum()),
            "gathered_films": int((times[:, 0] >= self.gather_from).sum()),
        }
        return xr.Dataset(data, coordinates, attributes)


def statistics_of_run(
    run: xr.Dataset | Iterable[xr.Dataset], statistics: RoughFilmStatistics
) -> xr.Dataset:
    """Return the statistics of the films of a saved run; nothing is solved.

    Parameters
    ----------
    run
        `film` [m] and `pressure` [Pa] over `time`, `x` and `y` in any order, one dataset or several
        in turn. Films are loaded one by one.
    statistics
        Statistics to which the films are added.

    Raises
    ------
    ParameterError
        A variable or dimension is missing, or the nodes are not those of the zone.

    Examples
    --------
    >>> x, y = np.linspace(-1e-4, 1e-4, 21), np.linspace(0.0, 1e-3, 16)
    >>> field = (("time", "x", "y"), np.full((2, 21, 16), 3e-7))
    >>> run = xr.Dataset({"film": field, "pressure": field}, {"time": [0.0, 1e-6], "x": x, "y": y})
    >>> found = RoughFilmStatistics(zone=FilmZone.line(x, y, 5e-5), roughness=2e-7)
    >>> [round(float(one), 3) for one in statistics_of_run(run, found).lambda_mean]
    [1.5, 1.5]
    """
    for part in (run,) if isinstance(run, xr.Dataset) else run:
        for name in ("film", "pressure"):
            if name not in part or set(part[name].dims) != {"time", "x", "y"}:
                got = part[name].dims if name in part else "nothing"
                raise ParameterError(f"{name} must lie over time, x and y, got {got}.")
        for name in ("x", "y"):
            nodes = np.asarray(part[name].values, dtype=float)
            wanted = getattr(statistics.zone, name)
            if nodes.shape != wanted.shape or not np.allclose(nodes, wanted, rtol=1e-9, atol=1e-15):
                raise ParameterError(
                    f"{name} of the run must be the nodes of the zone, got {nodes.size} nodes from "
                    f"{nodes[0]:.4g} to {nodes[-1]:.4g} m against {wanted.size} from "
                    f"{wanted[0]:.4g} to {wanted[-1]:.4g} m."
                )
        for k in range(part.sizes["time"]):
            one = part.isel(time=k)
            film, pressure = (
                np.asarray(one[name].transpose("x", "y").values, dtype=float)
                for name in ("film", "pressure")
            )
            statistics.add(float(one["time"]), film, pressure)
    return statistics.dataset()


def _notes(unit: str, words: str) -> dict[str, str]:
    return {"units": unit, "long_name": words}
