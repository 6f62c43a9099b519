"""Which edges of the teeth a loaded contact reaches."""

import numpy as np
import pytest

from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_design.chosen_relief import beside_edge, loaded_edges
from tests.helpers.contact_cases import shipped_pair
from tests.helpers.loaded_cases import stiffness

COARSE = LoadedSettings(strips=StripSettings(cells_across=16, cells_along=24))


def test_cells_beside_what_a_tooth_does_not_cover_are_at_an_edge_the_ends_of_a_strip_are_not():
    usable = np.ones((4, 5), bool)
    usable[3, 4] = False
    expected = np.zeros((4, 5), bool)
    expected[2:4, 3] = expected[2, 4] = True
    np.testing.assert_array_equal(beside_edge(usable), expected)
    assert not beside_edge(np.ones((3, 3), bool)).any()


@pytest.mark.slow
def test_sharp_tips_carry_where_pairs_enter_and_leave_and_no_edge_does_at_little_load():
    # the shipped pair is sharp: docs/tooth_contact.md has Hertz' pressure at 10 N.m and that of
    # edges from 50 N.m on
    pair = shipped_pair("drive")
    edges = {torque: set() for torque in (10.0, 300.0)}
    for torque, found in edges.items():
        for phase in (0.0, 0.25, 0.5, 0.75):
            state = MeshPosition.at(pair, phase).load(torque, stiffness(), COARSE)
            found |= set(loaded_edges(pair, state))
    assert edges[10.0] == set()
    assert {"pinion tip", "gear tip"} <= edges[300.0]
