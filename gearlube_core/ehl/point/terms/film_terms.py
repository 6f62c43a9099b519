"""Terms of one level, built from a problem."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.ehl.point.equations.film_shear import FilmShear, NewtonianShear
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.solid_contact import SolidLayer
from gearlube_core.ehl.point.terms.boundary import AmbientBorder
from gearlube_core.ehl.point.terms.cavitation import (
    Cavitation,
    MassConservingCavitation,
    ReynoldsCavitation,
)
from gearlube_core.ehl.point.terms.entrainment import Entrainment, UniformEntrainment
from gearlube_core.ehl.point.terms.film_oil import IsothermalOil, OilTerm
from gearlube_core.ehl.point.terms.open_border import OpenBorder
from gearlube_core.ehl.point.terms.solids import NoSolids, Solids, TouchingSolids
from gearlube_core.ehl.point.terms.storage import NoStorage, Storage

Shear = FilmShear | NewtonianShear


@dataclass(frozen=True, slots=True)
class FilmTerms:
    """What acts in the film of one grid; `replace` gives another set.

    Every term has a null object that does no work: `UniformEntrainment`, `NoStorage`,
    `NewtonianShear`, `NoSolids`, `AmbientBorder`, `ReynoldsCavitation`, `IsothermalOil`.
    """

    oil: OilTerm
    shear: Shear  # flow factors
    entrainment: Entrainment
    storage: NoStorage | Storage
    solids: Solids
    boundary: AmbientBorder
    cavitation: Cavitation

    @classmethod
    def of(
        cls,
        problem: PointContactProblem,
        scales: PointScales,
        grid: PointGrid,
        sliding: tuple[float, float] | None,
        cavitation: str,
    ) -> FilmTerms:
        """Return the terms of a steady, isothermal problem.

        Parameters
        ----------
        problem, scales
            Contact and its units.
        grid
            Grid.
        sliding
            Of an Eyring oil along the axes of the grid [m/s]; None: not given.
        cavitation
            "reynolds" or "mass_conserving".
        """
        full = np.zeros(grid.shape, dtype=np.bool_)
        breaks: Cavitation = ReynoldsCavitation(full)
        if cavitation == "mass_conserving":
            layer = math.inf if problem.inlet_layer is None else problem.inlet_layer
            breaks = MassConservingCavitation.of(full, grid.metric, grid.dx, layer / scales.film)
        return cls(
            oil=IsothermalOil(scales.oil(problem.lubricant)),
            shear=film_shear(problem, scales, grid, sliding),
            entrainment=UniformEntrainment.of(grid.shape[0]),
            storage=NoStorage(np.zeros(grid.shape)),
            solids=_solids(problem, scales),
            boundary=(
                OpenBorder(problem, scales, grid.shape)
                if problem.oil_beyond
                else AmbientBorder(grid.sides)
            ),
            cavitation=breaks,
        )


def film_shear(
    problem: PointContactProblem,
    scales: PointScales,
    grid: PointGrid,
    sliding: tuple[float, float] | None,
) -> Shear:
    """Return the shear of a film that slides along the axes of the grid [m/s]."""
    if sliding is None or not problem.lubricant.shear.tau0 > 0.0:
        return NewtonianShear.of(grid.shape)
    return FilmShear.of(
        problem.lubricant,
        sliding,
        (grid.dx * scales.length, grid.dy * scales.length),
        grid.shape[0],
        film=scales.film,
        pressure=scales.pressure,
        viscosity=problem.lubricant.eta0,
        central=grid.central_spacing(),
        sides=grid.sides,
    )


def _solids(problem: PointContactProblem, scales: PointScales) -> Solids:
    if problem.solids is None:
        return NoSolids()
    thickness, pressure = problem.solids.thickness, problem.solids.pressure
    return TouchingSolids(SolidLayer(thickness / scales.film, pressure / scales.pressure))
