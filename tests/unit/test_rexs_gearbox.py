"""A whole gearbox in REXS as a train file: the e-axle on elastic shafts, written by hand."""

import json
import random
import tomllib
from copy import deepcopy

import pytest
from lxml import etree
from typer.testing import CliRunner

from drivetrain.train.train_file import TrainFile
from gearlube.cli.convert import train_text
from gearlube.command import app
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.rexs.gearbox import read_gearbox
from tests.helpers.each import each
from tests.helpers.gearbox_rexs import e_axle_model

SHIPPED = tomllib.loads(TrainFile.shipped_text("e_axle_elastic"))


@pytest.fixture
def written(tmp_path):
    def write(root):
        path = tmp_path / "axle.rexs"
        path.write_bytes(etree.tostring(root))
        return path

    return write


def same(found, expected):
    """Compare tables whose numbers have the six digits of the shipped file."""
    for name, value in expected.items():
        own = found[name]
        assert own == value if isinstance(value, str | bool) else own == pytest.approx(value, 4e-6)


def test_the_e_axle_in_rexs_has_the_numbers_of_its_train_file(written):
    """Its frequencies are those of another model, see `test_e_axle_elastic`."""
    data = read_gearbox(written(e_axle_model())).data
    for name in ("input", "counter", "output"):
        body, expected = data["bodies"][name], SHIPPED["bodies"][name]
        same(body["material"], expected["material"])
        same(body["sections"][0], expected["sections"][0])
        discs = [sorted(one["discs"], key=lambda disc: disc["mass_kg"]) for one in (body, expected)]
        for one, other in zip(*discs, strict=True):
            same(one, other)
    places = {
        f"{body}.{node}": (body, place)
        for one in (data, SHIPPED)
        for body in ("input", "counter", "output")
        for node, place in one["bodies"][body]["nodes_mm"].items()
    }
    for name, expected in SHIPPED["elements"].items():
        if expected["kind"] not in ("joint", "gear_mesh"):
            continue
        found = dict(data["elements"][name])
        left = "stiffness_n_per_um", "stiffness_waves", "friction", "damping_n_s_per_m"
        expected = {key: value for key, value in expected.items() if key not in left}
        for side in ("first", "second"):
            at, there = (places.get(one.pop(side), "ground") for one in (found, expected))
            assert at == there
        same(found, expected)
    assert data["start"]["torque_n_m"] == {
        "motor": 150.0,
        "load": pytest.approx(-1190.6574, abs=1e-4),  # 150 N.m times the ratio of the teeth
    }
    assert data["start"]["speed_rpm"] == {"output": pytest.approx(6000.0 * 17 * 17 / 31 / 74)}


def test_what_is_assumed_stands_in_the_file_and_can_be_corrected(written):
    found = read_gearbox(written(e_axle_model()))
    text = train_text(found)
    assert tomllib.loads(text) == found.data
    assert "#   elements.stage_1.stiffness_n_per_um: 5" in text
    assert "N/um, that of ISO 6336-1, without waves" in text
    assert "external_load" in text  # a force of a belt alone
    assert "K_xx" not in "".join(one.what for one in found.notes)  # the file has it
    assert TrainFile.from_data(tomllib.loads(text), "file").case().torques["motor"] == 150.0


def changed(*changes):
    """Return the model after changes of attributes, each a name, a shaft or part, and a value."""
    root = e_axle_model()
    for part, name, value in changes:
        for one in root.iterfind(f"components/component[@name='{part}']"):
            for attribute in one.iterfind(f"attribute[@id='{name}']"):
                if value is None:
                    one.remove(attribute)
                else:
                    for child in list(attribute):
                        attribute.remove(child)
                    attribute.text = str(value)
    return root


def test_numbers_that_the_file_lacks_are_assumed_and_listed(written):
    root = changed(
        ("input fixed", "radial_stiffness", None), ("input fixed", "bending_stiffness", 1e15)
    )
    for spectrum in root.findall("load_spectrum"):
        root.remove(spectrum)
    found = read_gearbox(written(root))
    joint = found.data["elements"]["input_fixed"]
    assert (joint["K_xx_n_per_um"], joint["K_ax_n_m_per_rad"]) == (300.0, 1e6)
    said = {one.what: one.why for one in found.notes}
    assert said["elements.input_fixed.K_xx_n_per_um"] == "300 N/um"
    assert "as 1e+12 is rigid" in said["elements.input_fixed.K_ax_n_m_per_rad"]
    assert said["start.speed_rpm of input"] == "1000 rpm"
    assert said["start.torque_n_m.motor"] == "100 N m"
    TrainFile.from_data(found.data, "file")


def test_a_shaft_that_no_bearing_holds_along_its_axis_is_named(written, caplog):
    """Of the input shaft one bearing alone has an axial stiffness."""
    read_gearbox(written(e_axle_model()))
    assert "along the axis" not in caplog.text
    read_gearbox(written(changed(("input fixed", "axial_stiffness", 0))))
    assert "no bearing holds input along the axis" in caplog.text


def test_stages_drive_where_the_power_goes(written):
    """The motor at the output, against its speed: it is driven, and power goes the other way."""
    root = e_axle_model()
    for one in root.iterfind("load_spectrum/load_case/component/attribute"):
        if one.get("id") == "torque_around_u_axis":
            one.text = "-150"
    found = read_gearbox(written(root)).data
    assert found["start"]["torque_n_m"]["load"] == pytest.approx(1190.6574, abs=1e-4)
    ahead = read_gearbox(written(e_axle_model())).data
    assert [ahead["elements"][f"stage_{i}"]["drives_forward"] for i in (1, 2)] == [True, False]
    TrainFile.from_data(found, "file")


def test_without_places_of_the_shafts_stages_say_where_gears_are(written):
    root = changed(*((one, "support_vector", None) for one in ("input", "counter", "output")))
    stage = root.find("components/component[@name='stage 1']")
    angle = etree.SubElement(stage, "attribute", id="rotating_angle_around_neg_u_axis", unit="deg")
    angle.text = "130"  # from w about -u, towards v and on
    found = read_gearbox(written(root))
    assert found.data["elements"]["stage_1"]["azimuth_deg"] == pytest.approx(-40.0)
    assert found.data["elements"]["stage_2"]["azimuth_deg"] == pytest.approx(90.0)
    said = {one.what for one in found.notes if one.kind == "lacking"}
    assert {"places of shafts", "elements.stage_2.azimuth_deg"} <= said
    TrainFile.from_data(found.data, "file")


def test_a_cone_is_cylinders_of_nearly_its_mass(written):
    root = e_axle_model()
    section = root.find("components/component[@type='shaft_section']")
    section.find("attribute[@id='outer_diameter_end']").text = "60"
    parts = read_gearbox(written(root)).data["bodies"]["input"]["sections"]
    assert (parts[0]["start_mm"], parts[-1]["end_mm"]) == (0.0, 290.0)
    areas = sum((p["end_mm"] - p["start_mm"]) * p["outer_diameter_mm"] ** 2 for p in parts)
    cone = 290.0 * (40.0**2 + 40.0 * 60.0 + 60.0**2) / 3.0
    assert areas == pytest.approx(cone, rel=(20.0 / 4) ** 2 / 12.0 / 50.0**2 * 1.1)  # midpoints


def as_json(root):
    """Return the model as REXS JSON, with arrays and a load case."""

    def components(parent):
        return [
            {"id": int(one.get("id")), "type": one.get("type"), "name": one.get("name") or "",
             "attributes": [value(of) for of in one]}
            for one in parent
        ]  # fmt: skip

    def value(of):
        array = [float(c.text) for c in of.iterfind(".//c")]
        own = {"floating_point_array": array} if array else {"floating_point": of.text}
        if of.text == "false":
            own = {"boolean": False}
        return {"id": of.get("id"), "unit": of.get("unit")} | own

    relations = [
        {"id": int(one.get("id")), "type": one.get("type"),
         "refs": [{"id": int(ref.get("id")), "role": ref.get("role")} for ref in one]}
        for one in root.find("relations")
    ]  # fmt: skip
    cases = [{"id": 1, "components": components(root.find("load_spectrum/load_case"))}]
    model = {
        "version": "1.4", "applicationId": "by hand", "relations": relations,
        "components": components(root.find("components")),
        "load_spectrum": {"id": 1, "load_cases": cases},
    }  # fmt: skip
    return json.dumps({"model": model})


def test_json_is_read_as_xml_is_with_places_and_load_case(written, tmp_path):
    expected = read_gearbox(written(e_axle_model())).data
    path = tmp_path / "axle.rexsj"
    path.write_text(as_json(e_axle_model()), encoding="utf-8")
    found = read_gearbox(path).data
    assert {**found, "source": ""} == {**expected, "source": ""}


def with_kind(part, kind):
    root = e_axle_model()
    root.find(f"components/component[@name='{part}']").set("type", kind)
    return root


@each(
    "root, words",
    [
        (with_kind("stage 2", "planetary_stage"), "cylindrical stages alone, got planetary_stage"),
        (changed(("input", "u_axis_vector", "0 1 0")), "Shafts must lie along one u axis"),
        (changed(("input", "support_vector", "0 1")), "support_vector of shaft .* three numbers"),
        (changed(("input", "support_vector", "0 nan 1")), "support_vector .* three numbers"),
        (changed(("input", "u_axis_vector", "0 0 0")), "u_axis_vector .* must have a length"),
        (changed(("input", "w_axis_vector", "1 0 1")), "w_axis_vector .* at right angles"),
        (changed(("steel", "poisson_ratio", -1)), "poisson_ratio of .* within 0 to 0.5, got -1"),
        (changed(("wheel 1", "face_width", 1e9)), "wheel 1.*, as a ring .*: mass must be within"),
        (changed(("counter", "support_vector", "0 0 9")), "must stand 81.545 mm apart"),
        (changed(("wheel 1", "u_coordinate_on_shaft", None)), "lacks 1 .*: u_coordinate_on_shaft"),
        (changed(("wheel 1", "u_coordinate_on_shaft", 500)), "shaft_section of counter below"),
        (with_kind("input", "other"), "an assembly of a shaft and cylindrical_gear"),
        (with_kind("stage 1", "other"), "some that input does not reach"),
        (
            changed(("input end", "radial_stiffness", "x")),
            "radial_stiffness .* must be a number",
        ),
        (changed(("input end", "radial_stiffness", 0)), "input end.* must be above 0, got 0 N/m"),
    ],
)
def test_a_gearbox_that_is_no_train_is_refused(root, words, tmp_path):
    path = tmp_path / "axle.rexs"
    path.write_bytes(etree.tostring(root))
    with pytest.raises(ParameterError, match=words):
        read_gearbox(path)


def test_the_length_of_axis_vectors_does_not_matter(written):
    """They are directions, such as 1000 mm in a file with unit m."""
    names = [(one, "u_axis_vector", "1000 0 0") for one in ("input", "counter", "output")]
    longer = read_gearbox(written(changed(*names, ("input", "w_axis_vector", "0 0 2"))))
    assert longer.data["bodies"] == read_gearbox(written(e_axle_model())).data["bodies"]


def test_a_damaged_gearbox_is_read_or_refused_in_words(tmp_path):
    """Elements that are gone, twice or wrong; line breaks in names do not leave the comments."""
    rng, path, refused = random.Random(5), tmp_path / "axle.rexs", 0
    for _ in range(25):
        root = e_axle_model()
        one = rng.choice([part for part in root.iter() if part is not root])
        match rng.randrange(4):
            case 0:
                one.getparent().remove(one)
            case 1:
                one.getparent().append(deepcopy(one))
            case 2:
                one.text = rng.choice(["", "0", "-5", "1e308", "nan", "x", "1 2 3"])
            case _:
                one.set(
                    rng.choice(list(one.attrib) or ["id"]), rng.choice(["", "x", "-1", 'a\n"b'])
                )
        path.write_bytes(etree.tostring(root))
        try:
            found = read_gearbox(path)
            assert tomllib.loads(train_text(found)).keys() == found.data.keys()
            TrainFile.from_data(found.data, "file")
        except GearLubeError:
            refused += 1
    assert 0 < refused < 25


def test_the_command_writes_a_train_file(written, tmp_path, caplog):
    path, out = str(written(e_axle_model())), tmp_path / "axle.toml"
    done = CliRunner().invoke(app, ["convert", path, "--train", "--out", str(out)])
    assert done.exit_code == 0, done.output
    assert "these values were assumed:" in done.output
    assert f"Next: gearlube drivetrain {out}" in caplog.text
    assert len(TrainFile.from_toml(out).case().train.elements) > 10
    wrong = CliRunner().invoke(app, ["convert", path, "--train", "--stage", "1", "--overwrite"])
    assert wrong.exit_code == 2
