"""Compliances on disk: found again, told apart, mended."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.storage.folders import FOLDER_VARIABLE
from gearlube_core.tooth_compliance import tooth_body
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings, tooth_compliance
from tests.helpers.compliance_cases import COARSE, spiral_tooth

SETTINGS = CondensationSettings(profile_hats=3, lengthwise_hats=4, density=COARSE)
TOOTH = spiral_tooth(neighbour_pitches=0.5, base_depth=8e-3)


def same(a, b):
    return all(
        np.array_equal(getattr(x, name), getattr(y, name))
        for x, y in zip(a, b, strict=True)
        for name in ("s", "t", "image", "elastic")
    )


@pytest.fixture(scope="module")
def computed():
    return tooth_compliance(TOOTH, STEEL, SETTINGS)


@pytest.fixture
def counted(monkeypatch, computed):
    """Calls that would compute; the result is known."""
    calls = []

    def counting(*arguments):
        calls.append(arguments)
        return computed

    monkeypatch.setattr(tooth_body, "tooth_compliance", counting)
    return calls


def test_the_second_call_reads_the_first_ones_result(tmp_path, counted):
    first = tooth_body.cached_tooth_compliance(TOOTH, STEEL, SETTINGS, tmp_path)
    second = tooth_body.cached_tooth_compliance(TOOTH, STEEL, SETTINGS, tmp_path)
    assert len(counted) == 1
    assert same(first, second)
    assert [p.suffix for p in tooth_body.cache_folder(tmp_path).iterdir()] == [".npz"]


def test_a_damaged_file_is_computed_and_written_anew(tmp_path, counted):
    first = tooth_body.cached_tooth_compliance(TOOTH, STEEL, SETTINGS, tmp_path)
    (path,) = tooth_body.cache_folder(tmp_path).iterdir()
    whole = path.read_bytes()
    for damage in (
        b"",
        b"not a zip",
        whole[: len(whole) // 2],
        whole[:600] + b"x" * 200 + whole[800:],
    ):
        path.write_bytes(damage)
        assert same(first, tooth_body.cached_tooth_compliance(TOOTH, STEEL, SETTINGS, tmp_path))
        assert path.read_bytes() != damage
    assert len(counted) == 5


def test_every_input_that_matters_changes_the_key():
    key = tooth_body.compliance_key(TOOTH, STEEL, SETTINGS)
    assert key == tooth_body.compliance_key(
        spiral_tooth(neighbour_pitches=0.5, base_depth=8e-3), STEEL, SETTINGS
    )
    left = TOOTH.left.copy()
    left[3, 4, 1] += 1e-12
    others = [
        tooth_body.compliance_key(TOOTH, replace(STEEL, youngs_modulus=200e9), SETTINGS),
        tooth_body.compliance_key(TOOTH, replace(STEEL, poisson_ratio=0.29), SETTINGS),
        tooth_body.compliance_key(replace(TOOTH, left=left), STEEL, SETTINGS),
        tooth_body.compliance_key(replace(TOOTH, base_depth=8.1e-3), STEEL, SETTINGS),
        tooth_body.compliance_key(replace(TOOTH, teeth=37), STEEL, SETTINGS),
        tooth_body.compliance_key(TOOTH, STEEL, replace(SETTINGS, profile_hats=5)),
        tooth_body.compliance_key(
            TOOTH, STEEL, replace(SETTINGS, density=replace(COARSE, fillet=4))
        ),
    ]
    assert len({key, *others}) == len(others) + 1


def test_density_of_the_material_does_not_change_the_key():
    key = tooth_body.compliance_key(TOOTH, STEEL, SETTINGS)
    assert key == tooth_body.compliance_key(TOOTH, replace(STEEL, density=7700.0), SETTINGS)


def test_the_environment_chooses_the_folder(tmp_path, monkeypatch):
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path))
    assert tooth_body.cache_folder() == tmp_path / "tooth_compliance"
    assert tooth_body.cache_folder(tmp_path / "own") == tmp_path / "own" / "tooth_compliance"
    monkeypatch.delenv(FOLDER_VARIABLE)
    assert "gearlube" in str(tooth_body.cache_folder())
