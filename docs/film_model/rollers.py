"""Rollers of the axle with solved films: python -m docs.film_model.rollers writes its table."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from docs.film_model.marked_page import put
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, AxleLosses, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

SPEEDS, TORQUES, TEMPERATURES = (500.0, 1500.0, 3000.0), (20.0, 100.0, 300.0), (40.0, 80.0, 120.0)
LAWS: dict[str, str] = {
    "palmgren": "Palmgren",
    "zhou_hoeprich_1991": "Zhou and Hoeprich",
    "biboulet_houpert_2010": "Biboulet and Houpert",
    "solved_films": "solved",
}
_DRAG = LOSS_SOURCES.index("bearing_torque")


def losses(law: str) -> AxleLosses:
    """Return the losses of the shipped axle with a law of bearing drag."""
    return axle_losses(
        replace(mohammadpour_2015_axle(), bearing_torque_loss=law),
        torques=np.array(TORQUES),
        speeds=np.array([rpm_to_rads(one) for one in SPEEDS]),
        temperatures=np.array([celsius_to_kelvin(one) for one in TEMPERATURES]),
    )


def table() -> str:
    """Return drag by all laws, and bound and share outside of solved films, as Markdown."""
    found = {law: losses(law) for law in LAWS}
    solved = found["solved_films"]
    lines = [
        f"| rpm | N·m | oil, °C | {' | '.join(f'{one}, W' for one in LAWS.values())} | "
        "bound, W | load outside, % |",
        "|" + "---|" * (5 + len(LAWS)),
    ]
    for j, speed in enumerate(SPEEDS):
        for k, torque in enumerate(TORQUES):
            for i, temperature in enumerate(TEMPERATURES):
                drags = [f"{one.power[i, j, k, _DRAG]:.0f}" for one in found.values()]
                cells = [
                    *(f"{speed:g}", f"{torque:g}", f"{temperature:g}", *drags),
                    f"{solved.drag_bound[i, j, k]:.1f}",
                    f"{100.0 * solved.rollers_outside[i, j, k]:.1f}",
                ]
                lines.append("| " + " | ".join(cells) + " |")
    drag = {law: one.power[..., _DRAG] for law, one in found.items()}

    def over(law: str) -> str:
        ratio: Array = drag["solved_films"] / drag[law]
        return f"{ratio.min():.2f} to {ratio.max():.2f}, median {np.median(ratio):.2f}"

    doubt = 100.0 * solved.drag_bound / drag["solved_films"]
    words = (
        f"Solved over Biboulet and Houpert: {over('biboulet_houpert_2010')}; over Zhou and "
        f"Hoeprich: {over('zhou_hoeprich_1991')}; over Palmgren: {over('palmgren')}. Bound over "
        f"loss: median {np.median(doubt):.1f} %, at most {doubt.max():.1f} %."
    )
    return "\n".join(lines) + f"\n\n{words}\n"


if __name__ == "__main__":
    put("rollers", "rollers", table())
