"""Pictures of a film model: modelled over solved numbers, and errors."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array

_WORDS = {
    "axle": ("what the axle visits, not trained on", BLUE, "o"),
    "pair": ("what the helical pairs visit, not trained on", BLUE, "o"),
    "box": ("anywhere in the domain, not trained on", VERMILLION, "s"),
}
_NAMES = ("central film", "friction coefficient")


def _back_first(kind: str) -> bool:
    """Draw the box behind what a machine visits."""
    return kind != "box"


def parity_picture(tests: dict[str, dict[str, Array]]) -> Any:
    """Return modelled over solved film and friction."""
    columns = (
        ("film_solved_m", "film_model_m", 1e9, "central film [nm]"),
        ("friction_solved", "friction_model", 1.0, "friction coefficient [-]"),
    )
    from matplotlib.ticker import LogFormatter

    with house_style():
        figure = new_figure(9.0, 4.8)
        for ax, (solved, model, unit, label) in zip(figure.subplots(1, 2), columns, strict=True):
            for kind in sorted(tests, key=_back_first):
                words, colour, marker = _WORDS[kind]
                x, y = unit * tests[kind][solved], unit * tests[kind][model]
                ax.plot(x, y, marker, color=colour, label=words, markersize=3.2, alpha=0.7, mew=0.0)
            solutions = unit * np.concatenate([of[solved] for of in tests.values()])
            ends = np.array([0.8 * solutions.min(), 1.25 * solutions.max()])
            ax.plot(ends, ends, color=GREY, zorder=0, linewidth=1.0)
            ax.set_xscale("log")
            ax.set_yscale("log")
            if unit > 1.0:
                ax.xaxis.set_major_formatter(LogFormatter())
                ax.yaxis.set_major_formatter(LogFormatter())
            ax.set_xlabel(f"solved {label}")
            ax.set_ylabel(f"model's {label}")
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
        figure.suptitle("A point is one contact; on the grey line model and solution agree")
        return figure


def errors_picture(errors: dict[str, tuple[Array, Array]], bounds: tuple[float, float]) -> Any:
    """Return the distribution of the errors [%] with the bounds [%]."""
    with house_style():
        figure = new_figure(9.0, 4.4)
        for n, ax in enumerate(figure.subplots(1, 2)):
            most = max(bounds[n], max(np.abs(errors[kind][n]).max() for kind in errors))
            edges = np.linspace(-1.05 * most, 1.05 * most, 43)
            for kind in sorted(errors, key=_back_first):
                filled = kind != "box"
                words, colour, _ = _WORDS[kind]
                miss = errors[kind][n]
                ax.hist(
                    miss,
                    edges,
                    weights=np.full(miss.size, 100.0 / miss.size),
                    histtype="stepfilled" if filled else "step",
                    color=colour,
                    alpha=0.55 if filled else 1.0,
                    linewidth=1.4,
                    label=words,
                )
            for side in (-bounds[n], bounds[n]):
                label = "bound, 95 % of the domain" if side > 0.0 else None
                ax.axvline(side, color="k", linestyle="--", linewidth=1.0, label=label)
            ax.set_xlabel(f"error of the {_NAMES[n]} [%]")
            ax.set_ylabel("share of contacts [%]")
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3)
        figure.suptitle("How far the model is off in contacts that it was not trained on")
        return figure
