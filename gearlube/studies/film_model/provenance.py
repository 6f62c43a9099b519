"""Where a film model comes from, as names and numbers for its file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from gearlube.studies.film_model.calibration import CONFIDENCE, Misses
from gearlube.studies.film_model.draws import Box
from gearlube.studies.film_model.fit_settings import FitSettings
from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.solves import SolveRow
from gearlube.studies.film_model.targets import solved_rows
from gearlube_core import __version__
from gearlube_core.film_model.model import FLANK, LINE


def provenance_of(
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
        Of the training.
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
        "temperature; Roelands and Houpert, Dowson and Higginson, no limiting stress; steel",
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
