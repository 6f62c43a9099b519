"""Laws of bearing friction by their table, and what geometry and conditions refuse."""

from __future__ import annotations

from dataclasses import replace

import pytest

from gearlube.studies.bearing.figures import LAW_NAMES
from gearlube_core.bearings.followed_shaft import BEARING_LAWS, TORQUE_LOSSES
from gearlube_core.bearings.losses import laws
from gearlube_core.bearings.losses.geometry import Rib
from gearlube_core.bearings.losses.loss import UNCALIBRATED, LossModel
from gearlube_core.errors import ParameterError
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.bearing_32216 import BEARING, DEG, loss_at
from tests.helpers.each import each

OIL = lubricant_state(Lubricant.named("fva_3").parameters(), 323.15)
CONTACT = (9.8e-3, 6e4, 2.3e11, 0.05, 2.1e-8, 1.4)


@each(
    ("changes", "words"),
    [
        ({"n_rollers": 21}, ["overlap", "21 rollers", "at most 19 fit"]),
        ({"inner_angle": 17.0 * DEG}, ["wrong side", "15.64", "17", "11.44 deg"]),
        # a pair of angles that has been printed for this bearing
        (
            {"outer_angle": 14.17 * DEG, "inner_angle": 11.50 * DEG},
            ["share their apex", "8.5 mm", "10.36 deg"],
        ),
        ({"pitch_diameter": 0.125}, ["between bore and outside diameter", "140 mm"]),
        ({"series": "999"}, ["series", "322"]),
        ({"rib": Rib(contact_height=0.018)}, ["contact_height", "18 mm"]),
    ],
)
def test_wrong_geometry_is_refused_with_its_cure(changes, words):
    with pytest.raises(ParameterError) as refusal:
        replace(BEARING, **changes)
    assert all(word in str(refusal.value) for word in words), str(refusal.value)


@each(
    ("condition", "words"),
    [
        ({"temperature_degc": 130.0}, ["temperature", "393.15 K", "fva_3"]),
        ({"radial_load": 20000.0}, ["axial_load must be at least 6999 N", "More"]),
        ({"axial_load": 2e6}, ["pressure", "4 GPa", "At most"]),
        ({"rpm": 20000.0}, ["speed", "1.382e+04 rpm"]),
        ({"law": "skf", "heating": "aihara"}, ["takes no heating"]),
        ({"law": "solved_films", "heating": "aihara"}, ["heated by themselves", "got aihara"]),
        ({"law": "harris"}, ["law must be one of", "zhou_hoeprich"]),
    ],
)
def test_conditions_beyond_the_range_are_refused_with_their_limit(condition, words):
    with pytest.raises(ParameterError) as refusal:
        loss_at(**({"rpm": 1000.0} | condition))
    assert all(word.lower() in str(refusal.value).lower() for word in words), str(refusal.value)


def test_starved_contacts_lose_less_than_flooded_ones():
    flooded = loss_at(1000, law="biboulet_houpert")
    starved = loss_at(1000, law="biboulet_houpert", inlet_layer=5e-6)
    assert starved.parts["rolling"] < 0.7 * flooded.parts["rolling"]
    assert starved.parts["rib"] == flooded.parts["rib"]
    assert LossModel().inlet_layer == 0.0


def test_a_law_of_rolling_is_known_everywhere_by_its_line_in_the_table():
    names = [one.name for one in laws.ROLLING]
    assert names == list(laws.ROLLING_LAWS)
    for code, one in enumerate(laws.ROLLING):
        assert laws.ROLLING_LAWS[one.name] == code != laws.SOLVED_FILMS
        assert laws.rolling_force(code, *CONTACT) == one.force(*CONTACT)
        assert laws.usual_heating(code) == laws.HEATINGS[one.heating]
        assert UNCALIBRATED[one.name] == one.factor
        assert LAW_NAMES[one.name] == one.words
        if one.in_axle:
            assert BEARING_LAWS[one.in_axle] == one.name
            assert one.in_axle in TORQUE_LOSSES
    assert LAW_NAMES["zhou_hoeprich"] == "Zhou and Hoeprich"
