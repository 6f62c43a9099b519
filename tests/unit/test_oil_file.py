"""Oil files: what they give, what is completed, and how wrong ones are answered."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

import gearlube as gl
from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.read_axle import read_axle
from fmu_src.axle_arguments import CUSTOM_OIL
from fmu_src.hypoid_axle import car_axle_in, definition_with_axle
from fmu_src.identity import guid_of
from gearlube.command import app
from gearlube.studies.calibrate import results
from gearlube_core.dynamics.hypoid_axle.uncertain import UNCERTAIN
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.netcdf import shipped_mesh_table, write_mesh_table
from gearlube_core.oil.base_oils import BASE_OILS, ClassValue
from gearlube_core.oil.oil_file import FILE_IN_FMU, OilFile
from tests.helpers.each import each

SHEET = {
    "name": "my oil",
    "base_oil": "mineral",
    "density_kg_m3": 880.0,
    "viscosity_40_degc_mm2_s": 100.0,
    "viscosity_100_degc_mm2_s": 11.0,
}


def text_of(data: dict[str, object]) -> str:
    quoted = {k: f'"{v}"' if isinstance(v, str) else v for k, v in data.items()}
    return "".join(f"{key} = {value}\n" for key, value in quoted.items())


def written(folder: Path, **changes: object) -> Path:
    path = folder / "my_oil.toml"
    data = {key: value for key, value in (SHEET | changes).items() if value is not None}
    path.write_text(text_of(data), encoding="utf-8")
    return path


def origins(oil: gl.oil.DescribedOil) -> dict[str, str]:
    return {note.field: note.origin for note in oil.inputs}


def test_the_sheet_s_viscosities_come_back(tmp_path):
    oil = gl.read_oil(written(tmp_path)).lubricant
    for degc, mm2_s in ((40.0, 100.0), (100.0, 11.0)):
        nu = oil.dynamic_viscosity(degc + 273.15) / oil.density
        # two exponentials of the line: 1e-12 and a few roundings
        assert nu == pytest.approx(mm2_s * 1e-6, rel=1e-10, abs=0.0)


def test_density_is_taken_at_70_degc_by_the_slope(tmp_path):
    path = written(tmp_path, density_temperature_degc=20.0, density_slope_kg_m3_k=-0.5)
    assert gl.read_oil(path).lubricant.density == pytest.approx(880.0 - 0.5 * 50.0)


def test_what_the_file_gives_is_given_and_the_rest_is_not(tmp_path):
    bare = origins(gl.read_oil(written(tmp_path)))
    assert bare["alpha_per_gpa"] == bare["eyring_stress_mpa"] == "inferred"
    assert bare["conductivity_w_m_k"] == "assumed"
    assert bare["density_kg_m3"] == "given"
    full = gl.read_oil(written(tmp_path, alpha_per_gpa=21.0, eyring_stress_mpa=5.5))
    assert origins(full)["alpha_per_gpa"] == origins(full)["eyring_stress_mpa"] == "given"
    assert full.lubricant.alpha == pytest.approx(21e-9, rel=1e-12, abs=0.0)
    assert full.lubricant.eyring_stress == pytest.approx(5.5e6)
    named = {note.field for note in full.inputs}
    factor = {f"law_numbers.{one}" for one in ("a1", "a2", "b1", "b2")}
    fields = {one for one in OilFile.model_fields if "law" not in one} - {
        "name",
        "source",
        "viscometer",
    }
    assert named == fields | factor | {"viscosity_law"}
    newtonian = gl.read_oil(written(tmp_path, shear_law="newtonian"))
    assert origins(newtonian)["shear_law"] == "given"
    thick = gl.oil.film_oil_of(newtonian.lubricant, 313.15)
    assert thick.shear.tau0 == 0.0  # as an oil of film_oil(shear_law="newtonian")


def test_the_eyring_stress_goes_with_one_over_alpha(tmp_path):
    soft = gl.read_oil(written(tmp_path, alpha_per_gpa=10.0)).lubricant
    stiff = gl.read_oil(written(tmp_path, alpha_per_gpa=30.0)).lubricant
    assert soft.eyring_stress / stiff.eyring_stress == pytest.approx(3.0, rel=1e-12)
    # 2 x 0.047 over 10 1/GPa
    assert soft.eyring_stress == pytest.approx(9.4e6, rel=1e-12)


@pytest.mark.parametrize("known", ["viscosity_40_degc_mm2_s", "viscosity_100_degc_mm2_s"])
def test_the_index_stands_for_one_viscosity(tmp_path, known):
    whole = gl.read_oil(written(tmp_path))
    index = next(n.value for n in whole.inputs if n.field == "viscosity_index")
    other = ({"viscosity_40_degc_mm2_s", "viscosity_100_degc_mm2_s"} - {known}).pop()
    again = gl.read_oil(written(tmp_path, viscosity_index=index, **{other: None}))
    assert origins(again)[other] == "inferred"
    for degc in (20.0, 60.0, 120.0):
        # the root of the index is found to 1e-12
        assert again.lubricant.dynamic_viscosity(degc + 273.15) == pytest.approx(
            whole.lubricant.dynamic_viscosity(degc + 273.15), rel=1e-9
        )


@each(
    ("changes", "words"),
    [
        ({"viscosity_100_degc_mm2_s": 110.0}, "must fall with temperature, got 100 mm2/s"),
        ({"density_kg_m3": None}, "density_kg_m3 is missing"),
        ({"density_kg_m3": 0.88}, r"Is it in g/cm3\? 0.88 g/cm3 is 880 kg/m3"),
        (
            {"viscosity_40_degc_mm2_s": 1e-4},
            r"2 to 100000 mm2/s, got 0.0001.*Is it in m2/s\? 0.0001 m2/s is 100 mm2/s",
        ),
        ({"alpha_per_gpa": 2.1e-8}, r"1 to 100 1/GPa, got 2.1e-08.*2.1e-08 1/Pa is 21 1/GPa"),
        ({"base_oil": "silicone"}, "mineral or pao or ester or pag, got 'silicone'"),
        ({"viscosity_100_degc_mm2_s": None}, "two of viscosity_40_degc_mm2_s.*got 1"),
        ({"viscosity_index": 95.0}, "two of .*got 3"),
        ({"viscosity_100_degc_mm2_s": None, "viscosity_index": 401.0}, "0 to 400"),
        ({"alpha_temperature_degc": 170.0}, "alpha_temperature must be within"),
        ({"visc_40": 100.0}, "visc_40 is not a field"),
    ],
)
def test_a_wrong_file_says_what_is_wrong_and_its_cure(tmp_path, changes, words):
    with pytest.raises(ParameterError, match=words):
        gl.read_oil(written(tmp_path, **changes))


def test_all_wrong_fields_are_named_at_once(tmp_path):
    with pytest.raises(
        ParameterError, match=r"has 2 wrong field.*density.*base_oil|base_oil.*dens"
    ):
        gl.read_oil(written(tmp_path, density_kg_m3=None, base_oil="silicone"))


def test_an_unknown_oil_is_answered_with_the_known_ones():
    with pytest.raises(ParameterError, match=r"one of fva_3, .*iso_vg_220_pao or a file"):
        gl.read_oil("olive")


def test_an_oil_of_the_library_tells_what_is_assumed():
    oil = gl.read_oil("fva_3")
    assert oil.lubricant == gl.Lubricant.named("fva_3")
    assumed = {note.field for note in oil.assumed}
    assert "eyring_stress" in assumed
    assert "density" not in assumed


def axle_with(folder: Path, oil: str) -> Path:
    path = folder / "axle.toml"
    path.write_text(f'[gear_set]\nmesh_table = "mohammadpour_2015"\n[oil]\n{oil}\n')
    return path


def test_the_axle_file_takes_the_oil_file(tmp_path):
    made = gl.read_oil(written(tmp_path)).lubricant
    described = read_axle(axle_with(tmp_path, 'file = "my_oil.toml"'))
    assert described.axle.oil == made
    notes = {note.field: note for note in described.inputs}
    assert notes["oil.file"].origin == "given"
    assert notes["oil.alpha_per_gpa"].origin == "inferred"


def test_the_oil_file_comes_alone(tmp_path):
    with pytest.raises(
        ParameterError, match="file must be the only field of this section, got also density_kg_m3"
    ):
        read_axle(axle_with(tmp_path, 'file = "my_oil.toml"\ndensity_kg_m3 = 900.0'))


def test_an_eyring_stress_beside_a_measured_oil_holds_at_all_pressures(tmp_path):
    named = read_axle(axle_with(tmp_path, 'name = "fva_3"')).axle.oil
    assert named.eyring_slope > 0.0
    own = read_axle(axle_with(tmp_path, 'name = "fva_3"\neyring_stress_mpa = 6.0')).axle.oil
    assert (own.eyring_stress, own.eyring_slope) == (6e6, 0.0)


@pytest.mark.parametrize("oil", ['file = "my_oil.toml"', 'name = "fva_3"', 'name = "jamali_2015"'])
def test_a_calibrated_axle_file_takes_the_number_of_its_own_oil_alone(tmp_path, oil):
    written(tmp_path)
    path = axle_with(tmp_path, oil)
    found = results._values(AxleFile.given(str(path)), read_axle(path))
    assert bool(found.get("oil.alpha_per_gpa")) == ("name" in oil)
    assert bool(found.get("oil.eyring_stress_mpa")) == ("jamali" in oil)


def test_a_missing_oil_file_is_named(tmp_path):
    with pytest.raises(ParameterError, match=r"none\.toml was not found in .* it in oil\.file"):
        read_axle(axle_with(tmp_path, 'file = "none.toml"'))


def test_the_fmu_carries_the_oil_file(tmp_path):
    oil = written(tmp_path)
    definition = definition_with_axle(axle_with(tmp_path, 'file = "my_oil.toml"'))
    assert definition.resources[FILE_IN_FMU] == oil.read_bytes()
    made = gl.read_oil(oil).lubricant
    oil.unlink()
    assert car_axle_in(definition.resources).axle.oil == made


def test_every_byte_of_the_oil_file_counts_for_the_fmu_s_identity(tmp_path):
    axle = axle_with(tmp_path, 'file = "my_oil.toml"')
    written(tmp_path)
    guid = guid_of(definition_with_axle(axle))
    written(tmp_path, density_kg_m3=881.0)
    assert guid_of(definition_with_axle(axle)) != guid


def test_the_map_command_computes_with_the_oil_file(tmp_path, monkeypatch):
    seen = []

    def stopped(settings, **_):
        seen.append(settings)
        raise ParameterError("far enough")

    monkeypatch.setattr("gearlube.studies.loss_map.run.run_loss_map", stopped)
    path = written(tmp_path, eyring_stress_factor=1.3)
    words = ["map", "--oil", str(path), "--out", str(tmp_path / "map")]
    assert CliRunner().invoke(app, words).exit_code == 2
    assert seen[0].axle.oil == gl.read_oil(path).lubricant
    assert {one.name: one.factor for one in seen[0].uncertain}["eyring_stress"] == 1.3


@pytest.mark.parametrize("own", [False, True])
def test_the_sweep_runs_the_axle_with_the_oil_file(tmp_path, monkeypatch, own):
    seen = []

    def stopped(settings, **others):
        seen.append((settings, others["mesh_table"], read_axle(others["axle"])))
        raise ParameterError("far enough")

    monkeypatch.setattr("gearlube.studies.sweep.run.run_sweep", stopped)
    path, words = written(tmp_path), []
    given = tmp_path / "axle.toml"
    if own:
        # a table of its own beside the file, and an oil that gives way
        write_mesh_table(shipped_mesh_table("mohammadpour_2015"), tmp_path / "own.nc")
        given.write_text(
            '[gear_set]\nmesh_table = "own.nc"\n[pinion]\nmass_kg = 9.5\n'
            'bearing = { f0 = 5.0 }\n[oil]\nname = "karagiannis_2012"\n[engine]\norders = []\n'
            "order_amplitudes = []\norder_phases_deg = []\n"
        )
        words = [str(given)]
    done = CliRunner().invoke(
        app, ["sweep", *words, "--oil", str(path), "--out", str(tmp_path / "out")]
    )
    assert done.exit_code == 2
    [(settings, table, described)] = seen
    assert table is None
    assert settings.oil == CUSTOM_OIL
    assert described.axle.oil == gl.read_oil(path).lubricant
    bare = read_axle(given if own else "mohammadpour_2015")
    assert replace(described.axle, oil=bare.axle.oil, mesh=bare.axle.mesh) == bare.axle
    assert described.driveline == bare.driveline
    assert described.axle.mesh.name == bare.axle.mesh.name


def test_a_sweep_of_a_built_fmu_takes_no_oil_file(tmp_path, caplog):
    words = ["sweep", "--fmu", str(tmp_path / "a.fmu"), "--oil", str(written(tmp_path))]
    assert CliRunner().invoke(app, words).exit_code == 2
    assert "--oil cannot be a file if --fmu is given" in caplog.text


def test_the_loss_map_takes_the_scatter_of_the_oil(tmp_path):
    def factors(path: Path | str) -> dict[str, float]:
        axle = read_axle(path).axle
        return {one.name: one.factor for one in gl.LossMapSettings(axle=axle).uncertain}

    usual = {one.name: one.factor for one in UNCERTAIN}
    of_sheets = usual.pop("high_pressure")  # the paper's oil has no pressure factor
    assert factors("mohammadpour_2015") == usual
    path = axle_with(tmp_path, 'file = "my_oil.toml"')
    written(tmp_path, eyring_stress_mpa=5.0, eyring_stress_factor=1.25, alpha_factor=1.05)
    own = {"eyring_stress": 1.25, "alpha": 1.05}
    # without an alpha ln(eta at 1 GPa) is known to 1, of which 9 times ln(1.05)/2 is alpha's
    unknown = math.exp(2.0 * math.sqrt(1.0 - (4.5 * math.log(1.05)) ** 2))
    assert factors(path) == pytest.approx(usual | own | {"high_pressure": unknown})
    written(tmp_path, alpha_per_gpa=20.0)
    assert factors(path)["high_pressure"] == of_sheets == 2.2


def test_the_command_shows_an_oil_and_draws_it(tmp_path):
    path, picture = written(tmp_path), tmp_path / "oil.png"
    done = CliRunner().invoke(app, ["oil", str(path), "--figure", str(picture)])
    assert done.exit_code == 0
    row = next(line.split() for line in done.output.splitlines() if line.split()[:1] == ["40"])
    # nu as given, eta = nu rho with rho of 40 degC
    assert float(row[1]) == 100.0
    assert float(row[2]) == pytest.approx(0.1 * (880.0 - 0.6 * 25.0), rel=5e-4)  # 4 digits
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_the_example_is_an_oil_file(tmp_path):
    done = CliRunner().invoke(app, ["oil", "--example"])
    path = tmp_path / "example.toml"
    path.write_text(done.output, encoding="utf-8")
    assert gl.read_oil(path) == gl.read_oil("iso_vg_220_pao")


def test_the_command_refuses_a_wrong_file(tmp_path, caplog):
    done = CliRunner().invoke(app, ["oil", str(written(tmp_path, base_oil="silicone"))])
    assert done.exit_code == 2
    assert "got 'silicone'" in caplog.text


def test_a_given_class_value_never_leaves_its_range():
    for base in BASE_OILS.values():
        for one in base:
            if not isinstance(one, ClassValue):
                continue
            assert one.factor >= 1.0
            assert math.isfinite(one.value)
            assert one.why
