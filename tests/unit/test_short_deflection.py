"""Deflection under short waves of pressure as a sum over few neighbours."""

from __future__ import annotations

import numpy as np

from gearlube_core.ehl.point.contact_domain import line_section
from gearlube_core.ehl.point.equations.grid import PointGrid, ShortDeflection
from gearlube_core.ehl.point.newton.transfer import Transfer
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.kernels.row_workers import ALONE, RowWorkers
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import moes_contact


def closed_grid(sides: str) -> PointGrid:
    section = line_section(
        R_x=0.014,
        length=2e-3,
        line_load=3.6e5,
        speed_1=7.9,
        speed_2=5.5,
        contact_modulus=1.1e11,
        lubricant=film_oil(eta0=0.00625, alpha=13.3e-9),
        nodes=(101, 32),
        sides=sides,
    )
    return PointGrid(section, PointScales.of(section), (32, 101))


def open_grid() -> PointGrid:
    contact = moes_contact(50.0, 5.0, nodes=(65, 49))
    return PointGrid(contact, PointScales.of(contact), (49, 65))


@each("halved", [(False, True), (True, True)])
@each("grid", [closed_grid("cyclic"), closed_grid("no_flow"), open_grid()])
def test_short_waves_deflect_as_the_whole_transform_says(grid, halved):
    ny, nx = grid.y.size, grid.x.size
    smaller = grid.sides.halved(ny) if halved[0] else ny, (nx - 1) // 2 + 1 if halved[1] else nx
    transfer = Transfer((ny, nx), smaller, grid.sides)
    pressure = np.zeros(grid.shape, dtype=np.float32)
    grid.sides.inner(pressure)[...] = np.random.default_rng(3).normal(size=(ny, nx))
    for _ in range(3):  # once leaves a part of the waves that the coarser grid has
        pressure -= transfer.up(transfer.down(pressure))
    grid.sides.fill(pressure)
    expected = np.array(grid.single_deflection(pressure))
    found = grid.short_deflection(pressure, halved)
    # waves about twice as long as the shortest are in part on either grid
    error = np.sqrt(np.mean((found - expected) ** 2) / np.mean(expected**2))
    assert error < 0.1


def test_only_some_dozens_of_neighbours_count():
    grid = closed_grid("cyclic")
    assert ShortDeflection(grid.coefficients, grid.sides, (False, True)).weights.size < 40


def test_threads_change_no_bit(monkeypatch):
    monkeypatch.setattr("gearlube_core.kernels.row_workers._FEW", 1)
    grid = closed_grid("cyclic")
    short = ShortDeflection(grid.coefficients, grid.sides, (False, True))
    pressure = np.random.default_rng(4).normal(size=grid.shape).astype(np.float32)
    assert (short(pressure, ALONE) == short(pressure, RowWorkers(3))).all()
