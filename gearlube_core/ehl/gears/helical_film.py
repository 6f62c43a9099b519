"""The film of a helical pair: one contact line as it moves, and curves over its cycle."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.ehl.point.equations.stencil import Grading
from gearlube_core.ehl.point.problem import EllipticParaboloid
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.transient.curves import (
    FilmCurves,
    NumberedSteps,
    Progress,
    film_row,
    march_curves,
)
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.ehl.transient.steady import solve_steady_film
from gearlube_core.helical_geometry.load_sharing import CONVENTIONS, shared_load
from gearlube_core.helical_geometry.meshing_steps import MeshingSteps
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap
from gearlube_core.oil.film_oil import FilmOil

_LARGEST_GAP = 50e-6  # m
_OPEN_FILM = 10e-6  # m
_DOMAIN = (-2.75, 1.775)  # of the largest Hertz semi-width; 4.5 in [jamali_2015 ch. 4]
_SLENDEST = 2000.0  # R_y/R_x that stands for a line


# densest where the film leaves the contact on any row at any time: the smallest film lies there
EXIT_GRADING = ((-2.75, 4.0), (-1.5, 2.0), (-0.4, 2.0), (0.1, 1.0), (1.2, 1.0), (1.775, 3.0))
GRADINGS: dict[str, tuple[tuple[float, float], ...]] = {"uniform": (), "exit": EXIT_GRADING}
COLUMNS = (
    "step",
    "load",
    "pressure_max",
    "pressure_max_y",
    "minimum_film",
    "minimum_film_x",
    "minimum_film_y",
    "loaded_length",
    "load_error",
    "converged",
    "newton_steps",
    "krylov_steps",
    "seconds",
    "solid_share",
    "touching_area",
    "solid_pressure",
    "time_error",
    "time_error_pressure",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalFilm:
    """Film of one contact line of a helical pair through its meshing cycle.

    Parameters
    ----------
    modified : ModifiedPair
        Pair with its reliefs and crowns.
    steps : MeshingSteps
        Positions of the line; position 0 is time zero.
    torque
        On the pinion [N m].
    pinion_speed
        [rad/s].
    lubricant : FilmOil
    contact_modulus
        E* [Pa].
    nodes
        Along x and along the line.
    convention
        Of the load, as in `shared_load`: "normal" or "thesis".
    form
        Of the flanks, as in `UndeformedGap`.
    extent
        Domain along x over the largest Hertz semi-width [-].
    largest_gap
        The gap is cut there [m].
    open_film
        Thicker films [m] are at ambient pressure: forty films and more carry no load, but small
        pressures in them come and go over whole rows as the relief moves.
    solids : SolidContact or None
        What carries load where the film vanishes; None: the oil alone.
    grading
        Pairs of a place along x, over the largest Hertz semi-width, and the spacing there in
        proportion, e.g. `EXIT_GRADING`; none: uniform.

    Raises
    ------
    ParameterError
        An input is out of range.

    Notes
    -----
    u_j = R_j' omega_j varies along the line, not across it, and there is no velocity along the
    line. Load in the share of the unrelieved length. Source: [jamali_2015 ch. 4].
    """

    modified: ModifiedPair
    steps: MeshingSteps
    torque: float
    pinion_speed: float
    lubricant: FilmOil
    contact_modulus: float
    nodes: tuple[int, int] = (97, 257)
    convention: str = "normal"
    form: str = "involute"
    extent: tuple[float, float] = _DOMAIN
    largest_gap: float = _LARGEST_GAP
    open_film: float = _OPEN_FILM
    solids: SolidContact | None = None
    grading: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        check_positive("torque", self.torque, "N m", "The pinion drives.")
        check_positive("pinion_speed", self.pinion_speed, "rad/s", "Give the speed's magnitude.")
        check_positive("largest_gap", self.largest_gap, "m")
        check_option("convention", self.convention, CONVENTIONS)
        if self.grading:
            self._grading(1.0)

    @property
    def time_step(self) -> float:
        """Return the time between two positions [s]."""
        return self.steps.duration(self.pinion_speed)

    @property
    def line_length(self) -> float:
        """Return w = F/cos(beta_b), the longest line [m]."""
        plane = self.modified.pair.plane
        return plane.W / plane.cos_b

    def line(self, time: float) -> float:
        """Return X of the line [m] at a time [s]."""
        return float(self.steps.line(time / self.time_step))

    def load(self, X: float) -> float:
        """Return the normal load [N] of the line at X [m]."""
        shared = shared_load(X, self.modified, self.torque, self.convention)
        return float(shared.load)

    def surface_speeds(self, y: Array, X: float) -> tuple[Array, Array]:
        """Return the speeds of pinion and gear across the line [m/s] at y [m]."""
        # [jamali_2015 (4.1)] [jamali_2015 (4.2)]
        plane = self.modified.pair.plane
        s = X - 0.5 * plane.W * plane.sin_b / plane.cos_b + np.asarray(y) * plane.sin_b
        gear_speed = self.pinion_speed * plane.r_bp / plane.r_bg
        return s * self.pinion_speed, (plane.x_g - s) * gear_speed

    def gap(self, x: Array, y: Array, X: float) -> Array:
        """Return the gap [m], shape (nx, ny), cut at `largest_gap`.

        Nodes on the side faces have the largest gap: the teeth end there. Without crown the film
        beside them gets thinner the finer the grid, as pressure on a sharp end grows.
        """
        heights = UndeformedGap(modified=self.modified, form=self.form).heights(
            x[:, None], y[None, :], X
        )
        inside = np.abs(y) < (1.0 - 1e-9) * 0.5 * self.line_length
        return np.where(inside, np.minimum(heights, self.largest_gap), self.largest_gap)

    def conditions(self, x: Array, y: Array, time: float) -> FilmConditions:
        """Return gap, load and speeds of the film at a time [s]."""
        X = self.line(time)
        return FilmConditions(self.gap(x, y, X), self.load(X), *self.surface_speeds(y, X))

    def largest_load(self) -> tuple[float, float]:
        """Return the largest load of a line [N] and X where it is reached [m]."""
        lines = self.steps.line(np.arange(self.steps.count + 1))
        loads = shared_load(lines, self.modified, self.torque, self.convention).load
        most = int(np.argmax(loads))
        return float(loads[most]), float(lines[most])

    def semi_width(self) -> float:
        """Return the Hertz semi-width at the largest load in the middle of the line [m]."""
        load, X = self.largest_load()
        radii = self._radii(X)
        return hertz_ellipse(radii.R_x, radii.R_y, self.contact_modulus, load)[0]

    def _radii(self, X: float) -> EllipticParaboloid:
        plane = self.modified.pair.plane
        s = X - 0.5 * plane.W * plane.sin_b / plane.cos_b
        R_x = s * (plane.x_g - s) / (plane.x_g * plane.cos_b)
        half = 0.5 * self.line_length
        edge = 0.0
        for flank in (self.modified.pinion, self.modified.gear):
            if flank.crown is not None:
                edge += float(flank.crown.removal(half * plane.cos_b, plane.W)) * plane.cos_b
        flat = _SLENDEST * R_x
        return EllipticParaboloid(R_x, min(half * half / (2.0 * edge), flat) if edge else flat)

    def _grading(self, a: float) -> Grading | None:
        """Return the grading of the spacing for the largest Hertz semi-width [m]."""
        if not self.grading:
            return None
        places, spacing = zip(*self.grading, strict=True)
        return Grading(tuple(place * a for place in places), spacing)

    def moving_film(self) -> MovingFilm:
        """Return the film with the scales of the largest load."""
        load, X = self.largest_load()
        radii = self._radii(X)
        a = self.semi_width()
        half = 0.5 * self.line_length
        speeds = self.surface_speeds(np.zeros(1), X)
        return MovingFilm(
            conditions=self.conditions,
            lubricant=self.lubricant,
            contact_modulus=self.contact_modulus,
            x_limits=(self.extent[0] * a, self.extent[1] * a),
            y_limits=(-half, half),
            nodes=self.nodes,
            hertz=radii,
            load=load,
            open_film=self.open_film,
            solids=self.solids,
            grading=self._grading(a),
            speed=0.5 * float(speeds[0][0] + speeds[1][0]),
        )


def solve_helical_line(
    film: HelicalFilm,
    step: float,
    settings: PointSolverSettings | None = None,
    *,
    film_error: float | None = None,
    most_nodes: int = 1025,
    throw: bool = True,
) -> FilmSolution:
    """Return the steady film of the line at one step of its cycle.

    Parameters
    ----------
    film
        Pair, operation, oil and grid.
    step
        Number of the step, need not be whole.
    settings, film_error, most_nodes, throw
        As in `solve_steady_film`.
    """
    return solve_steady_film(
        film.moving_film(),
        step * film.time_step,
        settings,
        film_error=film_error,
        most_nodes=most_nodes,
        throw=throw,
    )


def march_helical_cycle(
    film: HelicalFilm,
    *,
    first: int = 0,
    last: int | None = None,
    substeps: int = 1,
    scheme: str = "bdf2",
    settings: PointSolverSettings | None = None,
    keep: tuple[int, ...] = (),
    checkpoint: Path | str | None = None,
    checkpoint_every: int = 25,
    progress: Progress | None = None,
    repeat: bool = False,
    throw: bool = True,
) -> FilmCurves:
    """Return the film over the steps of a meshing cycle.

    Parameters
    ----------
    film
        Pair, operation, oil and grid.
    first, last
        Steps; the film is steady at the first. All of them by default.
    substeps
        Time steps for one step of the cycle.
    scheme, settings, keep, checkpoint, checkpoint_every, progress, repeat, throw
        As in `march_curves`.

    Raises
    ------
    ConvergenceError
        A step did not converge.
    ParameterError
        Steps out of range, or the checkpoint belongs to another march.
    """
    last = film.steps.count if last is None else last
    check_within("first", first, 0, film.steps.count)
    check_within("last", last, first, film.steps.count)
    check_within("substeps", substeps, 1, 1000)
    steps = NumberedSteps(first, last, first * film.time_step, film.time_step, substeps)
    return march_curves(
        film.moving_film(),
        COLUMNS,
        lambda step, solution: film_row(COLUMNS, solution, step=float(step)),
        steps,
        scheme=scheme,
        settings=settings,
        keep=keep,
        checkpoint=checkpoint,
        checkpoint_every=checkpoint_every,
        progress=progress,
        repeat=repeat,
        throw=throw,
    )
