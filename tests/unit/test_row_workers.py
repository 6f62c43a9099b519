"""Work that threads share by rows: the same to the bit for any number of them."""

from __future__ import annotations

import os
import pickle

import numpy as np
import pytest

from gearlube_core.contact import half_space_periodic
from gearlube_core.contact.half_space_periodic import PeriodicDeflection, periodic_modes
from gearlube_core.ehl.point.contact_domain import line_section
from gearlube_core.ehl.point.newton import column_multigrid
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.ehl.transient.problem import moving_section
from gearlube_core.errors import ParameterError
from gearlube_core.kernels import row_workers
from gearlube_core.kernels.row_workers import RowWorkers
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each


@each("threads", [1, 2, 3, 7])
@each("rows", [1, 2, 5, 64])
def test_every_row_is_in_one_part(threads, rows):
    seen = np.zeros(rows, dtype=int)

    def work(part):
        seen[part[0] : part[1]] += 1

    RowWorkers(threads).share(work, rows)
    assert (seen == 1).all()


def test_few_nodes_are_left_to_the_caller():
    workers = RowWorkers(4)
    assert workers.parts(100, 100) == [(0, 100)]
    assert len(workers.parts(100, 300)) == 2


@pytest.mark.parametrize("threads", [1, 2, 3, 7])
def test_parts_begin_at_multiples(threads):
    parts = RowWorkers(threads).parts(50, 10_000, 16)
    assert [first for first, _ in parts][1:] == [end for _, end in parts][:-1]
    assert (parts[0][0], parts[-1][1]) == (0, 50)
    assert len(parts) == min(threads, 4)
    assert all(first % 16 == 0 for first, _ in parts)


def test_an_error_in_a_part_reaches_the_caller():
    def work(part):
        if part[0] > 0:
            raise ValueError("second part")

    with pytest.raises(ValueError, match="second part"):
        RowWorkers(2).share(work, 8)


def test_copies_have_threads_of_their_own():
    workers = RowWorkers(3)
    workers.share(lambda part: None, 8)
    copy = pickle.loads(pickle.dumps(workers))
    assert copy.threads == 3
    assert copy._pool is None


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_forked_process_starts_threads_of_its_own():
    workers, done = RowWorkers(2), []
    workers.share(done.append, 8)
    child = os.fork()
    if child == 0:
        workers.share(done.append, 8)  # would wait for ever for threads that fork left behind
        os._exit(0 if len(done) == 4 else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_threads_are_a_number_above_zero():
    with pytest.raises(ParameterError, match="threads must be within 1 to 64"):
        RowWorkers(0)


THICKNESS = 0.25e-6  # of the layer that carries where solids touch


def marched(threads):
    part = line_section(
        R_x=0.014, length=0.4e-3, line_load=2e5, speed_1=8.0, speed_2=5.5, contact_modulus=114e9,
        lubricant=film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=10e6), nodes=(129, 32),
    )  # fmt: skip

    def heights(x, y, t):
        k_x, k_y = 2.0 * np.pi / 0.15e-3, 2.0 * np.pi / 0.4e-3
        wave = np.cos(k_x * (x[:, None] - 8.0 * t) + k_y * y)
        other = np.cos(k_x * (x[:, None] - 5.5 * t) - k_y * y)
        return min(1.0, t / 4e-6) * 0.3e-6 * (wave + other)

    film = moving_section(part, heights, SolidContact(thickness=THICKNESS))
    settings = PointSolverSettings(wedge="quick", tolerance=1e-5)
    step = 0.5 * part.spacing[0] / 8.0
    march = FilmMarch(film, step, settings=settings, threads=threads)
    for _ in range(4):
        solution = march.step()
    return solution


@pytest.mark.slow
def test_rough_film_is_the_same_to_the_bit_for_any_number_of_threads(monkeypatch):
    parts = set()

    def spied(grid, part, *given):
        parts.add(part)
        return descend(grid, part, *given)

    descend = column_multigrid.descend
    monkeypatch.setattr(column_multigrid, "descend", spied)
    monkeypatch.setattr(row_workers, "_FEW", 50)
    monkeypatch.setattr(half_space_periodic, "_CACHE", 10_000)
    alone, *others = (marched(threads) for threads in (1, 2, 3))
    for other in others:
        assert (other.film == alone.film).all()
        assert (other.pressure == alone.pressure).all()
        assert other.krylov_steps == alone.krylov_steps
    assert alone.film.min() < THICKNESS  # solids touch
    assert any(first > 0 for first, _ in parts)  # the multigrid cycle is shared too


@pytest.mark.parametrize("single", [False, True])
def test_transform_in_blocks_is_that_of_the_whole(monkeypatch, single):
    modes = periodic_modes(2e-6, 3e-6, 150, 70, 1.1e11, 1e-3)
    pressure = np.random.default_rng(1).uniform(0.0, 1e9, (70, 150))
    whole = np.array(PeriodicDeflection(modes, 70, "first", single=single)(pressure))
    monkeypatch.setattr(half_space_periodic, "_CACHE", 1)
    blocks = PeriodicDeflection(modes, 70, "first", single=single)
    size = float(np.abs(whole).max())
    for _ in range(2):
        # roundings of either precision
        assert blocks(pressure) == pytest.approx(whole, abs=(3e-6 if single else 1e-14) * size)
