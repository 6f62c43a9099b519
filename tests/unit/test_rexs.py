"""REXS files of pairs: round trips, files written by hand, and files that are wrong."""

import json
import math
import zipfile

import pytest
from lxml import etree
from typer.testing import CliRunner

from gearlube.command import app
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.rexs.exchange import read_rexs, write_rexs
from tests.helpers.rexs_files import CENTRED, CENTRES, CYLINDRICAL, SAMPLES, TIPLESS, TIPS, bevel


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "pair.rexs"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def notes(pair, kind):
    return {note.what: note.why for note in pair.notes if note.kind == kind}


@pytest.mark.parametrize("name", HelicalGearFile.shipped())
def test_the_macro_geometry_of_helical_pairs_comes_back(name, tmp_path):
    file = HelicalGearFile.named(name)
    write_rexs(file, tmp_path / "pair.rexs")
    back, own = read_rexs(tmp_path / "pair.rexs").file.helical_pair(), file.helical_pair()
    for field in own.__dataclass_fields__:
        value = getattr(own, field)  # 12 digits are written
        exact = field in ("name", "profile_shift")
        expected = value if exact else pytest.approx(value, rel=1e-11)
        assert getattr(back, field) == expected, field


def test_a_blank_comes_back(tmp_path):
    file = BlankFile.named("hypoid_13_42")
    write_rexs(file, tmp_path / "pair.rexs")
    back = read_rexs(tmp_path / "pair.rexs").file
    assert (back.pair, back.cutter, back.design_method) == (file.pair, file.cutter, 1)
    # nine digits of the factors that follow from heights
    assert back.depth.depth_factor == pytest.approx(file.depth.depth_factor, abs=1e-9)
    assert back.gear_addendum_factor == pytest.approx(file.gear_addendum_factor, abs=1e-9)
    assert back.depth.clearance_factor == pytest.approx(file.depth.clearance_factor, abs=1e-9)


def test_the_hand_comes_back(tmp_path):
    file = BlankFile.named("hypoid_13_42").varied({"pair.pinion_hand": "left"})
    write_rexs(file, tmp_path / "pair.rexs")
    hands = etree.parse(tmp_path / "pair.rexs").findall(
        ".//attribute[@id='spiral_angle_pitch_direction']"
    )
    assert [one.text for one in hands] == ["left", "right"]
    assert read_rexs(tmp_path / "pair.rexs").file.pair.pinion_hand == "left"


def test_every_field_of_a_gear_file_is_written_or_named(tmp_path):
    left_out = write_rexs(HypoidGearFile.named("mohammadpour_2015"), tmp_path / "pair.rexs")
    named = {note.what: note.why for note in left_out}
    assert "tilt_angle_deg 31.736" in named["pinion.machine"]
    assert named["gear.cutter"] == "blade_edge_radius_mm 762.0"
    tree = etree.parse(tmp_path / "pair.rexs")
    gears = tree.findall(".//component[@type='bevel_gear']")
    offset = tree.find(".//attribute[@id='hypoid_offset']")
    assert [one.find("attribute[@id='number_of_teeth']").text for one in gears] == ["13", "36"]
    assert (offset.text, offset.get("unit")) == ("24", "mm")


def test_a_file_by_hand_in_other_units(written):
    pair = read_rexs(written(CYLINDRICAL))
    file = pair.file
    assert (file.name, file.pinion.teeth, file.gear.teeth) == ("output stage", 20, 41)
    assert file.pair.centre_distance_mm == pytest.approx(CENTRES)
    assert file.pair.helix_angle_deg == pytest.approx(15.0)
    assert file.pair.normal_pressure_angle_deg == 20.0
    assert file.pair.face_width_mm == 30.0  # the narrower one
    assert [file.pinion.tip_diameter_mm, file.gear.tip_diameter_mm] == pytest.approx(TIPS)
    # standard pair: the working pressure angle is that of the rack
    geometry = file.helical_pair()
    assert geometry.working_pressure_angle == pytest.approx(geometry.transverse_pressure_angle)


def test_what_is_lacking_and_what_is_left_out_is_said(written):
    pair = read_rexs(written(CYLINDRICAL))
    assert "the narrower face" in notes(pair, "inferred")["pair.face_width_mm"]
    assert "profile" in notes(pair, "inferred")["gear.tip_diameter_mm"]
    assert notes(pair, "lacking")["pair"] == (
        "backlash_mm none, fillet_radius_factor 0.25, reduced_modulus_gpa none"
    )
    assert notes(pair, "lacking")["pinion.bearing_1"] == "no such section"
    left_out = notes(pair, "left out")
    assert left_out["cylindrical_gear 3"] == "u_coordinate_on_shaft"
    assert {"lubricant", "gear_unit", "load_spectrum", "hand"} <= left_out.keys()


@pytest.mark.parametrize("role", ["3", "4"])
def test_heights_are_read_where_both_gears_have_them(role, written):
    """2 mm of one gear and 3 mm of the other: the gear's share of 5 mm is 3/5 or 2/5."""
    height = '<attribute id="mean_addendum" unit="mm">{}</attribute></component>'
    tail = "</component>"

    def higher(text, number, value):
        begin = text.index(f'<component id="{number}" type="bevel_gear">')
        end = text.index(tail, begin)
        return text[:end] + height.format(value) + text[end + len(tail) :]

    text = higher(bevel(*SAMPLES[1]), role, 2.0)
    alone = read_rexs(written(text))
    assert "mean_addendum of both gears is absent" in notes(alone, "lacking")["depth"]
    both = read_rexs(written(higher(text, {"3": "4", "4": "3"}[role], 3.0)))
    share = 3.0 / 5.0 if role == "3" else 2.0 / 5.0
    assert both.file.depth.gear_addendum_factor == pytest.approx(share, abs=1e-9)


@pytest.mark.parametrize("method", SAMPLES)
def test_the_method_of_a_printed_sample_is_found_from_its_cones(method, written):
    """ISO 23509, annex F: each sample is computed by another method."""
    sample = SAMPLES[method]
    pair = read_rexs(written(bevel(*sample)))
    assert pair.file.design_method == method
    assert pair.file.cutter.drive_pressure_angle_deg == 20.0
    agreed = notes(pair, "inferred")
    # sample F.4 stops 0.09 deg short of its own condition, see test_iso_23509_samples
    assert "mean_addendum" in notes(pair, "lacking")["depth"]
    angles = {"mean_spiral_angle"} if method == 2 else {"mean_spiral_angle", "pitch_angle"}
    for role in ("pinion", "gear"):
        assert angles <= set(agreed[f"the blank's {role}"].partition(": ")[2].split(", "))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('unit="m">', 'unit="kg">', "center_distance of cylindrical_stage 2 .* unit out of mm"),
        ('unit="rad">', 'unit="mm">', "helix_angle_reference_diameter .* unit out of deg"),
        ('"center_distance"', '"centre"', r"pair.centre_distance_mm \(REXS: center_distance"),
        ('"tip_diameter"', '"tip"', "(?s)lacks|tip_diameter"),
        (">-15<", ">15<", "equal and opposite"),
        (">41<", ">41.5<", "whole number, got 41.5"),
        (">41<", ">many<", "must be a number, got 'many'"),
        ('id="4" type="cylindrical_gear"', 'id="4" type="ring_gear"', "Internal gears"),
        ('type="cylindrical_stage"', 'type="worm_stage"', "got worm_stage 2 .*other kinds"),
        ('role="gear_2"', 'role="gear"', "gear_1 and gear_2"),
        ('version="1.4"', 'version="2.0"', "REXS 1.4"),
        ("<model", "<modul", "not a readable XML file"),
        ('id="4" role="gear_1"', 'role="gear_1"', "whole number as its id"),
    ],
)  # fmt: skip
def test_a_wrong_file_is_refused_with_what_to_do(old, new, message, written):
    text = CYLINDRICAL.replace(old, new, 1)
    if old == '"tip_diameter"':
        text = text.replace("addendum_modification", "other", 2).replace(TIPLESS, CENTRED)
    with pytest.raises(ParameterError, match=message):
        read_rexs(written(text))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (">90<", ">80<", "shaft_angle .* must be 90 deg, got 80"),
        (">15.0<", ">-15.0<", "hypoid_offset .* at least 0 mm"),
        ('"cutter_radius"', '"cutter"', r"cutter.radius_mm \(REXS: cutter_radius"),
        ('"outer_pitch_diameter"', '"outer"', ""),
    ],
)
def test_a_wrong_bevel_stage_is_refused_with_what_to_do(old, new, message, written):
    path = written(bevel(*SAMPLES[1]).replace(old, new, 1))
    if not message:  # then the mean diameter does
        assert read_rexs(path).file.design_method == 2
        return
    with pytest.raises(ParameterError, match=message):
        read_rexs(path)


def test_tapered_teeth_are_named(written):
    face = '<attribute id="face_angle" unit="deg">69.323</attribute>'
    text = bevel(*SAMPLES[1]).replace(
        "</component></components>", f"{face}</component></components>"
    )
    left_out = notes(read_rexs(written(text)), "left out")
    assert "equally deep" in left_out["face_angle of bevel_gear 4"]


def test_the_command_converts_there_and_back(tmp_path, monkeypatch, caplog):
    monkeypatch.chdir(tmp_path)
    run = CliRunner()
    assert run.invoke(app, ["convert", "he_2007"]).exit_code == 0
    back = run.invoke(app, ["convert", "he_2007.rexs", "--out", "mine.toml"])
    assert back.exit_code == 0
    assert "Not in the REXS file" in back.output
    # REXS has no [operation], without which the next command needs the load
    assert "gearlube helical mine.toml --torque N_M --speed-rpm RPM" in caplog.text
    file = HelicalGearFile.from_toml("mine.toml")
    assert file.helical_pair().ratio == 1.24
    again = run.invoke(app, ["convert", "he_2007.rexs", "--out", "mine.toml"])
    assert again.exit_code == 2  # it is there already


def test_numbers_that_the_file_lacks_can_be_given(tmp_path, written, monkeypatch, caplog):
    text = CYLINDRICAL.replace("addendum_modification", "other").replace(TIPLESS, CENTRED)
    monkeypatch.chdir(tmp_path)
    path = str(written(text))
    run = CliRunner()
    assert run.invoke(app, ["convert", path]).exit_code == 2
    assert not (tmp_path / "pair.toml").exists()
    caplog.clear()
    assert run.invoke(app, ["convert", path, "--set", "gear.tip_diametr_mm=1"]).exit_code == 2
    wrong = "gear.tip_diametr_mm is not a field of this file; is it gear.tip_diameter_mm?"
    assert caplog.messages[0].startswith(wrong)
    given = f"gear.tip_diameter_mm={TIPS[1]}"
    ended = run.invoke(app, ["convert", path, "--set", given, "pair.backlash_mm=0.1"])
    assert ended.exit_code == 0
    taken, _, by_set = ended.output.partition("Given by --set:")
    assert "Taken from the REXS file:" in taken
    assert "gear.tip_diameter_mm" not in taken
    assert f"gear.tip_diameter_mm: {TIPS[1]:g}" in by_set
    assert "pair.backlash_mm: 0.1" in by_set
    assert HelicalGearFile.from_toml("pair.toml").pair.backlash_mm == 0.1


def shifted(x, more=""):
    """The stage by hand with profile shifts (pinion, gear) and other attributes of the flanks."""
    text = CYLINDRICAL.replace(
        f'<attribute id="tip_diameter" unit="mum">{1e3 * TIPS[0]}</attribute>', ""
    )
    for number, value in zip((5, 6, 7, 8), (x[0], x[0], x[1], x[1]), strict=True):
        start = text.index(f'<component id="{number}"')
        old = '_modification_coefficient" unit="none">0<'
        text = text[:start] + text[start:].replace(old, old.replace(">0<", f">{value}<") + more, 1)
    return text


def test_profile_shifts_of_flanks_make_thickness_backlash_and_tips(written):
    """Tips d + 2 m (x + 1), thickness m (pi/2 + 2 x tan 20 deg)/cos 15 deg."""
    pair = read_rexs(written(shifted((0.3, -0.35)))).file.helical_pair()
    cos = math.cos(math.radians(15.0))
    assert pair.profile_shifts == (0.3, -0.35)
    for z, x, tip, arc in zip(
        (20, 41), (0.3, -0.35), (pair.pinion_tip_radius, pair.gear_tip_radius),
        pair.tooth_thickness, strict=True,
    ):  # fmt: skip
        assert 2e3 * tip == pytest.approx(4.0 * z / cos + 8.0 * (1.0 + x), rel=1e-12)
        expected = 4.0 * (0.5 * math.pi + 2.0 * x * math.tan(math.radians(20.0))) / cos
        assert 1e3 * arc == pytest.approx(expected, rel=1e-12)
    # 2 m sin(20 deg) times the 0.05 by which the shifts fall short
    assert 1e3 * pair.backlash == pytest.approx(0.4 * math.sin(math.radians(20.0)), rel=1e-6)
    other = shifted((0.3, -0.35)).replace(">0.3<", ">0.2<", 1)
    with pytest.raises(ParameterError, match=r"same for both flanks, got 0.2 of .* 0.3 of"):
        read_rexs(written(other))


def test_tip_diameters_that_are_absent_or_empty_have_a_default_that_is_said(written):
    text = shifted((0.0, 0.0)).replace("addendum_coefficient", "other")
    plain = read_rexs(written(text))
    assert plain.file.gear.tip_diameter_mm == pytest.approx(TIPS[1])
    assert "1 module above" in notes(plain, "lacking")["gear.tip_diameter_mm"]
    one = '<attribute id="tip_diameter" unit="mm">1</attribute></component>\n    <component id="4"'
    empty = read_rexs(written(text.replace('</component>\n    <component id="4"', one)))
    assert empty.file.pinion.tip_diameter_mm == pytest.approx(TIPS[0])
    assert "1 mm cannot be" in notes(empty, "left out")["tip_diameter of cylindrical_gear 3"]
    bare = read_rexs(written(text.replace("addendum_modification", "other")))
    assert bare.file.helical_pair().profile_shifts == (0.0, 0.0)
    assert "reference distance" in notes(bare, "lacking")["pinion.profile_shift_coefficient"]


def as_json(text):
    """The same model in the JSON form of REXS."""
    root = etree.fromstring(text.encode())
    return json.dumps({"model": dict(root.attrib) | {
        "relations": [
            {"id": int(one.get("id")), "type": one.get("type"),
             "refs": [{"id": int(ref.get("id")), "role": ref.get("role")} for ref in one]}
            for one in root.find("relations")
        ],
        "components": [
            {"id": int(one.get("id")), "type": one.get("type"), "attributes": [
                {"id": of.get("id"), "unit": of.get("unit"), "floating_point": float(of.text)}
                for of in one
            ]} | ({"name": one.get("name")} if one.get("name") else {})
            for one in root.find("components")
        ],
        "load_spectrum": {"id": 1},
    }})  # fmt: skip


def test_json_and_archives_are_read_as_xml_is(tmp_path, written):
    path, other = tmp_path / "pair.rexsj", tmp_path / "pair.rexsz"
    path.write_text(as_json(CYLINDRICAL), encoding="utf-8")
    expected = read_rexs(written(CYLINDRICAL))
    read = read_rexs(path)
    assert read.file.helical_pair() == expected.file.helical_pair()
    # the same is named as left out, but for the source, which names the file
    assert notes(read, "left out") == notes(expected, "left out")
    for model in ("pair.rexs", "pair.rexsj"):
        with zipfile.ZipFile(other, "w") as archive:
            archive.write(tmp_path / model, f"folder/{model}")
            archive.writestr("__MACOSX/._pair.rexs", b"rest")
            archive.writestr("bearing.gde", b"")
        assert read_rexs(other).file.helical_pair() == expected.file.helical_pair()
    with zipfile.ZipFile(other, "a") as archive:
        archive.writestr("second.rexs", CYLINDRICAL)
    with pytest.raises(
        ParameterError, match=r"must hold one REXS model .*pair.rexsj .*second.rexs"
    ):
        read_rexs(other)
    whole = other.read_bytes()
    for name, content, kind in (
        ("pair.rexsj", b'{"model": {"version": "1.4"}}', r"JSON file of REXS.*relations"),
        ("pair.rexsj", b"[1, 2]", "JSON file of REXS.*got a list"),
        ("pair.rexsz", b"[1, 2]", "JSON file of REXS.*got a list"),
        ("pair.rexsj", b"", "JSON file of REXS"),
        ("pair.rexsz", whole[: len(whole) // 2], "ZIP file of REXS: the archive is cut"),
        ("pair.rexsz", b"damaged", "ZIP file of REXS: the archive is cut"),
    ):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(ParameterError, match=f"{name} is not a readable {kind}"):
            read_rexs(tmp_path / name)
    with zipfile.ZipFile(other, "w") as archive:
        archive.writestr("pair.rexsj", "[1, 2]")
    with pytest.raises(ParameterError, match=r"JSON file of REXS.*got a list"):
        read_rexs(other)
    with pytest.raises(ParameterError, match=r"REXS file none\.rexsz was not found in "):
        read_rexs(tmp_path / "none.rexsz")


def box(*stages):
    """A gear unit whose stages (number, name, gear 1, gear 2) share the gears 3 and 4."""
    more = "".join(
        f'<component id="{number}" type="cylindrical_stage" name="{name}">'
        f'<attribute id="center_distance" unit="mm">{CENTRES}</attribute></component>'
        for number, name, _, _ in stages
    )
    relations = "".join(
        f'<relation id="{50 + number}" type="stage"><ref id="{number}" role="stage"/>'
        f'<ref id="{one}" role="gear_1"/><ref id="{two}" role="gear_2"/></relation>'
        for number, _, one, two in stages
    )
    text = CYLINDRICAL.replace("</relations>", f"{relations}</relations>")
    return text.replace("</components>", f"{more}</components>")


def test_a_stage_of_a_box_is_chosen_by_number_or_name_and_all_are_listed(written):
    path = written(box((20, "Input stage", 3, 4)))
    listed = r"2 stages: .* 2 \(output stage\), 41/20 teeth; .* 20 \(Input stage\), 20/41 teeth"
    with pytest.raises(ParameterError, match=listed):
        read_rexs(path)
    for wanted in (20, "20", "input stage", "INPUT", "Input stage"):
        assert read_rexs(path, stage=wanted).file.name == "Input stage"
    with pytest.raises(ParameterError, match="2 stages called stage"):
        read_rexs(path, stage="stage")
    with pytest.raises(ParameterError, match="no cylindrical or bevel stage third; it has"):
        read_rexs(path, stage="third")


PLANETARY = box((21, "sun 2", 3, 11), (22, "ring 1", 4, 12), (23, "ring 2", 11, 12)).replace(
    "</relations>",
    '<relation id="90" type="assembly"><ref id="10" role="assembly"/><ref id="2" role="part"/>'
    "</relation>" + "".join(
        f'<relation id="{70 + n}" type="assembly"><ref id="10" role="assembly"/>'
        f'<ref id="{n}" role="part"/></relation>' for n in (21, 22, 23)
    ) + "</relations>",
).replace(
    "</components>",
    '<component id="10" type="planetary_stage" name="epicycle"/>'
    '<component id="11" type="cylindrical_gear" name="planet 2">'
    '<attribute id="number_of_teeth" unit="none">41</attribute></component>'
    '<component id="12" type="ring_gear"/></components>',
)  # fmt: skip


@pytest.mark.parametrize("wanted", [None, 10, "epicycle", 2])
def test_a_planetary_stage_is_read_as_its_mesh_of_sun_and_planet(wanted, written):
    pair = read_rexs(written(PLANETARY), stage=wanted)
    assert (pair.file.pinion.teeth, pair.file.gear.teeth) == (20, 41)
    said = notes(pair, "inferred")["planetary_stage 10 (epicycle)"]
    assert "mesh of cylindrical_gear 3 and cylindrical_gear 4, one of 2" in said
    assert "internal gears" in notes(pair, "left out")["ring_gear 12"]


def test_the_ring_of_a_planetary_stage_is_refused_with_what_can_be_read(written):
    with pytest.raises(ParameterError, match=r"of planetary_stage 10 .* mesh of sun and planet"):
        read_rexs(written(PLANETARY), stage="ring 1")
