"""Film and friction on one tooth pair, by formulas or by a film model."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshMotion
from gearlube_core.dynamics.hypoid_mesh.node_films import (
    NUDGE,
    NodeFlank,
    film_of,
    flank_between,
    follow_flank,
    keep_flank,
    keep_slopes,
    still_holds,
    tells_slopes,
)
from gearlube_core.dynamics.packed_mesh import (
    ARM_G,
    ARM_P,
    DELTA,
    ELLIPTICITY,
    ENTRAIN,
    LINE_RADIUS,
    N_CHANNELS,
    PRESSURE,
    PSI,
    R_E,
    R_Y,
    SHARE,
    SIDE_FLOW,
    XI_X,
    XI_Y,
    XI_Z,
)
from gearlube_core.friction.flank_data import ContactGeometry
from gearlube_core.friction.flank_film import NO_MODEL_FILM, BoundedFlank, FlankEllipse, ModelFilm
from gearlube_core.friction.flank_law import FlankLaw, bounded_flank, model_film, takes_film_model
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import pair_node
from gearlube_core.oil.lubricant_state import LubricantState

# how film and traction of the flanks are evaluated: a film model at the contact itself, or
# interpolated between the nodes of the mesh table
EXACT, BETWEEN_NODES = 1.0, 2.0


@kernel
def sliding_speed(motion: MeshMotion, channels: Array) -> float:
    """Return the sliding speed of the pinion over the gear flank [m/s].

    dU = w_p r_p - w_g r_g + xi.(v_p - v_g): the rate that the friction force does work on, so that
    its power is -f abs(dU) whatever the motion.
    """
    return (
        channels[ARM_P] * motion.w_p
        - channels[ARM_G] * motion.w_g
        + channels[XI_X] * motion.v_x
        + channels[XI_Y] * motion.v_y
        + channels[XI_Z] * motion.v_z
    )


@kernel
def contact_of(channels: Array) -> ContactGeometry:
    """Return the geometry of a contact from the channels of the mesh table."""
    return ContactGeometry(channels[R_E], channels[SIDE_FLOW], channels[PRESSURE])


@kernel
def ellipse_of(channels: Array) -> FlankEllipse:
    """Return the rest of it, which a film model needs."""
    return FlankEllipse(
        channels[LINE_RADIUS],
        channels[R_Y],
        channels[ELLIPTICITY],
        channels[PSI],
        channels[DELTA],
    )


@kernel
def pair_film(
    motion: MeshMotion,
    load: float,
    sliding: float,
    channels: Array,
    oil: LubricantState,
    law: FlankLaw,
    film_model: Array,
) -> ModelFilm:
    """Return film and friction of one flank by the film model; others as in `pair_friction`."""
    return model_film(
        law,
        load,
        channels[ENTRAIN] * motion.w_p,
        sliding,
        contact_of(channels),
        ellipse_of(channels),
        oil,
        film_model,
    )


@kernel
def pair_friction(
    motion: MeshMotion,
    load: float,
    sliding: float,
    channels: Array,
    oil: LubricantState,
    law: FlankLaw,
    film: ModelFilm,
    film_model: Array,
) -> BoundedFlank:
    """Return the state of one flank with this law under `load` [N], sliding at `sliding` [m/s].

    `film` is what a film model gives for it, and `film_model` its numbers, empty without one.
    """
    return bounded_flank(
        law,
        load,
        channels[ENTRAIN] * motion.w_p,
        sliding,
        contact_of(channels),
        film,
        oil,
        film_model,
    )


@kernel
def _flank_under(
    force: float,
    entrainment: float,
    sliding: float,
    channels: Array,
    oil: LubricantState,
    law: FlankLaw,
    film_model: Array,
) -> NodeFlank:
    """Return the flank at a node under a mesh force [N], entrained and sliding [m/s]."""
    load = force * channels[SHARE]
    contact = contact_of(channels)
    film = model_film(
        law, load, entrainment, sliding, contact, ellipse_of(channels), oil, film_model
    )
    if load == 0.0:
        return NodeFlank(film.log_film, film.log_friction, 0.0, 0.0, film.outside, 0.0)
    found = bounded_flank(law, load, entrainment, sliding, contact, film, oil, film_model)
    viscous = found.state.viscous_friction / force
    boundary = found.state.boundary_friction / force
    bound = found.friction_bound * (viscous + boundary)
    return NodeFlank(film.log_film, film.log_friction, viscous, boundary, film.outside, bound)


@kernel
def _renew_node(
    place: int,
    motion: MeshMotion,
    force: float,
    window: Array,
    oil: LubricantState,
    law: FlankLaw,
    film_model: Array,
    films: Array,
) -> None:
    """Evaluate a node unless what `films` keeps of it still holds; others as in `flank_film`."""
    if still_holds(films, place, force, motion.w_p, oil.temperature):
        return
    channels = part(window, place * N_CHANNELS, N_CHANNELS)
    entrainment = channels[ENTRAIN] * motion.w_p
    sliding = sliding_speed(motion, channels)
    from_kept = tells_slopes(films, place, force, motion.w_p, oil.temperature)
    # a loop, so that compiled code holds one copy of the long evaluation, not three
    for k in range(1 if from_kept else 3):
        more_force = 1.0 + NUDGE if k == 1 else 1.0
        more_speed = 1.0 + NUDGE if k == 2 else 1.0
        flank = _flank_under(
            more_force * abs(force),
            more_speed * entrainment,
            more_speed * sliding,
            channels,
            oil,
            law,
            film_model,
        )
        if k > 0:
            keep_slopes(films, place, flank, k == 2)
        elif from_kept:
            follow_flank(films, place, force, motion.w_p, flank)
        else:
            keep_flank(films, place, force, motion.w_p, oil.temperature, flank)


@kernel
def flank_at_nodes(
    pair: int,
    motion: MeshMotion,
    force: float,
    window: Array,
    n_nodes: int,
    oil: LubricantState,
    z_p: float,
    law: FlankLaw,
    film_model: Array,
    films: Array,
) -> NodeFlank:
    """Return one flank with a film model, linear between the nodes of the mesh table.

    As all data of the table are. `z_p` teeth of the pinion, `law` of the flanks: handing over all
    parameters of the axle takes longer than the rest. `films`, shape (N_FILMS,), keeps the nodes.
    Others as in `flank_sum`.
    """
    before, t = pair_node(n_nodes, z_p, motion.angle, pair)
    after = (before + 1) % n_nodes
    for k in range(min(2, n_nodes)):  # not a constant: compiled code then holds one copy
        place = (before + k) % n_nodes
        _renew_node(place, motion, force, window, oil, law, film_model, films)
    return flank_between(films, before, after, t, force, motion.w_p)


@kernel
def flank_film(
    pair: int,
    motion: MeshMotion,
    load: float,
    force: float,
    sliding: float,
    channels: Array,
    window: Array,
    n_nodes: int,
    oil: LubricantState,
    z_p: float,
    law: FlankLaw,
    film_model: Array,
    refresh: float,
    films: Array,
) -> ModelFilm:
    """Return film and friction of one flank by the film model; NO_MODEL_FILM if the law has none.

    At the contact itself where `refresh` is EXACT, else as `flank_at_nodes`. `load` of this pair
    [N]; others as there.
    """
    if film_model.size == 0 or not takes_film_model(law):
        return NO_MODEL_FILM
    if refresh == EXACT:
        return pair_film(motion, load, sliding, channels, oil, law, film_model)
    return film_of(
        flank_at_nodes(pair, motion, force, window, n_nodes, oil, z_p, law, film_model, films)
    )


@kernel
def flank_coefficients(
    pair: int,
    motion: MeshMotion,
    load: float,
    force: float,
    sliding: float,
    channels: Array,
    window: Array,
    n_nodes: int,
    oil: LubricantState,
    z_p: float,
    law: FlankLaw,
    film_model: Array,
    refresh: float,
    films: Array,
) -> tuple[float, float, float]:
    """Return viscous and boundary friction of one flank over its load [-], and the bound of both.

    With a film model, unless `refresh` is EXACT, friction over mesh force is linear between the
    nodes of the mesh table. Arguments as in `flank_film`.
    """
    modelled = film_model.size > 0 and takes_film_model(law)
    if modelled and refresh != EXACT:
        flank = flank_at_nodes(
            pair, motion, force, window, n_nodes, oil, z_p, law, film_model, films
        )
        of_load = abs(force) / load
        return flank.viscous * of_load, flank.boundary * of_load, flank.bound * of_load
    film = NO_MODEL_FILM
    if modelled:
        film = pair_film(motion, load, sliding, channels, oil, law, film_model)
    found = pair_friction(motion, load, sliding, channels, oil, law, film, film_model)
    viscous = found.state.viscous_friction / load
    boundary = found.state.boundary_friction / load
    return viscous, boundary, found.friction_bound * (viscous + boundary)
