"""Ratings in REXS files: a load case with load, stresses, factors and safeties."""

import math

import pytest
from lxml import etree

import gearlube as gl
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.rating.bevel_mesh import BevelMesh
from gearlube_core.rexs.document import RatedLoad
from gearlube_core.rexs.exchange import read_rexs, write_rexs


def rated(**factors):
    file = HelicalGearFile.named("he_2007")
    gear = gl.rating.RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)
    rating = gl.rating.cylindrical_rating(
        file.helical_pair(), (gear, gear), gl.rating.LoadFactors(**factors), pinion_torque=300.0,
        pinion_speed=200.0, cycles=(5e7, 5e7), oil_viscosity=100e-6,
    )  # fmt: skip
    return file, RatedLoad(rating, 300.0, 200.0)


def load_case(path):
    """The numbers of the load case by type, of pinion and gear in turn, and their units."""
    found, units = {}, {}
    for one in etree.parse(path).findall("load_spectrum/load_case/component"):
        for attribute in one:
            found.setdefault(attribute.get("id"), []).append(float(attribute.text))
            units[attribute.get("id")] = attribute.get("unit")
    return found, units


def test_a_rating_is_written_with_its_load_and_the_factors_that_explain_its_stresses(tmp_path):
    file, load = rated(face=1.1, application=1.25)
    write_rexs(file, tmp_path / "pair.rexs", load)
    found, units = load_case(tmp_path / "pair.rexs")
    # 200 rad/s; 25 and 31 teeth; what the pinion's shaft gives, that of the gear takes
    assert found["rotational_speed"] == pytest.approx([1909.8593, -1540.2091], rel=1e-7)
    assert found["torque_acting_on_shaft_u"] == pytest.approx([-300.0, -372.0], rel=1e-12)
    (nominal,) = found["nominal_contact_stress_iso_6336_2006"]
    K = {
        name: found[f"{name}_iso_6336_2006"][0]
        for name in (
            "application_factor", "mesh_load_factor", "dynamic_factor",
            "face_load_factor_contact_stress", "transverse_load_factor_contact_stress",
            "face_load_factor_root_stress", "transverse_load_factor_root_stress",
        )
    }  # fmt: skip
    both = K["application_factor"] * K["mesh_load_factor"] * K["dynamic_factor"]
    of_flank = K["face_load_factor_contact_stress"] * K["transverse_load_factor_contact_stress"]
    of_root = K["face_load_factor_root_stress"] * K["transverse_load_factor_root_stress"]
    stress = found["contact_stress_iso_6336_2006"]
    # ISO 6336-2 (4) and 6336-3 (5); 12 digits are written. Z_B and Z_D of these teeth are 1
    assert stress == pytest.approx([nominal * math.sqrt(both * of_flank)] * 2, rel=1e-10)
    assert units["contact_stress_iso_6336_2006"] == "N / mm^2"
    assert found["tooth_root_stress_iso_6336_2006"] == pytest.approx(
        [both * of_root * one for one in found["nominal_tooth_root_stress_iso_6336_2006"]],
        rel=1e-10,
    )
    safety = found["safety_factor_pitting_iso_6336_2006"]
    strengths = [1e-6 * one for one in load.rating.contact_strength]
    assert [a * b for a, b in zip(safety, stress, strict=True)] == pytest.approx(strengths)


def test_a_file_with_results_gives_the_same_pair_and_says_that_they_are_left_out(tmp_path):
    file, load = rated(face=1.1)
    write_rexs(file, tmp_path / "plain.rexs")
    write_rexs(file, tmp_path / "rated.rexs", load)
    plain, rated_one = (read_rexs(tmp_path / f"{name}.rexs") for name in ("plain", "rated"))
    assert rated_one.file.helical_pair() == plain.file.helical_pair()
    assert "load_spectrum" in {one.what for one in rated_one.notes if one.kind == "left out"}
    versions = [etree.parse(tmp_path / f"{one}.rexs").getroot().get("version")
                for one in ("plain", "rated")]  # fmt: skip
    assert versions == ["1.4", "1.7"]


def test_a_rating_of_other_gears_is_refused(tmp_path):
    _, load = rated(face=1.1)
    with pytest.raises(ParameterError, match="bevel_stage must be by ISO 10300, got ISO 6336"):
        write_rexs(BlankFile.named("hypoid_13_42"), tmp_path / "pair.rexs", load)


def test_a_bevel_pair_is_rated_by_iso_10300_with_a_nominal_stress_of_each_gear(tmp_path):
    file = BlankFile.named("hypoid_13_42")
    mesh = BevelMesh.of_blank(DesignedBlank.from_file(file).blank)
    gear = gl.rating.RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)
    rating = gl.rating.bevel_rating(
        mesh, (gear, gear), gl.rating.LoadFactors(face=1.5),
        pinion_torque=200.0, pinion_speed=150.0, cycles=(5e7, 5e7), oil_viscosity=100e-6,
    )  # fmt: skip
    write_rexs(file, tmp_path / "pair.rexs", RatedLoad(rating, 200.0, 150.0))
    found, _ = load_case(tmp_path / "pair.rexs")
    # 13 and 42 teeth; each shaft turns about an axis of its own
    assert found["rotational_speed"] == pytest.approx([1432.3945, 443.3602], rel=1e-7)
    assert found["torque_acting_on_shaft_u"] == pytest.approx([-200.0, 646.15385], rel=1e-7)
    K = [found[f"{name}_iso_10300_2023"][0] for name in (
        "application_factor", "dynamic_factor", "face_load_factor_contact_stress",
        "transverse_load_factor_pitting")]  # fmt: skip
    nominal = found["nominal_contact_stress_iso_10300_2023"]
    stress = found["contact_stress_iso_10300_2023"]
    assert stress == pytest.approx([math.sqrt(math.prod(K)) * one for one in nominal], rel=1e-10)
