"""Settings that cannot mesh are refused before any work, with what would mesh."""

import re

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from tests.helpers.contact_cases import shipped_file


def test_a_wrong_sliding_base_is_refused_with_the_one_that_meshes(tmp_path):
    wrong = shipped_file().varied({"pinion.machine.sliding_base_mm": 10.647})
    with pytest.raises(ParameterError, match="The flanks cannot mesh") as refusal:
        analyse_contact(wrong, ContactSettings(), store=tmp_path, cache=tmp_path)
    found = re.search(r"sliding_base_mm from 10\.647 to ([\d.]+) mm", str(refusal.value))
    # printed 20.647 mm, with which the reference planes miss each other by 1.6 um
    assert float(found[1]) == pytest.approx(20.647, abs=5e-3)
    assert not list(tmp_path.iterdir())
