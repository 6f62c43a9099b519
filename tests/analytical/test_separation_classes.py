"""Classes of contact loss for motions whose extremes are known."""

import math

import numpy as np

from gearlube.studies.sweep.scalars import DOUBLE_SIDED, NONE, SINGLE_SIDED, separation_class
from tests.helpers.each import each

BACKLASH = 150e-6  # 2b [m]


def classify(mean, amplitude, backlash=BACKLASH):
    """Class of x(t) = mean + amplitude cos t."""
    x = mean + amplitude * np.cos(np.linspace(0.0, 2 * math.pi, 721))
    return separation_class(float(x.min()), float(x.max()), backlash)


@each(
    ("mean_um", "amplitude_um", "expected"),
    [
        (5.0, 4.9, NONE),
        (5.0, 5.1, SINGLE_SIDED),
        (5.0, 154.9, SINGLE_SIDED),
        (5.0, 155.1, DOUBLE_SIDED),
        (-75.0, 70.0, SINGLE_SIDED),  # floats in the gap
        (-75.0, 75.1, DOUBLE_SIDED),
        (-155.0, 4.9, NONE),  # coast flank in contact throughout
        (-155.0, 5.1, SINGLE_SIDED),
        (-155.0, 155.1, DOUBLE_SIDED),
    ],
)
def test_an_oscillation_is_classed_by_the_flanks_it_reaches(mean_um, amplitude_um, expected):
    assert classify(1e-6 * mean_um, 1e-6 * amplitude_um) == expected


@each("amplitude_um", [1.0, 80.0, 200.0])
@each("mean_um", [3.0, -20.0, -75.0, -140.0, -153.0])
def test_driving_and_coasting_are_mirror_images(mean_um, amplitude_um):
    """x -> -2b - x swaps the flanks."""
    mean, amplitude = 1e-6 * mean_um, 1e-6 * amplitude_um
    assert classify(mean, amplitude) == classify(-BACKLASH - mean, amplitude)


def test_a_growing_amplitude_goes_through_the_classes_in_order():
    classes = [classify(5e-6, amplitude) for amplitude in np.linspace(0.0, 300e-6, 61)]
    assert classes == sorted(classes)
    assert set(classes) == {NONE, SINGLE_SIDED, DOUBLE_SIDED}


def test_contact_just_touched_is_contact():
    """Eq. (3): x = 0 is the drive flank in contact, x = -2b the coast flank."""
    assert separation_class(0.0, 5e-6, BACKLASH) == NONE
    assert separation_class(-BACKLASH, 0.0, BACKLASH) == DOUBLE_SIDED
    assert separation_class(-160e-6, -BACKLASH, BACKLASH) == NONE


def test_without_backlash_every_reversal_is_double_sided():
    assert classify(1e-6, 2e-6, backlash=0.0) == DOUBLE_SIDED
    assert classify(3e-6, 2e-6, backlash=0.0) == NONE
