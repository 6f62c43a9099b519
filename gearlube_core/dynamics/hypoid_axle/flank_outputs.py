"""Outputs of the single flanks: their names and the kernel that writes them."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.flanks import pair_friction, sliding_speed
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.state import PHI_P
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, SHARE
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import pair_channels
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant_state import LubricantState

FLANK_QUANTITIES = (
    "load",
    "film_thickness",
    "film_ratio",
    "friction_coefficient",
    "temperature",
)
FLANK_OUTPUTS = tuple(f"flank[{i}].{q}" for i in range(1, PAIRS + 1) for q in FLANK_QUANTITIES)

# places within the outputs of one flank
LOAD = FLANK_QUANTITIES.index("load")
FILM_THICKNESS = FLANK_QUANTITIES.index("film_thickness")
FILM_RATIO = FLANK_QUANTITIES.index("film_ratio")
FRICTION_COEFFICIENT = FLANK_QUANTITIES.index("friction_coefficient")
TEMPERATURE = FLANK_QUANTITIES.index("temperature")
N_FLANK_QUANTITIES = len(FLANK_QUANTITIES)


@kernel
def write_flanks(
    s: Array,
    force: float,
    window: Array,
    n_nodes: int,
    oil_temperature: float,
    oil: LubricantState,
    p: AxleParameters,
    first: int,
    channels: Array,
    out: Array,
) -> None:
    """Write load, film, film ratio, friction coefficient and temperature of every flank.

    Their outputs begin at `first`. A flank without load has no film: zeros, and the temperature of
    the oil.
    """
    for pair in range(PAIRS):
        here = first + pair * N_FLANK_QUANTITIES
        pair_channels(window, n_nodes, p.mesh.z_p, s[PHI_P], pair, N_CHANNELS, channels)
        load = abs(force) * channels[SHARE]
        out[here + LOAD] = load
        out[here + FILM_THICKNESS] = 0.0
        out[here + FILM_RATIO] = 0.0
        out[here + FRICTION_COEFFICIENT] = 0.0
        out[here + TEMPERATURE] = oil_temperature
        if load > 0.0:
            flank = pair_friction(s, load, sliding_speed(s, channels), channels, oil, p)
            out[here + FILM_THICKNESS] = flank.film_thickness
            out[here + FILM_RATIO] = flank.film_ratio
            if p.friction != 0.0:
                out[here + FRICTION_COEFFICIENT] = flank.friction_coefficient
                out[here + TEMPERATURE] = oil_temperature + flank.temperature_rise
