"""Arguments of the kernels for the drag of the axle's bearings, by formulas and by solved films."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import NO_RACEWAYS, RollerFilms, SolvedRaceways
from gearlube_core.bearings.losses.race_rolling import roller_film_model
from gearlube_core.dynamics.hypoid_axle import bearing_drag, output_names
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARING_SHARE_OUTSIDE,
    FIRST_BEARING_FILM,
    N_OUTPUTS,
)
from gearlube_core.dynamics.hypoid_axle.state import N_ROLLERS
from gearlube_core.oil.lubricant import LubricantState


def raceway_cases(state: Array, oil: LubricantState, p: AxleParameters) -> list[tuple]:
    """Kernels with arguments."""
    solved = p._replace(drag=bearing_drag.SOLVED_FILMS)
    model = roller_film_model("solved_films")
    one = SolvedRaceways(1.2, 0.01, 2e4, 3e3, 4e-7, 0.01, 3e-7, 0.02)
    two = SolvedRaceways(0.9, 0.02, 3e4, 1e3, 2e-7, 0.01, 5e-7, 0.02)
    some = bearing_drag.AxleRaceways(one, two)
    return [
        *(
            (bearing_drag.bearing_drag, (state, oil, p._replace(drag=law), some))
            for law in (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, bearing_drag.SOLVED_FILMS)
        ),
        *(
            (
                bearing_drag.axle_raceways,
                (state, oil, parameters, RollerFilms(model, np.zeros(N_ROLLERS), kept)),
            )
            for parameters in (p, solved)
            for kept in (0.0, 1.0)
        ),
        (bearing_drag.drag_bound_of, (state, some)),
        *(
            (
                output_names.write_raceways,
                (found, FIRST_BEARING_FILM, BEARING_SHARE_OUTSIDE, np.zeros(N_OUTPUTS)),
            )
            for found in (some, bearing_drag.AxleRaceways(NO_RACEWAYS, NO_RACEWAYS))
        ),
    ]
