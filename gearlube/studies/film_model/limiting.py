"""Where a limiting shear stress, which the solved films do not have, would bind."""

from __future__ import annotations

import numpy as np

from gearlube.studies.film_model.solves import SolveTable
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import ROLLER

# limiting stress over pressure: a measured polyalphaolefin, a mineral oil, and a high one; see
# docs/film_model_axle.md for the sources
LIMITS = (0.035, 0.05, 0.08)


def limit_in_words(friction: Array, contacts: str) -> str:
    """Return in how many films the mean shear stress is above a limit.

    Parameters
    ----------
    friction : ndarray
        Coefficients of friction of the films: mean shear stress over mean pressure [-].
    contacts
        What the films are, "films that the axle visits".

    Notes
    -----
    In the middle of a contact the stress is above its mean, so a limit acts a little earlier.
    """
    shares = [f"{100.0 * np.mean(friction > limit):.0f}" for limit in LIMITS]
    limits = [f"{limit:g}" for limit in LIMITS]
    return (
        f"A limiting shear stress of {', '.join(limits[:-1])} or {limits[-1]} times the pressure "
        f"would cut {', '.join(shares[:-1])} or {shares[-1]} % of the {contacts}"
    )


def limits_of(table: SolveTable) -> list[str]:
    """Return the sentence for the films of a training set; none for rollers, which do not slide."""
    first = table.kind.visited, table.kind.nodes  # each contact once
    friction = np.array(
        [
            row.solved.friction
            for row in table.rows.values()
            if (row.task.kind, row.task.nodes) == first and not row.failure
        ]
    )
    if table.kind.name == ROLLER or friction.size == 0:
        return []
    return [f"{limit_in_words(friction, 'films that are visited')}; the model has no such limit."]
