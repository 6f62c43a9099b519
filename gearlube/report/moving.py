"""Slider and buttons of a chart that moves, the same in all reports."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

_ROOM = 90  # px below the chart, for the slider


def steering(names: Sequence[str], what: str, *, frame_ms: int, words: str = "play") -> Any:
    """Return the part of a layout of plotly that goes through frames by slider and buttons.

    Parameters
    ----------
    names : sequence of str
        Of the frames, in their order.
    what : str
        Stands before the name of the frame that is shown.
    frame_ms : int
        Time of a frame [ms].
    words : str
        On the button that starts.
    """
    still = {"mode": "immediate", "frame": {"duration": 0, "redraw": True}}
    still["transition"] = {"duration": 0}
    run = {"fromcurrent": True, "frame": {"duration": frame_ms, "redraw": True}}
    run["transition"] = {"duration": 0}
    steps = [{"label": name, "method": "animate", "args": [[name], still]} for name in names]
    buttons = [
        {"label": f"▶ {words}", "method": "animate", "args": [None, run]},
        {"label": "stop", "method": "animate", "args": [[None], still]},
    ]
    return {
        "sliders": [
            {"steps": steps, "currentvalue": {"prefix": f"{what} "}, "pad": {"t": 0, "b": 40},
             "x": 0.03, "len": 0.92, "y": 0.0}
        ],
        "updatemenus": [
            {"type": "buttons", "direction": "left", "buttons": buttons, "x": 0.0, "y": 1.0,
             "xanchor": "left", "yanchor": "top", "showactive": False}
        ],
        "margin": {"l": 0, "r": 0, "t": 10, "b": _ROOM},
        "showlegend": False,
    }  # fmt: skip
