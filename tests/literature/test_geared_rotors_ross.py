"""Geared rotors of Rao et al. 1998 have the frequencies of ROSS 2.3.0, petrobras/ross.

ROSS's numbers are those of benchmarks/peer_work/pair_ross.py, with one Timoshenko element for each
section of the shafts in both programs, from `scipy.linalg.eigvalsh(pair.K(0), pair.M())`. The
matrices of both rotors without bearings, ross_driving.npz and ross_driven.npz, are of its `save`.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg

import gearlube as gl
from drivetrain.train.train_file import TrainFile
from gearlube_core.errors import ParameterError

HERE = Path(__file__).parent
FILES = [str(HERE / f"ross_{side}.npz") for side in ("driving", "driven")]
ROSS = [
    11.71576446, 12.20700999, 17.83330681, 17.94581024, 23.95156177, 37.69573544,
    50.83764776, 52.52960157, 54.34176380, 57.62837690, 58.94125127, 63.10763848,
]  # fmt: skip  # Hz


@pytest.fixture
def work(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(HERE.parents[1] / "benchmarks" / "peer_work")
    import pair_gearlube

    return pair_gearlube


def matrices() -> dict[str, np.ndarray]:
    with np.load(FILES[0]) as stored:
        return {name: stored[name] for name in stored.files}


@pytest.mark.parametrize("files", [("", ""), FILES], ids=["sections", "matrices_of_ross"])
def test_coupled_frequencies_of_geared_rotors_are_those_of_ross(work, files):
    # elements of 10 m: none is cut
    found = work.run(10.0, files=files)["frequencies"]
    # 1e-7: ROSS's printed digits; a soft spring along the axis
    np.testing.assert_allclose(found, ROSS, rtol=1e-7)


def test_rotor_of_ross_whirls_at_the_frequencies_of_its_whole_matrices():
    given, speed = matrices(), 200.0  # rad/s
    beam = gl.train.rotor_beam(**given)
    n = 6 * given["places"].size
    inverse = np.linalg.inv(given["mass"])
    state = np.block(
        [
            [np.zeros((n, n)), np.eye(n)],
            [-inverse @ given["stiffness"], -speed * inverse @ given["gyroscopic"]],
        ]
    )
    whole = np.sort(scipy.linalg.eigvals(state).imag)[-14:]
    # p = x + i y: M p'' - 2 i w T p' + K p = 0
    m, inverse = beam.places.size * 2, np.linalg.inv(beam.bending.mass)
    turning = 2j * speed * inverse @ beam.bending.tilting
    state = np.block([[np.zeros((m, m)), np.eye(m)], [-inverse @ beam.bending.stiffness, turning]])
    forward = scipy.linalg.eigvals(state).imag
    straight = [
        scipy.linalg.eigvalsh(k, j)
        for k, j in (
            (beam.axial_stiffness, beam.axial_mass),
            (beam.torsion_stiffness, beam.torsion_inertia),
        )
    ]
    along = np.sqrt(np.maximum(np.concatenate(straight), 0.0))
    # forward and backward whirl, stretch and twist are all that the whole matrices have
    np.testing.assert_allclose(np.sort([*abs(forward), *along])[-14:], whole, rtol=1e-8)
    # it turns about +z: gyroscopic moments raise forward whirl
    assert forward.max() > -forward.min()


def test_train_file_names_the_matrices_of_another_program(tmp_path: Path):
    (tmp_path / "rotor.npz").write_bytes(Path(FILES[0]).read_bytes())
    path = tmp_path / "train.toml"
    path.write_text(
        """
        name = "rotor of ROSS"
        steps_per_highest_period = 8
        [oil]
        name = "mohammadpour_2015"
        [start]
        oil_temperature_degc = 60.0
        speed_rpm = { rotor = 100.0 }
        torque_n_m = { motor = 10.0, load = 10.0 }
        [bodies.rotor]
        kind = "shaft"
        matrices_file = "rotor.npz"
        nodes_mm = { motor = 0.0, load = 5800.0 }
        [elements.motor]
        kind = "port"
        body = "rotor.motor"
        sign = -1.0
        [elements.load]
        kind = "port"
        body = "rotor.load"
        """,
        encoding="utf-8",
    )
    rotor = TrainFile.given(str(path)).case().train.bodies[0]
    # discs and gear of 1368 kg, the rest is the shaft of steel
    volumes = [0.25 * np.pi * d * d * one for d, one in ((0.3, 4.34), (0.22, 1.46))]
    assert rotor.mass == pytest.approx(525.7 + 116.04 + 726.4 + 7800.0 * sum(volumes), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"places": np.array([0.0, 1.0, 1.0])}, "places of the rotor must be two or more"),
        ({"mass": np.eye(4)}, "six for each place, got the shape"),
        ({"mass": np.diag(np.tile([1.0, 1.0, 1.0, 0.0, 0.0, 1.0], 5))}, "moment of inertia"),
        ({"bearing": 1e6}, "Leave out bearings"),
        ({"one plane": 1e9}, "alike in both planes"),
        ({"gyroscopic": np.eye(30)}, "gyroscopic of the rotor must be"),
    ],
    ids=lambda one: next(iter(one)) if isinstance(one, dict) else "",
)
def test_matrices_that_are_no_free_rotor_are_refused(change, words):
    given = matrices()
    if "bearing" in change:
        given["stiffness"] = given["stiffness"] + change["bearing"] * np.eye(30)
    elif "one plane" in change:
        given["stiffness"] = given["stiffness"].copy()
        given["stiffness"][0, 0] += change["one plane"]
    else:
        given |= change
    with pytest.raises(ParameterError, match=words):
        gl.train.rotor_beam(**given)


def test_nodes_of_a_rotor_stand_at_its_places_and_it_has_no_sections():
    rotor = gl.train.read_rotor(FILES[0])
    whole = gl.train.Shaft(name="rotor", rotor=rotor, nodes={"gear": 5.8})
    with pytest.raises(ParameterError, match="nearest one is 5800 mm"):
        replace(whole, nodes={"gear": 5.7})
    section = gl.train.ShaftSection(start=0.0, end=5.8, outer_diameter=0.3)
    with pytest.raises(ParameterError, match="none and no discs beside a rotor"):
        replace(whole, sections=(section,))


def test_rotor_file_without_mass_is_refused(tmp_path: Path):
    np.savez(tmp_path / "rotor.npz", places=[0.0, 1.0], stiffness=np.eye(12))
    with pytest.raises(ParameterError, match="got none of mass"):
        gl.train.read_rotor(tmp_path / "rotor.npz")
