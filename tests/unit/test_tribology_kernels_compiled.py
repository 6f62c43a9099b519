"""Kernels of films and friction that Python calls, and those that no entry of a model reaches."""

from typing import Any

import numpy as np
import pytest

from gearlube_core.contact import greenwood_tripp_1971, hertz
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.film import line_film, point_film
from gearlube_core.friction import (
    evans_johnson_1986,
    flank,
    flank_data,
    line_points,
    mixed_friction,
)
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.oil import eyring_1936
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.each import each

OIL = Lubricant.named("mohammadpour_2015").parameters()
STATE = lubricant_state(OIL, 363.15)
SURFACE = SurfaceParameters(0.5e-6, 0.055, 0.001)
SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
GEOMETRY = flank_data.contact_geometry(0.011, 0.6, 0.4, SOLID.contact_modulus)
FILM = (0.011, 0.99, 0.02, 2e-8, 3.0, 1000.0, 2.3e11)
LINE_FILM = (0.011, 0.02, 2e-8, 3.0, 1.4e5, 2.3e11)
MIXED = (1000.0, 1000.0, 7e8, 4e-7, 3.0, 2.0, 0.011, 1.7e-6)

CASES: list[tuple[Any, tuple[Any, ...]]] = [
    *((eyring_1936.eyring_stress_ratio, (x, 2.0)) for x in (0.0, 0.3, 700.0)),
    (lubricant_state, (OIL, 350.0)),
    (hertz.hertz_ellipse, (0.01, 0.4, 1.15e11, 900.0)),
    (hertz.hertz_ellipse, (0.4, 0.01, 1.15e11, 900.0)),
    *((greenwood_tripp_1971.asperity_integrals, (x,)) for x in (1.234, -1.0, 6.0)),
    (greenwood_tripp_1971.f_5_2_as_printed, (2.5,)),
    (greenwood_tripp_1971.f_2_as_printed, (2.5,)),
    (point_film.minimum_film_thickness, FILM),
    (line_film.minimum_line_film_thickness, LINE_FILM),
    *((evans_johnson_1986.limited_stress_ratio, (9.0, x, 14.0)) for x in (0.05, 1e-6)),
]
for _form in (
    flank_data.CONSISTENT,
    flank_data.AS_PRINTED,
    flank_data.PRINTED_TRACTION,
    flank_data.ZHOU_HOEPRICH_SHARE,
):
    for _operation in (
        (1000.0, 3.0, 2.0),
        (1000.0, -3.0, -1e-4),
        (0.0, 0.0, 0.0),
        (-1.0, 2.0, 1.0),
    ):
        CASES.append((flank.flank_friction, (*_operation, GEOMETRY, STATE, SURFACE, SOLID, _form)))
    CASES.append((mixed_friction.mixed_friction, (*MIXED, STATE, SURFACE, SOLID, _form)))
for _line in (
    (1.4e5, 0.011, 3.0, 2.0),
    (1.4e5, 0.011, -3.0, -1e-4),
    (0.0, 0.011, 0.0, 0.0),
    (-1.0, 0.011, 2.0, 1.0),
):
    CASES.append((line_points.line_friction, (*_line, STATE, SURFACE, SOLID)))


@each(("function", "arguments"), CASES)
def test_compiled_kernel_equals_its_python_function(
    function: Any, arguments: tuple[Any, ...]
) -> None:
    compiled, python = (
        flatten(one) if isinstance(one, tuple) else one
        for one in (function(*arguments), function.py_func(*arguments))
    )
    # a few roundings: the compiler may order products differently
    np.testing.assert_allclose(compiled, python, rtol=5e-15, atol=0.0)


@pytest.mark.parametrize("position", [0, 1, 2])
def test_a_non_number_in_the_motion_is_not_hidden(position: int) -> None:
    load, rolling, sliding = (
        float("nan") if i == position else value for i, value in enumerate((1000.0, 3.0, 2.0))
    )
    state = flank.flank_friction(load, rolling, sliding, GEOMETRY, STATE, SURFACE, SOLID, 0)
    assert np.isnan(state.viscous_friction)
    line = line_points.line_friction(load, 0.011, rolling, sliding, STATE, SURFACE, SOLID)
    assert np.isnan(line.viscous_friction)
    assert np.isnan(line.signed_coefficient)
