"""How docs/ehl.md judges the statements of Jamali 2015, on numbers made up for each verdict."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from docs.ehl import claims
from docs.ehl.cases import CYCLE, LAYER, FilmCase, facet_case, parabola_case
from docs.ehl.claims import verdicts
from docs.ehl.claims_cycle import CYCLES
from docs.ehl.claims_facets import FACETED_FLANKS, facet_gaps
from docs.ehl.claims_motion import MOTIONS, section
from docs.ehl.claims_relief import RELIEFS
from docs.ehl.lines import COLUMNS, LostFilmError, March, row_of
from docs.ehl.runs import Run, all_runs
from docs.ehl.store import Steady, Store
from docs.page import FAILS, HOLDS, PARTLY
from gearlube_core.ehl.transient.solution import FilmSolution
from tests.helpers.each import each

CLAIMS = {**CYCLES, **RELIEFS, **MOTIONS, **FACETED_FLANKS}


def steady(pressure=1e9, film=2e-7, **changes):
    """Return a film with a given largest pressure and smallest film."""
    y = np.linspace(-0.02, 0.02, 41)
    arch = 1.0 - (y / 0.025) ** 2
    values = {
        "x": np.array([-1e-4, 0.0, 1e-4]),
        "y": y,
        "pressure": pressure * np.array([0.0, 1.0, 0.0])[:, None] * arch,
        "film": film * np.array([3.0, 1.2, 1.0])[:, None] * np.ones(41),
        "dry_pressure": pressure,
        "load": 1.0,
        "load_error": 0.0,
        "converged": True,
        "outcome": "",
        "seconds": 1.0,
    }
    return Steady(**(values | changes))


def march(steps, pressure, film, place=None, load_error=0.0, converged=1.0):
    """Return a march with given curves."""
    steps = np.asarray(steps, dtype=float)
    table = np.zeros((steps.size, len(COLUMNS)))
    for name, values in {
        "number": steps, "max_pressure": pressure, "min_film": film,
        "max_pressure_y": 0.0 if place is None else place, "load_error": load_error,
        "converged": converged,
    }.items():  # fmt: skip
        table[:, COLUMNS.index(name)] = values
    empty = np.zeros((steps.size, 0))
    return March(
        step=steps, table=table, kept_steps=np.zeros(0), kept_pressure=empty, kept_film=empty
    )


class Given:
    """A store whose films are made up."""

    def __init__(self, film=None, moving=None):
        self.film, self.moving = film, moving

    def steady(self, case, step):
        return self.film(case, step)

    def march(self, case, *_):
        return self.moving(case)


def test_measures_on_curves_known_in_closed_form():
    steps = np.arange(10.0)
    assert claims.off_range(np.array([0.9, 1.1, 2.2]), 1.0, 2.0) == pytest.approx(0.1)
    assert claims.jumps(steps, np.where(steps < 4, 0.0, 5.0) + 0.1 * steps, 3.0) == [3.5]
    assert claims.exponent([1, 2, 5], [3 * s**0.68 for s in (1, 2, 5)]) == pytest.approx(0.68)
    assert claims.first_above(steps, steps**2, 20.0) == pytest.approx(4.0 + 4.0 / 9.0)
    assert claims.highest_near(steps, np.sin(steps), 5.0) == (2.0, 8.0)
    phase = np.linspace(0.0, 1.0, 400)
    waves = 2.0 + np.cos(26.0 * np.pi * phase)  # 13 whole waves: 12 inside and two half ones
    assert claims.peaks(waves, 0.2) == 14
    arch = 1.0 - (2.0 * phase - 1.0) ** 2
    assert claims.peaks(arch + 1e-2 * np.sin(26.0 * np.pi * phase), 0.2) == 1


@each(("power", "rise", "verdict"), [(0.68, 1.0, HOLDS), (0.5, 1.0, PARTLY), (0.5, 1.1, FAILS)])
def test_speed_claim_follows_the_exponent_and_the_pressure(power, rise, verdict):
    def pressure(case):
        return 1e9 * (rise if case.speed == 10.0 else 1.0)

    store = Given(
        lambda case, step: steady(pressure(case), 2e-7 * case.speed**power),
        lambda case: march([499, 500], pressure(case), 1.5e-7 * case.speed**power),
    )
    assert CLAIMS["J16"](store).verdict == verdict


@pytest.mark.parametrize(
    ("low", "high", "film", "verdict"),
    [(1.02, 1.25, 0.16, HOLDS), (1.02, 1.25, 0.12, PARTLY), (0.9, 1.25, 0.12, FAILS)],
)
def test_ranges_of_the_cycle(low, high, film, verdict):
    steps = np.arange(1, 576)
    shape = np.sin(np.pi * steps / 575.0)
    p, h = 1e9 * (low + (high - low) * shape), 1e-6 * (film + (0.22 - film) * shape)
    store = Given(lambda case, step: steady(), lambda case: march(steps, p, h))
    assert CLAIMS["J3"](store).verdict == verdict


@pytest.mark.parametrize(("first", "verdict"), [(210, HOLDS), (150, PARTLY)])
def test_place_of_the_largest_pressure(first, verdict):
    steps = np.arange(1, 576)

    def moving(case):
        start = first if case.design == "a" else 180
        inside = (steps > start) & (steps < 365)
        return march(steps, 1e9, 2e-7, np.where(inside, 0.0, 0.01))

    assert CLAIMS["J8"](Given(moving=moving)).verdict == verdict


@each(
    ("error", "converged", "verdict"), [(4e-3, 1.0, HOLDS), (6e-3, 1.0, FAILS), (0.0, 0.0, FAILS)]
)
def test_load_claim_wants_the_load_and_convergence(error, converged, verdict):
    moving = march([1, 2], 1e9, 2e-7, load_error=error, converged=converged)
    assert CLAIMS["J1"](Given(moving=lambda case: moving)).verdict == verdict


def test_facets_want_order_in_pressure_and_film():
    def film(case, step):
        rank = case.facets or 1000
        return steady(1e9 * (1 + 20 / rank), 2e-7 * (1 - 10 / rank))

    assert CLAIMS["F5"](Given(film)).verdict == HOLDS
    swapped = Given(lambda case, step: film(replace(case, facets=60), step))
    assert CLAIMS["F5"](swapped).verdict == FAILS


def test_facets_sink_into_the_arc_by_the_square_of_their_length():
    # a chord leaves its arc by c^2/(8 R): half the facets, four times the gap
    gaps = facet_gaps((40, 80))
    assert gaps[0] / gaps[1] == pytest.approx(4.0, rel=0.05)


def test_cases_have_names_of_their_own_and_positions_of_the_thesis():
    runs = all_runs()
    keys = [(run.case.name, run.step, run.first) for run in runs]
    assert len(set(keys)) == len(keys)
    for count in (200, 575, 800):
        film = FilmCase(nodes=CYCLE, count=count).film()
        number = FilmCase(count=count).number(575)
        assert film.line(number * film.time_step) == pytest.approx(
            FilmCase().film().line(575 * FilmCase().film().time_step), rel=1e-12
        )


def test_march_of_the_store_is_kept(tmp_path):
    case = FilmCase(nodes=(33, 49))
    whole = Store(tmp_path / "whole").march(case, 300, 304, (302,))
    again = Store(tmp_path / "whole").march(case, 300, 304, (302,))
    assert np.array_equal(whole.table, again.table)
    assert list(whole.step) == [300, 301, 302, 303, 304]
    assert whole.fields(302)[1].min() == pytest.approx(whole.at("min_film", 302), rel=1e-6)
    assert list((tmp_path / "whole").glob("*part*")) == []


@pytest.mark.slow
def test_march_of_the_store_goes_on_from_its_record(tmp_path, monkeypatch):
    monkeypatch.setattr("docs.ehl.store._EVERY", 2)
    case = FilmCase(nodes=(33, 49))
    whole = Store(tmp_path / "whole").march(case, 300, 306)
    seen = []

    def interrupted(n, *rest):
        seen.append(n)
        if n == 305 and seen.count(305) == 1:
            raise KeyboardInterrupt
        return row_of(n, *rest)

    monkeypatch.setattr("docs.ehl.store.row_of", interrupted)
    store = Store(tmp_path / "parts")
    with pytest.raises(KeyboardInterrupt):
        store.march(case, 300, 306)
    parts = store.march(case, 300, 306)
    assert seen == [300, 301, 302, 303, 304, 305, 305, 306]
    assert np.array_equal(whole["max_pressure"], parts["max_pressure"])
    assert np.array_equal(whole["min_film"], parts["min_film"])


def test_numbers_of_a_step_are_those_of_its_film():
    grid = np.array([[1.0, 2.0, 5.0, 3.0], [4.0, 2.5, 1.0, 2.0], [0.5, 3.0, 2.0, 1.0]])
    film = FilmSolution(
        time=0.0, x=np.arange(3.0), y=10.0 * np.arange(4.0), pressure=grid, film=grid,
        approach=0.0, load=1.0, load_error=0.25, residual=0.0, converged=False, outcome="",
        newton_steps=1, krylov_steps=1, seconds=0.0,
    )  # fmt: skip
    row = dict(zip(COLUMNS, row_of(7, film, 0.5), strict=True))
    assert (row["number"], row["seconds"], row["load_error"], row["converged"]) == (7, 0.5, 0.25, 0)
    assert (row["max_pressure"], row["max_pressure_y"]) == (5.0, 20.0)
    assert (row["min_film"], row["min_film_y"]) == (0.5, 0.0)


def test_steps_that_failed_are_counted_and_kept_fields_found():
    found = march([0.0, 2.0, 4.0], 1e9, 2e-7, converged=np.array([1.0, 0.0, 0.0]))
    found = replace(
        found, kept_steps=np.array([0.0, 2.0]), kept_pressure=np.array([[[1.0]], [[2.0]]]),
        kept_film=np.array([[[3.0]], [[4.0]]]),
    )  # fmt: skip
    assert (found.failures, found.last_found, found.complete) == (2, 0.0, True)
    assert found.fields(2.0) == (np.array([[2.0]]), np.array([[4.0]]))


def test_what_is_missing_is_not_judged(tmp_path, caplog):
    store = Store(tmp_path, compute=False)
    found = verdicts({name: CLAIMS[name] for name in ("J3", "F5", "F8")}, store)
    assert {name: one.verdict for name, one in found.items()} == {"F8": HOLDS}
    assert "J3 stays as it is: march_a_" in caplog.text
    assert list(tmp_path.iterdir()) == []


def test_claims_on_a_march_whose_film_was_lost_fail_with_the_step_it_came_to():
    steps = np.arange(0, 40)
    short = march(steps, 1e9, 2e-7, converged=(steps < 30).astype(float))
    store = Given(steady, lambda case: short)
    found = verdicts({name: CLAIMS[name] for name in ("J3", "J9", "J14")}, store).values()
    assert [v.verdict for v in found] == [FAILS] * 3
    assert {v.reason for v in found} == {"The film of a march was lost after step 29."}
    assert short.at("min_film", 29) == 2e-7
    with pytest.raises(LostFilmError):
        short.at("min_film", 300)


@pytest.mark.parametrize(("share", "verdict"), [(0.1, HOLDS), (0.0, PARTLY)])
def test_film_of_a_corner_fails_where_solids_touch(share, verdict):
    def moving(case):
        thin = 1.5e-7 if case.k == 1.0 else 5e-8
        found = march([499, 500], 1e9, thin)
        if case.k == 0.0:
            found.table[:, COLUMNS.index("solid_share")] = share
        return found

    store = Given(lambda case, step: steady(film=5e-8), moving)
    assert CLAIMS["J11"](store).verdict == verdict


def test_layer_of_a_case_is_that_of_its_film():
    cases = [parabola_case("a", k) for k in (1.0, 0.1, 0.02, 0.0)]
    cases += [facet_case(n) for n in (0, 20, 30, 40)]
    assert [c.layer for c in cases] == [0.0, 0.0, LAYER, LAYER, 0.0, LAYER, LAYER, 0.0]
    assert facet_case(20).name == "a_193x257_facets20_layer10"
    solids = facet_case(20).film().solids
    assert solids is not None
    assert solids.thickness == pytest.approx(1e-9 * LAYER)
    assert facet_case(40).film().solids is None


def test_section_between_rows_is_interpolated():
    y = np.linspace(-0.02, 0.02, 41)
    rows = np.ones((3, 1)) * (1.0 + 10.0 * y)
    moving = replace(
        march([299, 300], 1e9, 2e-7), kept_steps=np.array([300.0]), kept_pressure=1e9 * rows[None],
        kept_film=2e-7 * rows[None],
    )  # fmt: skip
    found = section(Given(lambda case, step: steady(), lambda case: moving), "b", 300, 0.0053)
    assert found.pressure == pytest.approx(1e9 * 1.053 * np.ones(3))
    assert found.film_ratio == pytest.approx(1.053)


@pytest.mark.slow
def test_section_of_the_contact_line_is_a_line_contact(tmp_path):
    # sec. 5.3, fig. 5.13: indistinguishable; 3 % of a film on 193 nodes
    verdict = CLAIMS["J15"](Store(tmp_path))
    assert verdict.verdict == HOLDS


@pytest.mark.slow
@pytest.mark.parametrize(
    ("facets", "pressures", "films"),
    [(40, (1.6, 1.9), (0.11, 0.16)), (100, (1.18, 1.42), (0.14, 0.20))],
)
def test_faceted_flanks_lie_in_the_ranges_of_the_thesis(tmp_path, facets, pressures, films):
    """Sec. 6.2.2: ranges over the transient cycle; 10 % on pressure, 20 % on film."""
    film = Store(tmp_path).steady(FilmCase(facets=facets, nodes=(129, 257)), 300)
    assert film.converged
    assert 0.9 * pressures[0] < 1e-9 * film.max_pressure < 1.1 * pressures[1]
    assert 0.8 * films[0] < 1e6 * film.min_film < 1.2 * films[1]


@pytest.mark.slow
def test_run_computes_what_is_missing_only(tmp_path):
    store = Store(tmp_path)
    run = Run(case=FilmCase(nodes=(49, 65)), step=300)
    run.do(store)
    (file,) = tmp_path.iterdir()
    before = file.stat().st_mtime_ns
    run.do(store)
    assert file.stat().st_mtime_ns == before
