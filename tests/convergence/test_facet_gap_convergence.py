"""Faceted flanks approach smooth ones with the square of the number of facets."""

import numpy as np
import pytest

from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap
from tests.helpers.jamali_2015 import jamali_2015, jamali_2015_steps


@pytest.mark.parametrize("form", ["involute", "parabola"])
def test_faceted_gap_tends_to_the_smooth_gap_with_the_square_of_the_count(form):
    X = float(jamali_2015_steps("a").line(300))
    x, y = np.linspace(-3e-4, 3e-4, 301)[:, None], np.linspace(-5e-3, 5e-3, 21)[None, :]
    smooth = UndeformedGap(modified=jamali_2015("a"), form=form).heights(x, y, X)
    errors = []
    for count in (20, 40, 80, 160):
        faceted = UndeformedGap(modified=jamali_2015("a", facets=count), form=form)
        difference = faceted.heights(x, y, X) - smooth
        # chords of a convex flank lie in its material; the parabola's facets to 2 % of a sagitta
        assert difference.min() > (-1e-12 if form == "involute" else -2e-8)
        errors.append(difference.max())
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    # facets shift against the grid from count to count
    assert ratios == pytest.approx(4.0, rel=0.05)
    # both flanks' sagittas coincide somewhere: twice 0.72 um at 20 facets
    assert errors[0] == pytest.approx(1.45e-6, rel=0.05)


def test_section_iteration_leaves_less_than_a_picometre(monkeypatch):
    from gearlube_core.helical_geometry import undeformed_gap

    X = float(jamali_2015_steps("a").line(300))
    x, y = np.linspace(-5e-4, 5e-4, 41)[:, None], np.linspace(-23e-3, 23e-3, 41)[None, :]
    gap = UndeformedGap(modified=jamali_2015("a", k=0.0))
    usual = gap.heights(x, y, X)
    monkeypatch.setattr(undeformed_gap, "_SECTION_STEPS", 8)
    # measured 3e-13 m where relief is deepest; films are 1e-7 m
    assert gap.heights(x, y, X) == pytest.approx(usual, abs=1e-12)
