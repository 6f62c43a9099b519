"""Branches of the pair with backlash and tooth separation, by damping and by load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from docs.helical.cases import HIGH
from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.periodic_response import periodic_response
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.periodic import follow
from gearlube_core.periodic.branch import Branch
from tests.helpers.he_2007 import PINION_TORQUE, he_2007_pair

UM = 1e6
DAMPING = (0.05, 0.03, 0.02, 0.01)
CROWNED_TORQUES = (25.0, 50.0, 100.0, PINION_TORQUE)  # N.m
CROWNED_DAMPING = 0.02
_RANGE, _POINTS, _PARTS = (0.3, 1.3), 81, 2  # mesh over its natural frequency
_APART = 0.01  # of the amplitude of two motions at one speed


@dataclass(frozen=True, slots=True)
class Curve:
    """One branch over mesh frequency.

    Parameters
    ----------
    crowned : bool
    damping, torque : float
        [-], [N.m]
    natural_frequency : float
        Of the mesh's own mode [Hz].
    branch : Branch
    relative, swing, apart, lifted : ndarray of shape (N,)
        Mesh over natural frequency, delta_z peak to peak [m], shares of time without contact and
        with part of the lines off [-].
    linear : ndarray of shape (M, 2)
        Mesh over natural frequency, and the swing [m] of springs that also pull.
    """

    crowned: bool
    damping: float
    torque: float
    natural_frequency: float
    branch: Branch
    relative: Array
    swing: Array
    apart: Array
    lifted: Array
    linear: Array

    @property
    def label(self) -> str:
        """What is different about it, short."""
        return f"{self.torque:.0f} N·m" if self.crowned else f"ζ = {self.damping:g}"

    def span(self, share: Array) -> tuple[float, float] | None:
        """Return the lowest and highest frequency at which a share is above zero."""
        where = self.relative[share > 0.0]
        return (float(where.min()), float(where.max())) if where.size else None


def plain_curves() -> list[Curve]:
    """Return the branches of the pair of He et al. 2007, mu = 0.1."""
    return [_curve(_damped(he_2007_pair(HIGH), zeta), False) for zeta in DAMPING]


def crowned_curves(mesh: LineMesh) -> list[Curve]:
    """Return those of the pair with crowned flanks at several loads, from its line mesh."""
    pair = replace(he_2007_pair(HIGH), mesh=mesh)
    return [
        _curve(replace(_damped(pair, CROWNED_DAMPING), pinion_torque=torque), True)
        for torque in CROWNED_TORQUES
    ]


def _damped(pair: HelicalPairParameters, zeta: float) -> HelicalPairParameters:
    return replace(pair, mesh_damping_ratio=zeta, support_damping_ratio=zeta)


def _curve(linear: HelicalPairParameters, crowned: bool) -> Curve:
    problem = SeparationProblem(
        replace(linear, contact="one_sided", line_divisions=1 if crowned else _PARTS)
    )
    unit = problem.natural_speed
    asked = np.linspace(*_RANGE, _POINTS)
    branch = follow(
        problem.over_speed(),
        problem.initial_guess(),
        _RANGE[0] * unit,
        limits=(_RANGE[0] * unit, _RANGE[1] * unit),
        at=asked * unit,
    )
    orbits = [
        problem.orbit(z, float(speed))
        for z, speed in zip(branch.unknowns, branch.parameter, strict=True)
    ]
    free = [
        float(np.ptp(periodic_response(linear, float(r * unit), throw=False).signal("delta_z")))
        for r in asked
    ]
    return Curve(
        crowned=crowned,
        damping=linear.mesh_damping_ratio,
        torque=linear.pinion_torque,
        natural_frequency=problem.natural_frequency,
        branch=branch,
        relative=branch.parameter / unit,
        swing=np.array([orbit.peak_to_peak for orbit in orbits]),
        apart=np.array([orbit.separation_share for orbit in orbits]),
        lifted=np.array([orbit.lift_off_share for orbit in orbits]),
        linear=np.column_stack((asked, free)),
    )


def overhang(curve: Curve) -> float:
    """Return the largest spread of swings that stable motions have at one frequency [m]."""
    stable = curve.branch.stable
    widest = 0.0
    for relative in np.linspace(*_RANGE, _POINTS):
        rows = [r for r in curve.branch.at(_unit(curve) * relative) if stable[r]]
        if len(rows) > 1 and np.ptp(curve.swing[rows]) > _APART * curve.swing[rows].max():
            widest = max(widest, float(np.ptp(curve.swing[rows])))
    return widest


def _unit(curve: Curve) -> float:
    return float(curve.branch.parameter[0] / curve.relative[0])


def branch_rows(curves: Sequence[Curve]) -> list[list[str]]:
    """Return folds, separation and swings of branches, from the second column on."""
    rows = []
    for c in curves:
        top, two = int(c.swing.argmax()), overhang(c)
        rows.append(
            [
                f"{c.natural_frequency:.0f}",
                f"{UM * c.swing[top]:.1f} at {c.relative[top]:.3f}",
                _span(c.span(c.apart)),
                f"{100.0 * float(c.apart.max()):.0f}",
                f"{UM * two:.1f}" if two > 0.0 else "none",
            ]
        )
    return rows


def _span(span: tuple[float, float] | None) -> str:
    return "never" if span is None else f"{span[0]:.2f} to {span[1]:.2f}"


def separation_figure(curves: Sequence[tuple[str, Sequence[Curve]]]) -> Any:
    """Draw branches side by side: swing above, shares of time below."""
    with house_style():
        figure = new_figure(5.2 * len(curves), 6.4)
        axes = figure.subplots(
            2, len(curves), sharex=True, squeeze=False, gridspec_kw={"height_ratios": (2.2, 1.0)}
        )
        for (title, group), (top, bottom) in zip(curves, axes.T, strict=True):
            for row, curve in enumerate(group):
                _draw(top, bottom, curve, SERIES[row % len(SERIES)])
            top.set_title(title)
            top.set_yscale("log")
            top.legend(loc="upper left")
            bottom.set_xlabel("mesh frequency over natural frequency of the mesh")
            bottom.set_xlim(group[0].relative.min(), group[0].relative.max())
            bottom.set_ylim(0.0, None)
        axes[0, 0].set_ylabel(r"mesh deflection $\delta_z$, peak to peak [µm]")
        axes[1, 0].set_ylabel("share of time [%]")
        figure.suptitle(
            "Above: motion with tooth separation, dashed where unstable; dotted: springs that also "
            "pull.\nBelow: time without any contact (wide), with part of the lines off (thin)",
            fontsize=10.0,
        )
    return figure


def _draw(top: Any, bottom: Any, curve: Curve, colour: str) -> None:
    top.plot([], [], color=colour, label=curve.label)
    for rows, stable in curve.branch.runs():
        style = "-" if stable else "--"
        top.plot(curve.relative[rows], UM * curve.swing[rows], style, color=colour, lw=1.5)
        for share, width in ((curve.apart, 1.8), (curve.lifted, 0.8)):
            bottom.plot(curve.relative[rows], 100.0 * share[rows], style, color=colour, lw=width)
    top.plot(curve.linear[:, 0], UM * curve.linear[:, 1], ":", color=colour, lw=1.0)
    places = [p.index for p in curve.branch.special]
    top.plot(
        curve.relative[places], UM * curve.swing[np.array(places, dtype=int)], "o", color=colour,
        mfc="white", ms=4.5,
    )  # fmt: skip
