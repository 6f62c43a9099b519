"""Arguments of the kernels for film and friction of the axle's flanks."""

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import flanks, tooth_pair
from gearlube_core.dynamics.hypoid_axle import state as axle_state
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_force import MeshMotion
from gearlube_core.friction.flank_film import NO_MODEL_FILM, ModelFilm
from gearlube_core.oil.lubricant import LubricantState

SPEED = 145.0  # of the pinion [rad/s], as where the axle runs


class AxleFlank(NamedTuple):
    """A running axle: its motion, mesh, oil, and parameters without and with a film model."""

    motion: MeshMotion
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
    motion, force, window, n_nodes, oil, p, by_model, numbers, channels, friction = axle
    law = by_model.flank_law
    z_p = p.mesh.z_p
    before = axle_state.NodeFlank(-15.0, -4.0, 3e-3, 4e-3, 0.0, 1e-4)
    after = axle_state.NodeFlank(-15.1, -3.9, 2.9e-3, 4.1e-3, 0.2, 2e-4)
    kept = np.zeros(axle_state.N_FILMS)
    for node in (7, 8):
        axle_state.keep_flank(kept, node, force, SPEED, oil.temperature, before, after, after)
    of_nodes = (window, n_nodes, oil)
    films = np.zeros(axle_state.N_FILMS)
    return [
        (tooth_pair.pair_film, (motion, 900.0, 0.7, channels, oil, law, numbers)),
        *(
            (
                tooth_pair.pair_friction,
                (motion, 900.0, 0.7, channels, oil, one.flank_law, film, numbers),
            )
            for one, film in (
                (p, NO_MODEL_FILM),
                *((by_model, ModelFilm(-15.0, -4.0, outside)) for outside in (0.0, 0.3, 1.0)),
            )
        ),
        (tooth_pair.ellipse_of, (channels,)),
        *(
            (tooth_pair._flank_under, (F, 5.0, -0.7, channels, oil, law, numbers))
            for F in (900.0, 0.0)
        ),
        *(
            (tooth_pair._renew_node, (node, motion, force, window, oil, law, numbers, films))
            for node in range(0, n_nodes, 6)  # some carry nothing
        ),
        (tooth_pair.flank_at_nodes, (0, motion, force, *of_nodes, z_p, law, numbers, films)),
        *(
            (
                kernel,
                (
                    *(1, motion, 900.0, force, 0.7, channels, *of_nodes),
                    *(z_p, law, model, refresh, films),
                ),
            )
            for kernel in (tooth_pair.flank_film, tooth_pair.flank_coefficients)
            for model, refresh in (
                (np.zeros(0), tooth_pair.EXACT),
                (numbers, tooth_pair.EXACT),
                (numbers, tooth_pair.BETWEEN_NODES),
            )
        ),
        (axle_state.place_of_node, (axle_state.NODES_KEPT + 1,)),
        *((axle_state._relative, (SPEED, then)) for then in (140.0, 0.0)),
        (axle_state._value, (kept, axle_state.place_of_node(7), 2, 0.01, -0.02)),
        (axle_state.film_of, (before,)),
        *(
            (kernel, (kept, *now))
            for kernel in (axle_state.still_holds, axle_state.tells_slopes)
            for now in (
                (7, force, SPEED, oil.temperature),
                (6, force, SPEED, oil.temperature),
                (7, -force, SPEED, oil.temperature),
                (7, force, 1.1 * SPEED, oil.temperature),
                (7, force, SPEED, oil.temperature + 1.0),
            )
        ),
        (
            axle_state.keep_flank,
            (kept.copy(), 3, force, SPEED, oil.temperature, before, after, after),
        ),
        (axle_state._keep_state, (kept.copy(), 3, force, SPEED, oil.temperature, before)),
        (axle_state.follow_flank, (kept.copy(), 7, 1.1 * force, 0.9 * SPEED, after)),
        (axle_state.flank_between, (kept, 7, 8, 0.4, 1.01 * force, 0.98 * SPEED)),
        *(
            (
                flanks.flank_sum,
                (
                    *(motion, force, window, n_nodes, oil, one, refresh, friction),
                    *(channels, numbers if one is by_model else np.zeros(0)),
                ),
            )
            for refresh in (tooth_pair.EXACT, tooth_pair.BETWEEN_NODES, 0.0)
            for one in (p, p._replace(rolling=1.0), by_model)
        ),
    ]
