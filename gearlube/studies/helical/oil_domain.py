"""Whether the model of solved films of lines holds for an oil."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import check_oil
from gearlube_core.film_model.model import LINE
from gearlube_core.friction.line_points import line_points, uniform_line_load

if TYPE_CHECKING:
    from gearlube.studies.helical.settings import HelicalSettings

_PHASES, _NODES = 4, 2
_NONE = 0.999  # of the load outside: the model says nothing


def check_film_model(settings: HelicalSettings) -> None:
    """Refuse solved films where all load lies outside the domain of the film model.

    Raises
    ------
    ParameterError
    """
    film = settings.film()
    if film.film != "solved":
        return
    if film.line_film_model is not None:
        check_oil(film.line_film_model, film.oil, film.solid, "The film model")
    points = line_points(settings.file.helical_pair(), _PHASES, _NODES)
    load = np.asarray(uniform_line_load(points, settings.pinion_torque))
    cycle = film.cycle(points, load, settings.pinion_speed, settings.pinion_torque)
    if cycle.share_outside > _NONE:
        raise ParameterError(
            "film.model solved must have an oil and an operating point within the domain of the "
            f"film model {film.film_models[LINE].name}, got {film.oil.name} at "
            f"{film.oil_temperature - 273.15:.4g} degC, {settings.pinion_torque:g} N.m and "
            f"{settings.pinion_speed:.4g} rad/s with all load outside. `gearlube film-model show` "
            "tells the domain. Take an oil and an operating point inside it; or train a model for "
            "this oil, `gearlube film-model train --contact line --oil OIL`, and give it with "
            "--film-model or as film.line_model; or take film.model formula."
        )
