"""Which edges carry, from the highest pressures over the gear flank."""

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.contact.summary import edge_warnings
from gearlube_core.tooth_contact.sharp_edge import edges_that_carry


def contact(edge=None, pressure=1.0):
    """Pressures of a band from (6, 10) to (20, 40) on 24 x 48 cells, with one cell at an edge."""
    s, t = np.meshgrid(np.arange(24), np.arange(48), indexing="ij")
    inside = 1.0 - ((s - 13.0) / 8.0) ** 2 - ((t - 25.0) / 16.0) ** 2
    found = 1.2e9 * np.sqrt(np.maximum(inside, 0.0))
    if edge is not None:
        found[edge] = pressure * found.max()
    return found


@pytest.mark.parametrize(
    ("edge", "name"),
    [((23, 30), "gear tip"), ((2, 20), "pinion tip"), ((12, 0), "toe"), ((12, 47), "heel")],
)
def test_an_edge_carries_where_the_highest_pressure_is(edge, name):
    assert edges_that_carry(contact()) == {}
    assert edges_that_carry(contact(edge, 1.1)) == {name: pytest.approx(1.1 * 1.2e9, rel=0.01)}
    assert edges_that_carry(contact(edge, 0.5)) == {}


def test_the_torque_from_which_on_an_edge_carries_is_named_once():
    maps = [contact(), contact((23, 30), 1.1), contact((23, 30), 2.0)]
    sound = [contact()] * 3
    found = edge_warnings(
        xr.Dataset(
            {"pressure_map": (("side", "torque", "s", "t"), np.array([maps, sound]))},
            coords={"side": ["drive", "coast"], "torque": [50.0, 150.0, 300.0]},
        )
    )
    assert len(found) == 1
    assert "from 150 N.m on a sharp edge carries, at the gear tip" in found[0]
    assert "gear.drive_flank.tip_relief_um" in found[0]
