"""Arguments of the kernels for film and friction of the axle's flanks."""

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import film_nodes, flanks
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.friction.flank_bound import NO_MODEL_FILM, ModelFilm
from gearlube_core.oil.lubricant_state import LubricantState

SPEED = 145.0  # of the pinion [rad/s], as where the axle runs


class AxleFlank(NamedTuple):
    """A running axle: its state, mesh, oil, and parameters without and with a film model."""

    state: Array
    force: float  # N, of the mesh
    window: Array
    n_nodes: int
    oil: LubricantState
    p: AxleParameters
    by_model: AxleParameters
    numbers: Array  # of the film model
    channels: Array
    friction: Array


def film_cases(axle):
    """Kernels with arguments."""
    state, force, window, n_nodes, oil, p, by_model, numbers, channels, friction = axle
    law = by_model.flank_law
    z_p = p.mesh.z_p
    around = np.array([8.0, force, SPEED, -15.0, -4.0, 0.0, -15.1, -3.9, 0.2])
    of_nodes = (window, n_nodes, oil)
    films = np.zeros(film_nodes.N_FILMS)
    return [
        (flanks.pair_film, (state, 900.0, 0.7, channels, oil, law, numbers)),
        *(
            (flanks.pair_friction, (state, 900.0, 0.7, channels, oil, one, film, numbers))
            for one, film in (
                (p, NO_MODEL_FILM),
                *((by_model, ModelFilm(-15.0, -4.0, outside)) for outside in (0.0, 0.3, 1.0)),
            )
        ),
        (flanks._film_at_node, (7, state, force, *of_nodes, law, numbers)),
        *(
            (flanks.film_between_nodes, (0, state, one, *of_nodes, z_p, law, numbers, around))
            for one in (force, 2.0 * force)
        ),
        *(
            (
                flanks.flank_film,
                (
                    *(1, state, 900.0, force, 0.7, channels, *of_nodes),
                    *(z_p, law, model, refresh, films),
                ),
            )
            for model, refresh in (
                (np.zeros(0), flanks.EXACT),
                (numbers, flanks.EXACT),
                (numbers, flanks.BETWEEN_NODES),
            )
        ),
        *(
            (flanks._renew_films, (step, 9, state, force, *of_nodes, law, numbers, around))
            for step in (film_nodes.NEXT, film_nodes.OTHER)
        ),
        *((film_nodes.nodes_on, (around, node, 60, force, SPEED)) for node in (6, 7, 9)),
        (film_nodes.node_films, (np.zeros(film_nodes.N_FILMS), 1)),
        (film_nodes.forget_films, (around.copy(),)),
        (film_nodes.start_films, (around.copy(), 5, force, SPEED)),
        (film_nodes.take_next, (around.copy(), 8)),
        (film_nodes.keep_film, (around.copy(), 1, ModelFilm(-15.0, -4.0, 0.2))),
        (film_nodes.film_between, (around, 0.4)),
        *(
            (
                flanks.flank_sum,
                (
                    *(state, force, window, n_nodes, oil, one, refresh, friction),
                    *(channels, numbers if one is by_model else np.zeros(0)),
                ),
            )
            for refresh in (flanks.EXACT, flanks.BETWEEN_NODES, 0.0)
            for one in (p, p._replace(rolling=1.0), by_model)
        ),
    ]
