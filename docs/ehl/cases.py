"""The films of Jamali 2015 chapters 4 to 6 that the page needs, each with a name of its own."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.point.solid_contact import SolidContact
from tests.helpers.jamali_2015 import jamali_2015, jamali_2015_film

STEPS = 575  # of the thesis' cycle; positions are named by them whatever the time step
CYCLE, LINE, FACETED = (97, 161), (97, 257), (193, 257)  # nodes across, along
WIDE, WIDE_FINE = (129, 257), (257, 257)  # on a wider domain
LAYER = 10.0  # nm
_TOUCHING_K, _TOUCHING_FACETS = 0.02, 30  # steeper and coarser flanks may touch
_WIDE = (-2.75, 2.75)  # of the largest Hertz semi-width, across


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmCase:
    """One design, modification, speed, grid and time step.

    Parameters
    ----------
    design, k, beta, facets
        As in `jamali_2015_film`.
    crown_start
        F_o over the face width.
    speed
        Over that of the thesis.
    nodes
        Across and along the line.
    count
        Time steps of the whole cycle.
    wide
        A domain that goes on behind the line: steep reliefs push the contact out of that of the
        thesis.
    layer
        Thickness of the layer that carries load where solids touch [nm]; 0: the oil alone.
    """

    design: str = "a"
    k: float = 1.0
    beta: float | None = None
    crown_start: float = 0.0
    facets: int = 0
    speed: float = 1.0
    nodes: tuple[int, int] = LINE
    count: int = STEPS
    wide: bool = False
    layer: float = 0.0

    @property
    def name(self) -> str:
        """Return the case in a file name."""
        parts = [self.design, f"{self.nodes[0]}x{self.nodes[1]}"]
        standard = FilmCase()
        for label in ("k", "beta", "crown_start", "facets", "speed", "count", "wide", "layer"):
            value = getattr(self, label)
            if value != getattr(standard, label):
                parts.append(f"{label}{value:g}")
        return "_".join(parts)

    def film(self) -> HelicalFilm:
        """Return the film with its grid and time steps."""
        face_width = jamali_2015(self.design).pair.face_width
        film = jamali_2015_film(
            self.design,
            k=self.k,
            beta=self.beta,
            crown_start=self.crown_start * face_width,
            facets=self.facets,
            nodes=self.nodes,
        )
        steps = replace(film.steps, step=film.steps.step * STEPS / self.count, count=self.count)
        if self.wide:
            film = replace(film, extent=_WIDE)
        layer = SolidContact(thickness=1e-9 * self.layer) if self.layer else None
        film = replace(film, solids=layer)
        return replace(film, steps=steps, pinion_speed=self.speed * film.pinion_speed)

    def number(self, step: float) -> float:
        """Return the number of one of the thesis' steps among those of this case."""
        return step * self.count / STEPS


def parabola_case(design: str, k: float, nodes: tuple[int, int] = WIDE) -> FilmCase:
    """Return a relief whose parabolic share is varied; solids may touch where it is steep."""
    layer = LAYER if k <= _TOUCHING_K else 0.0
    return FilmCase(design=design, k=k, nodes=nodes, wide=True, layer=layer)


def facet_case(facets: int, nodes: tuple[int, int] = FACETED) -> FilmCase:
    """Return design A with faceted flanks, 0: smooth; solids may touch where facets are few."""
    layer = LAYER if 0 < facets <= _TOUCHING_FACETS else 0.0
    return FilmCase(facets=facets, nodes=nodes, layer=layer)


def relief_starts(case: FilmCase, step: float) -> tuple[float, float]:
    """Return y between which the contact line is clear of both tip reliefs [m]."""
    film = case.film()
    X = film.line(case.number(step) * film.time_step)
    plane, modified = film.modified.pair.plane, film.modified
    y = np.linspace(-0.5, 0.5, 8001) * film.line_length
    s = X - 0.5 * plane.W * plane.sin_b / plane.cos_b + y * plane.sin_b
    pinion, gear = np.hypot(plane.r_bp, s), np.hypot(plane.r_bg, plane.x_g - s)
    clear = np.ones(y.size, dtype=bool)
    pair = modified.pair
    for flank, radius, tip in (
        (modified.pinion, pinion, pair.pinion_tip_radius),
        (modified.gear, gear, pair.gear_tip_radius),
    ):
        if flank.tip_relief is not None:
            clear &= radius < tip - flank.tip_relief.extent
    return float(y[clear][0]), float(y[clear][-1])
