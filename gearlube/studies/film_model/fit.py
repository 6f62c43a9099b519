"""From solved films to a frozen model: processes, grid correction, net, calibration, test."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, NamedTuple

import numpy as np

from gearlube.studies.film_model.calibration import (
    CONFIDENCE,
    Misses,
    Targets,
    conformal_bounds,
    expected_friction,
    grid_corrections,
    own_steps,
    solved_rows,
    targets_of,
)
from gearlube.studies.film_model.draws import Box, widened
from gearlube.studies.film_model.fits import FilmProcess, fit_net, fit_process
from gearlube.studies.film_model.kinds import Contact, ContactKind, kind_of
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.solves import SolveRow
from gearlube_core import __version__
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.groups import FilmGroups
from gearlube_core.film_model.model import FLANK, LINE, FilmModel
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.progress import Progress, no_progress, part_of

_LEAST_WIDTH = 1e-9  # of a group that varies
_BORDER = 0.1  # of a group's range, where the model fades
_FEWEST = {"box": 100, "calibration": 39, "fresh": 20}
_FEWEST_VISITED = 20
_FEWEST_PAIRS = 20
_PAIR_NOISE = 0.1  # first guess, of the corrections' variance
_VISITED_SHARE = 0.3  # of the points that the net learns from
_TRAINED_WEIGHT = 4.0  # of a solved contact over a point of the process


@dataclass(frozen=True, slots=True, kw_only=True)
class FitSettings:
    """How a net is made of the processes.

    Parameters
    ----------
    points
        Of the processes that the net learns from.
    steps
        Most steps of the net's fit.
    seed
        Of points and first weights.
    """

    points: int = 8000
    steps: int = 150
    seed: int = 1

    def __post_init__(self) -> None:
        check_within("points", self.points, 500, 1_000_000)
        check_within("steps", self.steps, 1, 1_000_000)


class Fitted(NamedTuple):
    """A model with what judges it."""

    model: FilmModel
    calibration: Misses
    fresh: Misses
    predicted: dict[str, Array]  # kind: (n, 2) film [m] and friction [-] of the model
    solved: dict[str, Array]  # kind: the same, solved and led to the limit of the grid


def fit_model(
    rows: Sequence[SolveRow],
    plan: FilmPlan,
    settings: FitSettings | None = None,
    *,
    name: str = "",
    state: str = "final",
    start: FilmModel | None = None,
    progress: Progress = no_progress,
) -> Fitted:
    """Return the frozen model of a training set.

    Parameters
    ----------
    rows
        Of `SolveTable`.
    plan
        That they were solved for.
    settings
        Layers and training of the net.
    name
        Of the model, for its provenance.
    state
        "final", or "first" of a trial.
    start
        A model of the same box, from whose net the fit goes on.
    progress
        Called with the share done and a sentence.

    Raises
    ------
    ParameterError
        There are too few rows, or `start` has another domain.
    GearLubeError
        scikit-learn is not installed.

    Notes
    -----
    Two Gaussian processes learn the logarithms of film and friction over their references on the
    first grid, two more what leads to the limit of fine grids. A net learns both sums at many
    points. Bounds: split conformal, the quantile of the errors at contacts drawn from the domain
    that nothing has learnt from, joined in quadrature with twice the error of the grid's
    correction. They hold for 95 % of contacts drawn so [vovk_2005].
    """
    settings = settings or FitSettings()
    kind = plan.kind
    check_rows(rows, kind)
    progress(0.02, "processes")
    trained = targets_of(solved_rows(rows, *kind.training))
    processes = [
        fit_process(trained.groups, trained.values[:, n], smooth=kind.smooth) for n in range(2)
    ]
    progress(0.3, "grid")
    pairs, steps = grid_corrections(rows, *kind.training)
    corrections = [fit_process(pairs.groups, steps[:, n], noise=_PAIR_NOISE) for n in range(2)]
    grid_left = [_rms(one.left_out()) for one in corrections]
    progress(0.4, "points of the net")
    oils = tuple(read_oil(oil).lubricant for oil in plan.oils)
    box = widened(kind.box, oils)
    visited = int(_VISITED_SHARE * settings.points)
    seeds = 1000 + settings.seed, 2000 + settings.seed
    drawn = [
        *kind.box_contacts(box, settings.points - visited, seeds[0]),
        *kind.visits(visited, seeds[1], plan.machines, oils, kind.trained),
    ]
    groups = np.array([kind.groups(one) for one in drawn])
    low, high = domain_of(groups, kind)
    points = np.vstack([groups, trained.groups])
    corrected = trained.values + _at(corrections, trained.groups)
    values = np.vstack([_at(processes, groups) + _at(corrections, groups), corrected])
    weights = np.ones_like(values)
    weights[len(groups) :] = _TRAINED_WEIGHT
    progress(0.45, "net")
    blocks = _net(
        points, values, weights, low, high, settings, start, part_of(progress, 0.45, 0.95)
    )
    modulus = drawn[0].contact_modulus
    model = FilmModel.of_blocks(
        {**blocks, **_frame(low, high, modulus), "bounds": np.array([1.0, 1.0])}, {}
    )
    progress(0.95, "calibration")
    kept = {kind: targets_of(solved_rows(rows, kind)) for kind in ("calibration", "fresh")}
    limits = {kind: at_limit(one, corrections, own_steps(rows, kind)) for kind, one in kept.items()}
    found = {kind: evaluated(model, one.contacts) for kind, one in kept.items()}
    misses = {kind: Misses(found[kind] / limits[kind] - 1.0) for kind in kept}
    spread = conformal_bounds(misses["calibration"].values)
    bounds = tuple(math.hypot(b, 2.0 * g) for b, g in zip(spread, grid_left, strict=True))
    provenance = _provenance_of(rows, plan, settings, (name, state), misses, bounds, grid_left, box)
    model = FilmModel.of_blocks({**model.blocks, "bounds": np.array(bounds)}, provenance)
    return Fitted(model, misses["calibration"], misses["fresh"], found, limits)


def check_rows(rows: Sequence[SolveRow], kind: ContactKind) -> None:
    """Refuse a training set that is too small."""
    for name, least in {**_FEWEST, kind.visited: _FEWEST_VISITED}.items():
        count = len(solved_rows(rows, name))
        if count < least:
            raise ParameterError(
                f"A fit needs at least {least} solved contacts of the kind {name}, got {count}. "
                "Let `gearlube film-model train` go on."
            )
    pairs = len(grid_corrections(rows, *kind.training)[0].contacts)
    if pairs < _FEWEST_PAIRS:
        raise ParameterError(
            f"A fit needs at least {_FEWEST_PAIRS} contacts solved on both grids, got {pairs}. "
            "Let `gearlube film-model train` go on."
        )


def domain_of(groups: Array, kind: ContactKind) -> tuple[Array, Array]:
    """Return the lowest and highest value of each group in the domain, of those that were drawn."""
    low, high = groups.min(axis=0), groups.max(axis=0)
    # up to the limits of the domain, which the training goes beyond
    limits = kind.domain
    for name, most in (
        ("heat", math.log(limits.most_heat)),
        ("thickness", math.log(limits.most_thickness)),
        ("sharpness", limits.most_sharpness),
    ):
        n = FilmGroups._fields.index(name)
        high[n] = min(high[n], most)
    sharpness = FilmGroups._fields.index("sharpness")
    low[sharpness] = max(low[sharpness], limits.least_sharpness)
    low[0] += math.log(limits.least_pressure / kind.trained.least_pressure)
    # angles and ellipticity of a line are zero
    still = high - low < _LEAST_WIDTH
    return np.where(still, low - 1.0, low), np.where(still, high + 1.0, high)


def evaluated(model: FilmModel, contacts: Sequence[Contact]) -> Array:
    """Return film [m] and friction [-] of a model, (n, 2)."""
    numbers = model.copied_numbers()
    return np.array([kind_of(one).predict(numbers, one)[:2] for one in contacts])


def at_limit(targets: Targets, corrections: Sequence[FilmProcess], own: Array) -> Array:
    """Return film and friction of solutions, led to the limit of fine grids, (n, 2).

    By their own second grid where there is one, see `own_steps`; else by the corrections.
    """
    step = np.where(np.isnan(own), _at(corrections, targets.groups), own)
    film = targets.film * np.exp(step[:, 0])
    # the correction of friction is that over its reference, which follows the film
    values = targets.values + step
    expected = [expected_friction(*one) for one in zip(targets.contacts, film, strict=True)]
    return np.stack([film, np.array(expected) * np.exp(values[:, 1])], axis=1)


def _at(processes: Sequence[FilmProcess], groups: Array) -> Array:
    return np.stack([one(groups) for one in processes], axis=1)


def _rms(values: Array) -> float:
    return float(np.sqrt((values**2).mean()))


def _frame(low: Array, high: Array, modulus: float) -> dict[str, Array]:
    return {
        "domain_low": low,
        "domain_high": high,
        "shift": 0.5 * (low + high),
        "scale": 2.0 / (high - low),
        "border": np.array([_BORDER]),
        "contact_modulus": np.array([modulus]),
    }


def _net(
    points: Array,
    values: Array,
    weights: Array,
    low: Array,
    high: Array,
    settings: FitSettings,
    start: FilmModel | None,
    progress: Progress,
) -> dict[str, Array]:
    """Return the weights of the net that learns values (n, 2) at points (n, N_GROUPS)."""
    inputs = (points - 0.5 * (low + high)) * 2.0 / (high - low)
    spread = values.std(axis=0)
    first = None if start is None else _scaled(_same_box(start, low, high).blocks, 1.0 / spread)
    blocks = fit_net(
        inputs,
        values / spread,
        weights,
        seed=settings.seed,
        steps=settings.steps,
        start=first,
        progress=progress,
    )
    return _scaled(blocks, spread)


def _scaled(blocks: dict[str, Array], factor: Array) -> dict[str, Array]:
    """Return the weights of a net whose two outputs are multiplied."""
    scaled = {name: blocks[name] * factor[:, None] for name in ("straight", "last")}
    return {**blocks, **scaled, "last_offset": blocks["last_offset"] * factor}


def _same_box(start: FilmModel, low: Array, high: Array) -> FilmModel:
    blocks = start.blocks
    if not np.allclose(np.stack([blocks["domain_low"], blocks["domain_high"]]), [low, high]):
        raise ParameterError(
            "The model to start from must have the domain of the training set. Leave --start out."
        )
    return start


def _provenance_of(
    rows: Sequence[SolveRow],
    plan: FilmPlan,
    settings: FitSettings,
    name: tuple[str, str],
    misses: Mapping[str, Misses],
    bounds: tuple[float, ...],
    grid_left: list[float],
    box: Box,
) -> dict[str, Any]:
    """Return the provenance of a model.

    Parameters
    ----------
    rows, plan, settings
        Films, what they were solved for, and the fit.
    name
        Of the model, and its state.
    misses
        Errors by kind of contact.
    bounds
        Of film and friction [-].
    grid_left
        What the grid's correction misses, rms of film and friction [-].
    box
        Bounds of the training contacts.
    """
    kind = plan.kind
    sets = (*kind.training, "calibration", "fresh")
    counts = {name: len(solved_rows(rows, name)) for name in sets}
    second = len(solved_rows(rows, *kind.training, second=True))
    over = misses["fresh"].violations((bounds[0], bounds[1]))
    return {
        "name": name[0],
        "state": name[1],
        "kind": kind.name,
        "contact": kind.words,
        "physics": "steady thermal Eyring film, fully flooded, smooth, bulk at the oil's "
        "temperature; ln(eta/eta0) = p/(A + B p) or Roelands and Houpert; constant or local Eyring "
        "stress, the local one limited; Dowson and Higginson; steel",
        f"oils_of_the_{kind.visited}": list(plan.oils),
        **_machines(plan),
        "grid": f"{_grid(kind.nodes)} led to the limit by {second} films on {_grid(kind.second)}",
        "oil_beyond": "the grid, in closed form",
        "solves": counts,
        "fine_solves": second,
        "failed": sum(bool(row.failure) for row in rows),
        "seed": plan.seed,
        "fit": {"points": settings.points, "steps": settings.steps, "seed": settings.seed},
        "date": datetime.now(UTC).date().isoformat(),
        "gearlube": __version__,
        "box": {key: [low, high, scale] for key, (low, high, scale) in box.items()},
        "bounds": {
            "confidence": CONFIDENCE,
            "film_percent": round(100.0 * bounds[0], 4),
            "friction_percent": round(100.0 * bounds[1], 4),
            "fresh_violations": list(over),
        },
        "grid_error_left_percent": [round(100.0 * one, 4) for one in grid_left],
        "errors_box": misses["calibration"].summary(),
        f"errors_fresh_{kind.visited}": misses["fresh"].summary(),
    }


def _machines(plan: FilmPlan) -> dict[str, Any]:
    if plan.contact == FLANK:
        return {"mesh_table": plan.mesh_table}
    return {"pairs" if plan.contact == LINE else "bearings": list(plan.machines)}


def _grid(nodes: tuple[int, int]) -> str:
    return f"{nodes[0]} x {nodes[1]}" if nodes[1] > 1 else str(nodes[0])
