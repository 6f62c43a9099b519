"""Meshes with stations from the loaded contact of a helical pair."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from gearlube_core.dynamics.train.contact_stations import contact_fields
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.contact_dataset import line_mesh
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, run_cycle
from gearlube_core.helical_geometry.contact_line import clip_line, line_position
from gearlube_core.helical_geometry.modification import FlankModification, ModifiedPair
from gearlube_core.mesh_table.line_mesh import LineMesh, uniform_line_mesh
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.each import each
from tests.helpers.helical_contact_cases import EQUAL, HE_2007, coarse_stiffness
from tests.helpers.planetary_sets import KELVIN, OIL

ARM = HE_2007.pinion_base_radius * math.cos(HE_2007.base_helix_angle)
SETTINGS = CycleSettings(torques=(100.0, 300.0), positions=6)
SLOPE = 10e-6  # m over the face, transverse


def in_train(fields):
    """Return two gears on springs with a mesh of these fields."""
    mesh = GearMesh(name="mesh", first="pinion", second="wheel", **fields)
    bodies = [Body(name=one, mass=2.0, inertia=1e-3, polar_inertia=2e-3) for one in mesh_bodies()]
    springs = {"K_xx": 2e8, "K_yy": 2e8, "K_zz": 1e8, "K_ax": 2e5, "K_ay": 2e5}
    parts = [mesh, Port(name="load", body="wheel")]
    parts += [SpringSupport(name=f"{one} bearing", body=one, **springs) for one in mesh_bodies()]
    train = Train(bodies, parts, OIL)
    train.initialise({"pinion": 0.0}, {"load": 100.0}, KELVIN)
    return train


def mesh_bodies():
    return "pinion", "wheel"


def pressed(train, phase, rotation, tilt=0.0):
    """Return outputs with both gears in their places, but for a tilt of the flanks."""
    numbers = train.elements[0].numbers()
    state, names = train.get_state(), train.state_names
    of_bodies = [i for i, name in enumerate(names) if name.partition(".")[0] in mesh_bodies()]
    state[of_bodies] = 0.0
    state[names.index("mesh.rotation")] = rotation
    crossed = (HE_2007.plane.P - HE_2007.plane.A) / HE_2007.plane.pitch
    crossed += 0.5 * HE_2007.face_width * math.tan(HE_2007.base_helix_angle) / HE_2007.base_pitch
    angle = 2.0 * math.pi * (phase - crossed) - numbers.drive_phase
    state[names.index("pinion.rz")] = angle / numbers.cycle
    line = numbers.first.drive
    size = line.m_x**2 + line.m_y**2
    state[names.index("pinion.rx")] = tilt * line.m_x / size
    state[names.index("pinion.ry")] = tilt * line.m_y / size
    depth = tilt * (line.h_x * line.m_x + line.h_y * line.m_y) / size  # of mid-face by the tilt
    state[names.index("mesh.rotation")] -= depth
    train.set_state(state)
    return train.outputs()


@cache
def analysed(slope):
    pinion = FlankModification(lead_slope=slope)
    modified = ModifiedPair(pair=HE_2007, pinion=pinion)
    cycle = run_cycle(modified, coarse_stiffness(HE_2007), SETTINGS, jobs=1)
    return modified, cycle


def fields_of(slope=0.0, torque=300.0, **more):
    modified, cycle = analysed(slope)
    mesh = line_mesh(modified, SETTINGS, cycle)
    return contact_fields(HE_2007, mesh, torque, drives_forward=False, **more)


@pytest.mark.slow
@each("level", (0, 1))
def test_transmission_error_and_stiffness_under_load_are_those_of_the_contact_analysis(level):
    """At the closing that the analysis finds at each phase, the mesh carries its torque."""
    _, cycle = analysed(0.0)
    torque = SETTINGS.torques[level]
    train = in_train(fields_of(torque=torque, stations=7))
    start = cycle["unloaded_rotation"].min()
    for n, phase in enumerate(SETTINGS.phases):
        closing = ARM * (cycle["rotation"][n, level] - start)
        found = pressed(train, phase, closing)
        # both are sums of the same springs, to rounding: 1e-6 m of closing to 1e-16 m
        assert found["mesh.load"] == pytest.approx(torque / ARM, rel=1e-9)
        assert found["mesh.stiffness"] == pytest.approx(cycle["tangent"][n, level] / ARM**2, 1e-9)


def thirds(cycle, n, level):
    """Return the loads of the thirds of the face in the analysis, over their mean."""
    edges = np.linspace(-0.5, 0.5, 4) * HE_2007.face_width
    found = np.zeros(3)
    for j in range(1, cycle["line_load"].shape[2] - 1):
        plane = HE_2007.plane
        segment = clip_line(line_position(SETTINGS.phases[n], j - 1, plane), plane)
        ends = np.linspace(segment.z_low, segment.z_high, SETTINGS.stations + 1)
        for load, low, high in zip(cycle["line_load"][n, level, j], ends, ends[1:], strict=False):
            found += load * np.clip(np.minimum(high, edges[1:]) - np.maximum(low, edges[:-1]), 0, 1)
    return found / found.mean()


@pytest.mark.slow
@each("sign, level", ((1.0, 0), (1.0, 1), (-1.0, 1)))
def test_a_tilt_moves_the_load_as_in_the_contact_analysis_with_this_misalignment(sign, level):
    tilt = -sign * SLOPE * math.cos(HE_2007.base_helix_angle) / HE_2007.face_width
    straight, skewed = analysed(0.0)[1], analysed(sign * SLOPE)[1]
    train = in_train(fields_of(torque=SETTINGS.torques[level], stations=3))
    start, shifts, expected = straight["unloaded_rotation"].min(), [], []
    for n, phase in enumerate(SETTINGS.phases):
        closing = ARM * (straight["rotation"][n, level] - start)
        ends = [pressed(train, phase, closing, by) for by in (0.0, tilt)]
        before, after = (one["mesh.share.high"] - one["mesh.share.low"] for one in ends)
        own = thirds(straight, n, level)
        assert before == pytest.approx(own[2] - own[0], abs=0.02)  # corners are spread over all
        moved = thirds(skewed, n, level) - own
        shifts.append(after - before)
        expected.append(moved[2] - moved[0])
    assert abs(np.mean(expected)) > 0.3
    # teeth bend as a whole and resist a moment more than stations do, here by 4 %; at the lower
    # load one end comes out of contact, which leaves no more than 1 % of it
    assert np.mean(shifts) / np.mean(expected) == pytest.approx(0.98, abs=0.04)


def synthetic(pair, phases=24):
    """Return a line mesh of one stiffness everywhere, without gaps."""
    even = uniform_line_mesh(
        name=pair.name, source="test", pinion_teeth=pair.pinion_teeth, gear_teeth=pair.gear_teeth,
        base_pitch=pair.base_pitch, lines=math.ceil(pair.total_contact_ratio), density=1e10,
    )  # fmt: skip
    density = np.repeat(even.density, phases, axis=1)
    more = {"phase": np.arange(phases) / phases, "density": density, "offset": 0.0 * density}
    return replace(even, **more)


@each("right_hand", (False, True))
@each("forward", (False, True))
def test_contact_begins_at_the_end_of_the_face_that_leads(right_hand, forward):
    """A right-handed tooth lies further about +z at high z, which leads where it turns so."""
    found = contact_fields(
        HE_2007, synthetic(HE_2007), 1.0, stations=5, right_hand=right_hand, drives_forward=forward
    )
    first = [np.fft.rfft(row)[1] for row in found["station_stiffness"]]
    lag = np.angle(first[0] / first[1]) / (2.0 * math.pi)  # of station 0 after station 1
    step = HE_2007.face_width / 5 * math.tan(HE_2007.base_helix_angle) / HE_2007.base_pitch
    high_leads = right_hand == forward
    # exact but for the ends of the path of contact between the 24 phases
    assert (-lag if high_leads else lag) == pytest.approx(step, rel=0.02)


def test_the_mesh_cycle_begins_at_the_pitch_point():
    """Equal gears: the middle of the face meshes alike before and after its pitch point."""
    found = contact_fields(EQUAL, synthetic(EQUAL, 96), 1.0, stations=5)
    first = np.fft.rfft(found["station_stiffness"][2])[1]
    # lines that begin and end between two of the 96 phases leave up to 1e-3 cycles
    assert abs(np.angle(-first)) < 1e-3 * 2.0 * math.pi
    # mean length of contact lines on the face: overlap of transverse contact, b eps_a/cos(b)
    length = EQUAL.face_width * EQUAL.transverse_contact_ratio / math.cos(EQUAL.base_helix_angle)
    assert found["stiffness"] == pytest.approx(1e10 * length, rel=2e-3)  # of 96 phases


def test_a_station_without_load_has_the_stiffness_of_the_next_higher_load():
    mesh = named_line_mesh("he_2007")
    density = mesh.density.copy()
    density[0, :, :, :] *= np.arange(mesh.station.size) > 8  # low ends of all lines carry nothing
    partly = replace(mesh, density=density)
    found = contact_fields(HE_2007, partly, float(mesh.torque[0]), drives_forward=False)
    stiffness = np.array(found["station_stiffness"])
    assert (stiffness.mean(axis=1) > 0.2).all()


def wrong(**given):
    fields = {"pair": HE_2007, "mesh": named_line_mesh("he_2007"), "torque": 200.0} | given
    return contact_fields(fields.pop("pair"), fields.pop("mesh"), fields.pop("torque"), **fields)


def constant() -> LineMesh:
    return replace(synthetic(HE_2007, 1), name="constant")


@each(
    "given, words",
    [
        ({"torque": 1000.0}, "contact torque must be within 25 to 450 N.m, got 1000"),
        ({"pair": EQUAL}, "must be that of equal with 25/25 teeth .* got 25/31"),
        ({"mesh": constant(), "torque": 1.0}, "constant must be of a loaded contact"),
        ({"stations": 0}, "stations must be within 1 to 99"),
    ],
)
def test_a_mesh_that_does_not_fit_is_refused(given, words):
    with pytest.raises(ParameterError, match=words):
        wrong(**given)


@each(
    "given, words",
    [
        ({"stations": 4}, "a row for each of the 4 stations, .* got 9 rows"),
        ({"stiffness_waves": (0.1, 0.0)}, "no stiffness_waves beside it"),
        (
            {"station_stiffness": 9 * ((2.0,),)},
            "mean of station_stiffness .* 0.999 to 1.001, got 2",
        ),
        ({"station_stiffness": ((-1.0,), *8 * ((1.25,),))}, "least mean .* got -1"),
    ],
)
def test_rows_of_stiffness_that_are_none_are_refused(given, words):
    with pytest.raises(ParameterError, match=words):
        GearMesh(name="mesh", first="a", second="b", **(wrong() | given))
