"""Load at a point of a contact line, between the stations and phases of its mesh data."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair.march.line_points import point_load
from gearlube_core.dynamics.helical_pair.march.mesh_data import STATIONS_AT, density_at
from tests.helpers.each import each
from tests.helpers.source_of import source_of

PHASES, LINES, STATIONS = 5, 2, 4


class Sizes(NamedTuple):
    """What `point_load` reads of the flank's constants."""

    phases: float = PHASES
    lines: float = LINES
    stations: float = STATIONS


@each("line", range(LINES))
@each("phase", [0.0, 0.37, 0.95, 1.1, -0.3])
def test_load_lies_between_stations_and_phases_and_a_line_goes_on_as_the_next(phase, line):
    rng = np.random.default_rng(1)
    station = np.array([0.0, 0.2, 0.7, 1.0])
    density, offset = 1.0 + rng.random((2, PHASES, LINES, STATIONS))
    moments = np.full(density_at(station.size, density.size) - STATIONS_AT - station.size, np.nan)
    head = np.full(STATIONS_AT, 7.0)
    data = np.concatenate([head, station, moments, density.ravel(), offset.ravel()])

    def between(values, at_line):
        # after the last phase a line is where the next one begins; the last line has none after it
        over = values[0, line + 1] if line + 1 < LINES else values[-1, line]
        along = [np.interp(at_line, station, row) for row in (*values[:, line], over)]
        return np.interp(phase % 1.0, np.arange(PHASES + 1) / PHASES, along)

    for at_line in (0.0, 0.1, 0.5, 0.7, 0.9, 1.0):
        wanted = between(density, at_line) * (5.0 - between(offset, at_line))
        found = source_of(point_load)(5.0, at_line, phase, line, data, Sizes())
        assert found == pytest.approx(wanted, rel=1e-13)
    assert source_of(point_load)(1.0, 0.5, phase, line, data, Sizes()) == 0.0  # apart
