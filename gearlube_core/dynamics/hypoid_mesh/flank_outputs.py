"""Outputs of the single flanks: their names and the kernel that writes them."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshMotion
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import flank_film, pair_friction, sliding_speed
from gearlube_core.dynamics.packed_mesh import ENTRAIN, N_CHANNELS, R_E, SHARE
from gearlube_core.dynamics.ranges import LEAST_FILM_RATIO
from gearlube_core.film.groups import point_moes_groups
from gearlube_core.friction.evans_johnson_1986 import traction_map_number
from gearlube_core.friction.mixed_friction import SPEED_FLOOR
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import pair_channels
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.number import Output
from gearlube_core.oil.formula_laws import mean_slope
from gearlube_core.oil.lubricant_state import LubricantState, eyring_stress_under

_QUANTITIES = (
    Output("load", "N", "normal load", 1e3, "kN"),
    Output("film_thickness", "m", "central film", 1e-6, "um"),
    Output("film_ratio", "1", "film over roughness"),
    Output("friction_coefficient", "1", "friction coefficient", 0.05),
    Output("temperature", "K", "film temperature", 300.0, "degC"),
)
FLANK_QUANTITIES = tuple(one.name for one in _QUANTITIES)
# of each flank by a film model, in a group of their own
_OF_BOUNDS = (
    Output("film_bound", "1", "bound of the film thickness, relative", 0.05),
    Output("friction_bound", "1", "bound of the friction, relative", 0.05),
)
BOUND_QUANTITIES = tuple(one.name for one in _OF_BOUNDS)
FLANK_BOUNDS = tuple(f"flank[{i}].{q}" for i in range(1, PAIRS + 1) for q in BOUND_QUANTITIES)
FLANK_OUTPUTS = tuple(f"flank[{i}].{q}" for i in range(1, PAIRS + 1) for q in FLANK_QUANTITIES)
# both, with units and words
FLANK_RECORDS = tuple(
    one._replace(name=f"flank[{i}].{one.name}", text=f"{one.text}, flank {i}")
    for quantities in (_QUANTITIES, _OF_BOUNDS)
    for i in range(1, PAIRS + 1)
    for one in quantities
)

# places within the outputs of one flank
LOAD = FLANK_QUANTITIES.index("load")
FILM_THICKNESS = FLANK_QUANTITIES.index("film_thickness")
FILM_RATIO = FLANK_QUANTITIES.index("film_ratio")
FRICTION_COEFFICIENT = FLANK_QUANTITIES.index("friction_coefficient")
TEMPERATURE = FLANK_QUANTITIES.index("temperature")
N_FLANK_QUANTITIES = len(FLANK_QUANTITIES)
_LARGEST_OVER_MEAN = 1.5  # pressure of a Hertz ellipse


class MostLoaded(NamedTuple):
    """Numbers of the flank that carries most, each with a range; zeros without load."""

    film_load: float  # M of Moes [-]
    film_material: float  # L of Moes [-]
    traction: float  # number of the traction map [-]
    temperature: float  # of the film [K]
    pressure: float  # largest Hertz pressure [Pa]
    outside: float  # share of the load of all flanks outside the film model's domain [-]


@kernel
def write_flanks(
    motion: MeshMotion,
    force: float,
    window: Array,
    n_nodes: int,
    oil_temperature: float,
    oil: LubricantState,
    p: AxleParameters,
    film_model: Array,
    refresh: float,
    films: Array,
    first: int,
    first_bound: int,
    channels: Array,
    out: Array,
) -> MostLoaded:
    """Write load, film, film ratio, friction coefficient and temperature of every flank.

    Their outputs begin at `first`, those of their bounds at `first_bound`. A flank without load has
    no film: zeros, and the temperature of the oil. Returns the flank that carries most, for the
    ranges of the formulas. `refresh` and `films` say how a film model is asked, as in
    `flank_sum`, and what it keeps.
    """
    most = 0.0
    total = 0.0
    beyond = 0.0
    found = MostLoaded(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for pair in range(PAIRS):
        here = first + pair * N_FLANK_QUANTITIES
        pair_channels(window, n_nodes, p.mesh.z_p, motion.angle, pair, N_CHANNELS, channels)
        load = abs(force) * channels[SHARE]
        out[here + LOAD] = load
        out[here + FILM_THICKNESS] = 0.0
        out[here + FILM_RATIO] = 0.0
        out[here + FRICTION_COEFFICIENT] = 0.0
        out[here + TEMPERATURE] = oil_temperature
        bounds = first_bound + pair * len(BOUND_QUANTITIES)
        out[bounds] = 0.0
        out[bounds + 1] = 0.0
        if load > 0.0:
            sliding = sliding_speed(motion, channels)
            film = flank_film(
                pair,
                motion,
                load,
                force,
                sliding,
                channels,
                window,
                n_nodes,
                oil,
                p.mesh.z_p,
                p.flank_law,
                film_model,
                refresh,
                films,
            )
            bounded = pair_friction(
                motion, load, sliding, channels, oil, p.flank_law, film, film_model
            )
            flank = bounded.state
            total += load
            beyond += bounded.outside * load
            out[bounds] = bounded.film_bound
            out[bounds + 1] = p.friction * bounded.friction_bound
            out[here + FILM_THICKNESS] = flank.film_thickness
            out[here + FILM_RATIO] = flank.film_ratio
            if p.friction != 0.0:
                out[here + FRICTION_COEFFICIENT] = flank.friction_coefficient
                out[here + TEMPERATURE] = oil_temperature + flank.temperature_rise
            if load > most:
                most = load
                M, L = point_moes_groups(
                    channels[R_E],
                    oil.eta0,
                    oil.alpha,
                    max(abs(channels[ENTRAIN] * motion.w_p), SPEED_FLOOR),
                    load,
                    p.reduced_modulus,
                )
                traction = traction_map_number(
                    flank.film_thickness,
                    flank.mean_pressure,
                    oil.eta0,
                    mean_slope(oil.viscosity, oil, flank.mean_pressure),
                    oil.beta,
                    eyring_stress_under(oil, flank.mean_pressure),
                    oil.conductivity,
                )
                in_use = 1.0 if flank.film_ratio > LEAST_FILM_RATIO else 0.0
                found = MostLoaded(
                    in_use * M,
                    in_use * L,
                    in_use * p.friction * traction,
                    out[here + TEMPERATURE],
                    _LARGEST_OVER_MEAN * flank.mean_pressure,
                    0.0,
                )
    share = beyond / total if total > 0.0 else 0.0
    return MostLoaded(
        found.film_load,
        found.film_material,
        found.traction,
        found.temperature,
        found.pressure,
        share,
    )
