"""Largest dry pressure over a meshing cycle: what the films' pressures are held against."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from docs.ehl.cases import FilmCase
from gearlube_core.arrays import Array
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap
from gearlube_core.storage.atomic_file import write_arrays


@dataclass(frozen=True, slots=True, kw_only=True)
class DryCycle:
    """Dry pressures over the steps of the thesis."""

    step: Array
    y: Array  # [m]
    pressure: Array  # largest of every section [Pa], (steps, y)

    @property
    def max_pressure(self) -> Array:
        """Return the largest pressure of each step [Pa]."""
        return np.asarray(self.pressure.max(axis=1))


def dry_cycle(folder: Path, case: FilmCase, every: int = 25) -> DryCycle:
    """Return the dry contact of a case at every so many steps, kept in a folder."""
    path = folder / f"dry_{case.name}_every{every}.npz"
    steps = np.arange(0, 576, every)
    if not path.exists():
        film = case.film()
        moving = film.moving_film()
        x, y = moving.x, moving.y
        rows = []
        for step in steps:
            X = film.line(case.number(float(step)) * film.time_step)
            dry = dry_contact_of_gap(
                film.gap(x, y, X), x[1] - x[0], y[1] - y[0], film.contact_modulus, film.load(X),
                tolerance=1e-4,
            )  # fmt: skip
            rows.append(dry.pressure.max(axis=0))
        write_arrays(path, {"step": steps, "y": y, "pressure": np.array(rows)}, compress=True)
    with np.load(path) as data:
        return DryCycle(step=data["step"], y=data["y"], pressure=data["pressure"])
