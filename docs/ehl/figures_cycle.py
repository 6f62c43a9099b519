"""Curves over the meshing cycle and over parameters, also of faceted flanks, for docs/ehl.md."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from docs.ehl.cases import CYCLE, FACETED, FilmCase, facet_case, parabola_case
from docs.ehl.claims import GPA, MM, UM
from docs.ehl.claims_cycle import drawn_crowned, drawn_cycle
from docs.ehl.lines import March
from docs.ehl.runs import (
    APPROACH,
    CROWNS,
    FACET_MARCH,
    FACET_STEPS,
    MARCHED_PARABOLAS,
    PARABOLAS,
    POSITIONS,
    POWER_STEPS,
    POWERS,
    SPEEDS,
    power_case,
)
from docs.ehl.store import Store
from gearlube.plotting.style import (
    BLUE,
    GREY,
    MARKERS,
    ORANGE,
    PURPLE,
    SERIES,
    SKY,
    VERMILLION,
    house_style,
    new_figure,
)
from gearlube_core.arrays import Array
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap


def facets(store: Store) -> Any:
    """Return pressure and film over the number of facets, and sections: figs 6.7 and 6.14."""
    with house_style():
        figure = new_figure(9.6, 7.0)
        axes = figure.subplots(2, 2)
        for row, step in enumerate(sorted((300, *FACET_STEPS))):
            films = [store.steady(facet_case(n), step) for n in (20, 30, 40, 100)]
            films += [store.steady(FilmCase(nodes=FACETED), step)]
            places = range(5)
            axes[0, 0].plot(
                places, [GPA * f.max_pressure for f in films], "o-", color=SERIES[row],
                label=f"step {step}, at rest", lw=1.0,
            )  # fmt: skip
            axes[0, 1].plot(
                places, [UM * f.min_film for f in films], "o-", color=SERIES[row], lw=1.0
            )
        for place, n in ((2, 40), (3, 100)):
            march = store.march(facet_case(n), *FACET_MARCH, FACET_MARCH[1:])
            for ax, name, unit in ((axes[0, 0], "max_pressure", GPA), (axes[0, 1], "min_film", UM)):
                values = unit * march[name]
                label = "steps 281 to 300, in motion" if n == 40 else None
                ends = (values.min(), values.max())
                ax.vlines(place + 0.12, *ends, color=GREY, lw=5, label=label)
        for ax in axes[0]:
            ax.set_xticks(range(5), ["20", "30", "40", "100", "smooth"])
            ax.set(xlabel="number of facets $n_f$", ylim=(0.0, None))
        axes[0, 0].set_ylabel("largest pressure [GPa]")
        axes[0, 1].set_ylabel("smallest film [µm]")
        axes[0, 0].legend()
        # other colours than those of the steps above
        for n, colour in zip((20, 40, 100, 0), (PURPLE, ORANGE, SKY, "black"), strict=True):
            film = store.steady(facet_case(n), 300)
            j, label = film.column(0.0), f"$n_f$ = {n}" if n else "smooth"
            x = MM * film.x
            axes[1, 0].plot(x, GPA * film.pressure[:, j], color=colour, lw=1.3, label=label)
            axes[1, 1].plot(x, UM * film.film[:, j], color=colour, lw=1.3)
        for ax in axes[1]:
            ax.set(xlabel="across the line, x [mm], y = 0", xlim=(-0.45, 0.4))
        axes[1, 0].set_ylabel("pressure [GPa]")
        axes[1, 0].legend()
        axes[1, 1].set(ylabel="film [µm]", ylim=(0.0, 1.0))
        figure.suptitle(
            "Design A with faceted flanks: each edge makes a spike of pressure; below: step 300",
            fontsize=11,
        )
    return figure


@dataclass(frozen=True, slots=True, kw_only=True)
class DryCycle:
    """Dry pressures over the steps of the thesis."""

    step: Array
    y: Array  # [m]
    pressure: Array  # largest of every section [Pa], (steps, y)

    @property
    def max_pressure(self) -> Array:
        """Return the largest pressure of each step [Pa]."""
        return np.asarray(self.pressure.max(axis=1))


def dry_cycle(store: Store, case: FilmCase, every: int = 25) -> DryCycle:
    """Return the dry contact of a case at every so many steps, kept by the store."""

    def pressed() -> dict[str, Array]:
        steps = np.arange(0, 576, every)
        film = case.film()
        moving = film.moving_film()
        x, y = moving.x, moving.y
        rows = []
        for step in steps:
            X = film.line(case.number(float(step)) * film.time_step)
            dry = dry_contact_of_gap(
                film.gap(x, y, X), x[1] - x[0], y[1] - y[0], film.contact_modulus, film.load(X),
                tolerance=1e-4,
            )  # fmt: skip
            rows.append(dry.pressure.max(axis=0))
        return {"step": steps, "y": y, "pressure": np.array(rows)}

    return DryCycle(**store.kept(f"dry_{case.name}_every{every}", pressed))


COLOURS = dict(zip("ab", (BLUE, VERMILLION), strict=True))


def _two_panels(height: float = 6.0) -> tuple[Any, Any, Any]:
    figure = new_figure(8.2, height)
    top, bottom = figure.subplots(2, 1, sharex=True)
    top.set_ylabel("largest pressure [GPa]")
    bottom.set(ylabel="smallest film [µm]", xlabel="step of the cycle", xlim=(0, 575))
    return figure, top, bottom


def _curves(top: Any, bottom: Any, march: March, label: str, **style: Any) -> None:
    top.plot(march.step, GPA * march["max_pressure"], label=label, **style)
    bottom.plot(march.step, UM * march["min_film"], label=label, **style)
    failed = march["converged"] == 0.0
    bottom.plot(march.step[failed], UM * march["min_film"][failed], "x", color=GREY)


def designs(store: Store) -> Any:
    """Return pressure and film of both designs over the cycle: fig. 5.5."""
    with house_style():
        figure, top, bottom = _two_panels()
        for d in "ab":
            colour = COLOURS[d]
            label = f"{d.upper()}, in motion"
            _curves(top, bottom, drawn_cycle(store, d), label, color=colour)
            dry = dry_cycle(store, FilmCase(design=d, nodes=CYCLE))
            top.plot(
                dry.step, GPA * dry.max_pressure, ".", color=colour, ms=5,
                label=f"{d.upper()}, dry",
            )  # fmt: skip
            rest = [store.steady(FilmCase(design=d, nodes=CYCLE), n) for n in POSITIONS]
            bottom.plot(
                POSITIONS, [UM * f.min_film for f in rest], "o", color=colour, mfc="white",
                label=f"{d.upper()}, at rest",
            )  # fmt: skip
        top.legend(ncols=2)
        bottom.legend(ncols=2)
        bottom.set_ylim(0.0, None)
        figure.suptitle(
            "Designs A and B over the cycle: parabolic relief, $k$ = 1, $F_o$ = 0", fontsize=11
        )
    return figure


def crowns(store: Store) -> Any:
    """Return the five forms of crowning over the cycle: fig. 4.10."""
    with house_style():
        figure, top, bottom = _two_panels()
        for row, start in enumerate(CROWNS):
            _curves(
                top,
                bottom,
                drawn_crowned(store, start),
                f"$F_o$ = {start:g} $F$",
                color=SERIES[row],
                lw=1.3,
            )
        bottom.legend(ncols=5, loc="lower center")
        bottom.set_ylim(0.0, None)
        figure.suptitle(
            "Design A: crown that begins $F_o$ from the middle of the face; face width $F$",
            fontsize=11,
        )
    return figure


def linear_relief(store: Store) -> Any:
    """Return the largest pressure with straight relief: fig. 5.6."""
    with house_style():
        figure = new_figure(8.2, 3.6)
        ax = figure.subplots()
        for d in "ab":
            dry = dry_cycle(store, parabola_case(d, 0.0))
            ax.plot(
                dry.step, GPA * dry.max_pressure, ".-", color=COLOURS[d], lw=1.0,
                label=f"design {d.upper()}, dry",
            )  # fmt: skip
            steps = (75, 500)
            films = [store.steady(parabola_case(d, 0.0), n) for n in steps]
            ax.plot(
                steps, [GPA * f.max_pressure for f in films], "s", color=COLOURS[d], mfc="white",
                label=f"{d.upper()}, film at rest",
            )  # fmt: skip
        ax.set(xlabel="step of the cycle", ylabel="largest pressure [GPa]", xlim=(0, 575))
        ax.set_ylim(0.0, None)
        ax.legend(ncols=2)
        figure.suptitle(
            "Straight tip relief, k = 0: the pressure at its corner depends on the grid",
            fontsize=11,
        )
    return figure


def parabolas(store: Store) -> Any:
    """Return pressure and film over the parabolic share of the relief: fig. 5.18."""
    with house_style():
        figure = new_figure(8.2, 4.0)
        left, right = figure.subplots(1, 2)
        rest = [store.steady(parabola_case("a", k), 500) for k in PARABOLAS]
        whole = {"clip_on": False, "zorder": 3}  # markers on the axis of k = 0
        a = {"color": BLUE, "label": "A, at rest", **whole}
        left.plot(PARABOLAS, [GPA * f.max_pressure for f in rest], "o-", **a)
        left.plot(
            PARABOLAS, [GPA * f.dry_pressure for f in rest], "x--", color=GREY, label="A, dry",
            **whole,
        )  # fmt: skip
        right.plot(PARABOLAS, [UM * f.min_film for f in rest], "o-", **a)
        shares = (1.0, *MARCHED_PARABOLAS)
        marches = [store.march(parabola_case("a", k), 500 - APPROACH, 500) for k in shares]
        done = [(k, m) for k, m in zip(shares, marches, strict=True) if m.complete]
        for ax, name, unit in ((left, "max_pressure", GPA), (right, "min_film", UM)):
            ax.plot(
                [k for k, _ in done], [unit * m.at(name, 500) for _, m in done], "s",
                color=VERMILLION, label="A, in motion", **whole,
            )  # fmt: skip
        films = [store.steady(parabola_case("b", k), 500) for k in shares]
        b = {"color": SERIES[2], "label": "B, at rest", **whole}
        left.plot(shares, [GPA * f.max_pressure for f in films], "^:", **b)
        right.plot(shares, [UM * f.min_film for f in films], "^:", **b)
        left.set(ylabel="largest pressure [GPa]")
        right.set(ylabel="smallest film [µm]")
        for ax in (left, right):
            ax.set(
                xlabel="parabolic share k, on a scale of its square root",
                xlim=(0.0, 1.05),
                ylim=(0.0, None),
            )
            ax.set_xscale("function", functions=(np.sqrt, np.square))
            ax.set_xticks([0.0, 0.02, 0.1, 0.3, 0.5, 0.7, 1.0])
            ax.legend()
        figure.suptitle(
            "Designs A and B, step 500: tip relief from straight (k = 0) to parabolic (k = 1)",
            fontsize=11,
        )
    return figure


def speeds(store: Store) -> Any:
    """Return scaled films and pressures at four speeds, at rest and in motion: figs 5.19, 5.20."""
    with house_style():
        figure = new_figure(8.6, 5.6)
        axes = figure.subplots(2, 2, sharey="row", sharex="col")
        for row, s in enumerate(SPEEDS):
            films = [store.steady(FilmCase(speed=s, nodes=FACETED), n) for n in POSITIONS]
            march = store.march(FilmCase(speed=s, nodes=CYCLE), 500 - APPROACH, 500)
            colour, scale = SERIES[row], UM / s**0.68
            places = np.arange(len(POSITIONS)) + 0.12 * (row - 1.5)
            axes[0, 0].plot(places, [scale * f.min_film for f in films], "o", color=colour)
            axes[1, 0].plot(places, [GPA * f.max_pressure for f in films], "o", color=colour)
            axes[0, 1].plot(
                march.step, scale * march["min_film"], color=colour, label=f"speed times {s:g}"
            )
            axes[1, 1].plot(march.step, GPA * march["max_pressure"], color=colour)
        axes[1, 0].set_xticks(range(len(POSITIONS)), [f"step {n}" for n in POSITIONS])
        axes[1, 1].set_xlabel("step of the cycle")
        axes[0, 0].set(title="at rest", ylabel="smallest film / speed$^{0.68}$ [µm]")
        axes[0, 1].set_title(f"in motion, from rest at step {500 - APPROACH}")
        axes[1, 0].set_ylabel("largest pressure [GPa]")
        figure.legend(*axes[0, 1].get_legend_handles_labels(), ncols=4, loc="outside lower center")
        figure.suptitle("Design A at four speeds; scales do not begin at zero", fontsize=11)
    return figure


def powers(store: Store) -> Any:
    """Return both designs at rest over the cycle for three power laws: fig. 5.22."""
    with house_style():
        figure = new_figure(9.6, 6.0)
        axes = figure.subplots(2, 2, sharex=True, sharey="row")
        for d, (top, bottom) in zip("ab", axes.T, strict=True):
            for row, beta in enumerate(POWERS[1:]):
                case, colour = power_case(d, beta, nodes=CYCLE), SERIES[row]
                films = [store.steady(case, n) for n in POWER_STEPS]
                dry = dry_cycle(store, case, every=5)
                top.plot(dry.step, GPA * dry.max_pressure, color=colour, lw=1.0)
                mark = MARKERS[row]
                top.plot(
                    POWER_STEPS, [GPA * f.max_pressure for f in films], mark, color=colour, ms=4,
                    label=f"β = {beta:g}, film at rest",
                )  # fmt: skip
                bottom.plot(
                    POWER_STEPS, [UM * f.min_film for f in films], f"{mark}-", color=colour, ms=4,
                    lw=1.0,
                )  # fmt: skip
            top.plot([], [], color="black", lw=1.0, label="dry contact")
            top.set_title(f"design {d.upper()}")
            bottom.set(xlabel="step of the cycle", xlim=(0, 575))
        axes[1, 0].set_ylim(0.0, None)
        figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=4, loc="outside lower center")
        axes[0, 0].set_ylabel("largest pressure [GPa]")
        axes[1, 0].set_ylabel("smallest film [µm]")
        figure.suptitle(
            "Tip relief that grows with the power β of the distance: above 2 little changes",
            fontsize=11,
        )
    return figure
