"""Statements of Jamali 2015 on the form of tip relief: J10 to J13."""

from __future__ import annotations

from docs.ehl.cases import WIDE_FINE, parabola_case
from docs.ehl.claims import GPA, MM, UM, first_above, listed
from docs.ehl.lines import March
from docs.ehl.pages import touched
from docs.ehl.runs import APPROACH, MARCHED_PARABOLAS, PARABOLAS, POWERS, power_case
from docs.ehl.store import Steady, Store
from docs.page import Claims, Verdict, judge_parts

_CONTOUR = 1e8  # Pa
_MERE_NUMBER = 0.02  # um; half of the composite roughness of a fine gear, no film to speak of
RELIEFS = Claims()


def parabola(store: Store, k: float) -> Steady:
    """Return design A at rest at step 500."""
    return store.steady(parabola_case("a", k), 500)


def parabola_march(store: Store, k: float) -> March:
    """Return the last steps before step 500 of design A."""
    return store.march(parabola_case("a", k), 500 - APPROACH, 500)


def state(march: March) -> str:
    """Return a smallest film [um], or how many steps found none."""
    if not march.complete:
        return f"none after step {march.last_found:.0f}"
    solids = f" (solids {100.0 * march['solid_share'].max():.1g} %)" if touched(march) else ""
    failed = f" ({march.failures} of {len(march.step)} steps not converged)"
    return f"{UM * march.at('min_film', 500):.3f}" + solids + (failed if march.failures else "")


@RELIEFS("J10")
def _parabola_pressures(store: Store) -> Verdict:
    tops = {k: GPA * parabola(store, k).max_pressure for k in PARABOLAS}
    finer = [
        GPA * store.steady(parabola_case("a", k, WIDE_FINE), 500).max_pressure for k in (0.1, 0.0)
    ]
    ratio = tops[0.0] / tops[1.0]
    return Verdict(
        f"k = 1: {tops[1.0]:.3f}, 0.3: {tops[0.3]:.3f}, 0.1: {tops[0.1]:.3f}, 0: {tops[0.0]:.2f} "
        f"GPa; on twice the nodes across, 0.1: {finer[0]:.3f}, 0: {finer[1]:.2f} "
        f"GPa; a factor of {ratio:.2f}",
        judge_parts(
            abs(tops[1.0] / 1.25 - 1.0) < 0.1,
            abs(tops[0.1] / 2.0 - 1.0) < 0.1,
            tops[0.0] > 3.0,
            tops[0.3] < 1.15 * tops[1.0],
        ),
    )


@RELIEFS("J11")
def _parabola_films(store: Store) -> Verdict:
    marches = {k: parabola_march(store, k) for k in (1.0, *MARCHED_PARABOLAS)}
    ratio = marches[1.0].at("min_film", 500) / marches[0.1].at("min_film", 500)
    at_rest = {k: UM * parabola(store, k).min_film for k in (1.0, 0.1, 0.02, 0.0)}
    corner = marches[0.0]
    fails = not corner.complete or corner.failures > 0 or touched(corner)
    fails = fails or UM * corner.at("min_film", 500) < _MERE_NUMBER
    return Verdict(
        "transient, k = " + ", ".join(f"{k:g}: {state(m)}" for k, m in marches.items())
        + " um; at rest " + ", ".join(f"{k:g}: {h:.3f}" for k, h in at_rest.items())
        + f" um; falls by {ratio:.1f} from 1 to 0.1",
        judge_parts(2.0 <= ratio <= 4.0, fails),
    )  # fmt: skip


def contour_start(film: Steady) -> float:
    """Return the lowest y at which the largest pressure of a section passes 0.1 GPa [mm]."""
    return MM * first_above(film.y, film.along, _CONTOUR)


@RELIEFS("J12")
def _powers_b(store: Store) -> Verdict:
    films = {b: store.steady(power_case("b", b), 75) for b in POWERS}
    marches = {b: store.march(power_case("b", b), 75 - APPROACH, 75) for b in POWERS}
    tops = {b: GPA * f.max_pressure for b, f in films.items()}
    low = {b: UM * f.min_film for b, f in films.items()}
    starts = {b: contour_start(f) for b, f in films.items()}
    printed = {2.0: 1.1, 3.0: 1.0, 4.0: 0.96}
    moving = [UM * marches[b].at("min_film", 75) for b in POWERS]
    return Verdict(
        f"{listed(tops.values())} GPa; at rest {listed(low.values(), '{:.3f}')} um, transient "
        f"{listed(moving, '{:.3f}')} um; 0.1 GPa from y = {listed(starts.values(), '{:.1f}')} mm",
        judge_parts(
            all(abs(tops[b] / p - 1.0) < 0.05 for b, p in printed.items()),
            abs(tops[1.0] / 3.2 - 1.0) < 0.15,
            all(abs(h / 0.185 - 1.0) < 0.15 for h in moving[1:]),
            abs(starts[1.0]) < 1.0 and abs(starts[4.0] + 5.0) < 1.0,
        ),
    )


@RELIEFS("J13")
def _powers_a(store: Store) -> Verdict:
    tops = [
        max(GPA * store.steady(power_case("a", b), n).max_pressure for n in (75, 500))
        for b in POWERS
    ]
    ratios = [tops[0] / p for p in tops[1:]]
    gain = 1.0 - min(tops[2:]) / tops[1]
    return Verdict(
        f"{listed(tops)} GPa; lower by {listed(ratios)}; from 2 on {100.0 * gain:.0f} %",
        judge_parts(min(ratios) >= 3.0, 0.0 < gain < 0.15),
    )
