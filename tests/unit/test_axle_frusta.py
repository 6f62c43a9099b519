"""Mass and inertia of pinion and gear from the frusta of their blanks and shafts."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.axle_sections import stacked_frusta
from gearlube_core.errors import ParameterError

STEEL = 7850.0  # kg/m3, of the paper
SHAFT = {
    "frusta_lengths_mm": [33.0, 150.0],
    "frusta_first_diameters_mm": [60.0, 40.0],
    "frusta_last_diameters_mm": [85.0, 40.0],
}


def car(pinion=None, **sections):
    data = {"gear_set": {"mesh_table": "mohammadpour_2015"}, "pinion": pinion or {}, **sections}
    return AxleFile.from_data(data, "my.toml").car_axle()


def test_a_hollow_cylinder_has_its_well_known_mass_and_inertia():
    found = stacked_frusta((0.03,), (0.165,), (0.165,), (0.1,), STEEL)
    mass = STEEL * math.pi / 4.0 * (0.165**2 - 0.1**2) * 0.03
    assert found.mass == pytest.approx(mass, rel=1e-13)
    assert found.inertia == pytest.approx(mass / 8.0 * (0.165**2 + 0.1**2), rel=1e-13)


def test_a_cone_has_a_third_of_the_cylinder_and_three_tenths_of_its_mass_as_inertia():
    found = stacked_frusta((0.05,), (0.08,), (1e-12,), (0.0,), STEEL)
    mass = STEEL * math.pi * 0.04**2 * 0.05 / 3.0
    assert found.mass == pytest.approx(mass, rel=1e-10)  # the tip of 1e-12 m
    assert found.inertia == pytest.approx(0.3 * mass * 0.04**2, rel=1e-10)


def test_a_stack_is_the_sum_of_its_discs():
    lengths, first, last = (0.033, 0.15), (0.06, 0.04), (0.085, 0.036)
    bores = (0.0, 0.012)
    mass = inertia = 0.0
    for length, one, two, bore in zip(lengths, first, last, bores, strict=True):

        def radius(x, length=length, one=one, two=two):
            return 0.5 * (one + (two - one) * x / length)

        def disc(x, power, bore=bore, radius=radius):
            return radius(x) ** power - (0.5 * bore) ** power

        mass += STEEL * math.pi * quad(disc, 0.0, length, args=(2,))[0]
        inertia += STEEL * math.pi / 2.0 * quad(disc, 0.0, length, args=(4,))[0]
    found = stacked_frusta(lengths, first, last, bores, STEEL)
    assert found == pytest.approx((mass, inertia), rel=1e-12)  # polynomials: quadrature is exact


def test_what_the_file_does_not_give_is_inferred_from_the_frusta_and_said_so():
    made = car(pinion=SHAFT)
    expected = stacked_frusta((0.033, 0.15), (0.06, 0.04), (0.085, 0.04), (0.0, 0.0), STEEL)
    axle = made.axle
    assert (axle.pinion_mass, axle.pinion_inertia) == pytest.approx(expected, rel=1e-13)
    assert (axle.gear_mass, axle.gear_inertia) == (49.9, 5.81e-2)  # the paper's
    notes = {note.field: note for note in made.assumed}
    for field, unit in (("pinion.mass_kg", "kg"), ("pinion.inertia_kg_m2", "kg.m2")):
        note = notes[field]
        assert (note.origin, note.unit) == ("inferred", unit)
        assert note.why == "2 frusta, density 7850 kg/m3"
    assert notes["gear.mass_kg"].origin == "assumed"
    given = {note.field: note.origin for note in made.inputs}
    assert given["pinion.frusta_lengths_mm"] == "given"


def test_a_given_mass_goes_before_the_frusta_and_the_density_is_that_of_the_steel():
    made = car(pinion=SHAFT | {"mass_kg": 10.5}, steel={"density_kg_m3": 7700.0}).axle
    assert made.pinion_mass == 10.5
    heavier = car(pinion=SHAFT).axle
    assert made.pinion_inertia == pytest.approx(heavier.pinion_inertia * 7700.0 / STEEL, rel=1e-13)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"frusta_last_diameters_mm": [85.0]}, "same number of entries, got 2, 2, 1"),
        ({"frusta_lengths_mm": None}, "same number of entries, got 0, 2, 2"),
        ({"frusta_bores_mm": [0.0]}, "same number of entries, got 2, 2, 2, 1"),
        ({"frusta_bores_mm": [0.0, 40.0]}, "got 40 mm in frustum 2 of 40 and 40 mm"),
        ({"frusta_lengths_mm": [33.0, 0.0]}, "frusta_lengths_mm"),
        ({"frusta_lengths_mm": [0.1, 0.1], "frusta_first_diameters_mm": [1.0, 1.0],
          "frusta_last_diameters_mm": [1.0, 1.0]}, "pinion_(inertia|mass) must be within"),
    ],
)  # fmt: skip
def test_frusta_that_are_no_solid_are_refused(changes, words):
    pinion = {key: one for key, one in (SHAFT | changes).items() if one is not None}
    with pytest.raises(ParameterError, match=words):
        car(pinion=pinion)
