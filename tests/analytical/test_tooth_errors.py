"""Errors of single teeth: what pitch, running axis and waves add to the transmission error."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.hypoid_contact.loaded_contact import (
    LoadedSettings,
    MeshPosition,
    coupled_strip,
)
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_contact.tooth_errors.error_cycle import (
    ToothErrorCycle,
    added_rotation,
    tooth_error_cycle,
)
from gearlube_core.hypoid_contact.tooth_errors.pair_curves import (
    TurnProblem,
    contact_turns,
    position_curves,
)
from gearlube_core.hypoid_geometry.measured.tooth_errors import MemberErrors, ToothErrors, Wave
from gearlube_core.mesh_table.kernels import shaft_error
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.tooth_contact.coupled_strips import solve_coupled
from gearlube_core.tooth_contact.mesh_cycle import stack_records
from tests.helpers.contact_cases import shipped_pair
from tests.helpers.loaded_cases import FILE, stiffness

COARSE = LoadedSettings(strips=StripSettings(cells_across=16, cells_along=24))
PAIR = shipped_pair("drive")
PHASES = np.arange(4) / 4.0
TORQUE = 60.0
Z_P, Z_G = 13, 36
WAVES = ((10, 130), (30,))  # waves a turn of pinion and gear; 130 is ten in a mesh period


@pytest.fixture(scope="module")
def curves():
    return stack_records(
        position_curves(PAIR, float(phase), TORQUE, 4e-4, WAVES, 2, stiffness(), COARSE)
        for phase in PHASES
    )


@pytest.fixture(scope="module")
def states():
    """Nominal loaded states, from all pairs solved together."""
    return [MeshPosition.at(PAIR, phase).load(TORQUE, stiffness(), COARSE) for phase in PHASES]


def added(curves, torque=TORQUE, **members):
    errors = ToothErrors(**{name: MemberErrors(**fields) for name, fields in members.items()})
    return added_rotation(PAIR, torque, PHASES, curves, errors)


def order(turn, number):
    """Complex amplitude of an order in samples over one turn."""
    return 2.0 * np.fft.fft(turn)[number] / turn.size


@pytest.mark.slow
def test_curves_of_single_pairs_give_the_rotation_of_all_pairs_solved_together(curves, states):
    for i, state in enumerate(states):
        own = {name: values[i] for name, values in curves.items()}
        found = TurnProblem(PAIR, float(PHASES[i]), TORQUE, own).rotation(np.zeros((1, 5)))[0]
        # other strips, cut for each rotation: cells of a sixteenth of the contact's width
        closing = state.rotation - state.unloaded_rotation
        assert found - state.unloaded_rotation == pytest.approx(closing, rel=0.015)


@pytest.mark.slow
def test_teeth_without_errors_add_nothing_to_the_bit(curves):
    none = added(curves, pinion={"pitch": {"drive": np.zeros(Z_P)}})
    np.testing.assert_array_equal(none, np.zeros((Z_P * Z_G, PHASES.size)))


def test_a_member_turned_on_its_shaft_only_moves_the_zero(curves):
    """Towards later teeth, backwards: the pinion touches later, the gear earlier by its ratio."""
    angle = 1e-4
    late = added(curves, pinion={"pitch": {"drive": np.full(Z_P, angle)}})
    np.testing.assert_allclose(late, angle, rtol=1e-9)
    early = added(curves, gear={"pitch": {"drive": np.full(Z_G, angle)}})
    # R_g / R_p over the path is the teeth ratio within some per mille
    np.testing.assert_allclose(early, -angle * Z_G / Z_P, rtol=0.01)
    coast = added(curves, gear={"pitch": {"coast": np.full(Z_G, angle)}})
    np.testing.assert_array_equal(coast, 0.0)


@pytest.mark.parametrize("role", ["pinion", "gear"])
def test_an_eccentric_member_gives_its_order_with_the_lever_of_the_normal_force(
    curves, states, role
):
    """Displaced by u, flanks touch later by n.u / R_p: the part of u along the mesh force."""
    size, direction = 10e-6, 0.8
    found = added(curves, **{role: {"eccentricity": size, "eccentricity_angle": direction}})
    teeth, axis = (Z_P, np.array([1.0, 0.0, 0.0])) if role == "pinion" else (Z_G, [0.0, 0.0, 1.0])
    turn = found[:teeth].ravel()
    force = np.mean([state.force for state in states], axis=0)
    across = force - (force @ axis) * np.asarray(axis)
    # n / R_p = force / torque
    expected = size * np.linalg.norm(across) / TORQUE
    # mean of four positions, between which the normal turns by some per cent
    assert abs(order(turn, 1)) == pytest.approx(expected, rel=0.01)
    # and its phase: largest where the displacement points along the force on the flank
    start = PAIR.mean_point - (PAIR.mean_point @ axis) * np.asarray(axis)
    if role == "pinion":
        start = start - np.array([0.0, FILE.pair.offset_mm * 1e-3, 0.0])
    start = np.asarray(start) / np.linalg.norm(start)
    ahead = np.cross(axis, start)
    sense = -1.0 if role == "pinion" else 1.0  # drive: about -x, about +z
    towards = 1.0 if role == "gear" else -1.0  # of the force on the gear, which opens the gap
    angle = 2.0 * np.pi * np.arange(turn.size) / turn.size - direction
    moved = size * (np.cos(angle)[:, None] * start + sense * np.sin(angle)[:, None] * ahead)
    gap = towards * moved @ across / TORQUE
    assert order(gap, 1) == pytest.approx(order(turn, 1), rel=0.03)
    # sidebands about the mesh order, from the change of the normal and the load between pairs
    assert abs(order(turn, teeth - 1)) < 0.1 * expected


@pytest.mark.parametrize("role", ["pinion", "gear"])
def test_a_wobbling_member_gives_its_order_with_the_work_of_the_mesh_force(curves, states, role):
    """Tilted teeth under the force: the gap opens by the work of the force over the torque."""
    rise, place = 10e-6, 0.5
    radius = getattr(FILE.blank(), role).mean_pitch_radius
    found = added(curves, **{role: {"wobble": rise / radius, "wobble_angle": place}})
    teeth = Z_P if role == "pinion" else Z_G
    turn = found[:teeth].ravel()
    axis, side = ([1.0, 0.0, 0.0], -1.0) if role == "pinion" else ([0.0, 0.0, 1.0], 1.0)
    centre = PAIR.mean_point * axis
    if role == "pinion":
        centre = centre + np.array([0.0, FILE.pair.offset_mm * 1e-3, 0.0])
    out = PAIR.mean_point - centre
    angle = 2.0 * np.pi * np.arange(turn.size) / turn.size - place
    # where the teeth stand farthest out, and about what the member is tilted there
    farthest = np.cos(angle)[:, None] * out + side * np.sin(angle)[:, None] * np.cross(axis, out)
    tilt = rise / radius * np.cross(farthest / np.linalg.norm(out), axis)
    gap = np.zeros(angle.size)
    for state in states:
        for one in state.pairs:
            # forces on the gear point into it, against the normals
            moment = -np.cross(one.strip.point - centre, one.strip.normal)
            whole = np.einsum("ij,ijk->k", one.forces, moment)
            gap += side * tilt @ whole / TORQUE / len(states)
    # loads and their growth have centres a millimetre apart, of levers of 20 to 70 mm
    assert order(turn, 1) == pytest.approx(order(gap, 1), rel=0.06)


def test_a_small_pitch_error_is_the_mean_of_the_pairs_weighted_with_their_stiffness(curves, states):
    size, number = 2e-6, 3
    pitch = size * np.cos(2.0 * np.pi * number * np.arange(Z_P) / Z_P)
    found = added(curves, pinion={"pitch": {"drive": pitch}})
    expected = np.zeros_like(found)
    for i, state in enumerate(states):
        strips = [coupled_strip(PAIR, one.strip, stiffness()) for one in state.pairs]
        solved = solve_coupled(strips, stiffness(), TORQUE, 1e-6)
        parts = zip(state.pairs, solved.tangents, strict=True)
        tangents = [(round(one.phase - PHASES[i]), np.sum(one.strip.arm * t)) for one, t in parts]
        for j, tangent in tangents:
            share = tangent / sum(one for _, one in tangents)
            expected[:, i] += share * pitch[(np.arange(Z_P * Z_G) - j) % Z_P]
    # slopes of curves through ten points against those of the cells; at half a mesh period a pair
    # has just come into contact, and its slope is that of its first tenth
    off = np.abs(found - expected).max(axis=0) / size
    assert off.max() < 0.12
    assert np.sort(off)[-2] < 0.02
    turn = found[:Z_P].ravel()
    # the order is there, rounded off by the sharing, with sidebands about the mesh order
    assert 0.6 * size < abs(order(turn, number)) < 0.9 * size
    for sideband in (Z_P - number, Z_P + number):
        assert abs(order(turn, sideband)) > 0.01 * size
    # and nothing else but sidebands of twice the mesh order
    others = [k for k in range(1, 26) if k % Z_P not in (3, 10)]
    assert max(abs(order(turn, k)) for k in others) < 0.01 * size


@pytest.mark.parametrize(("role", "number"), [("pinion", 10), ("gear", 30)])
def test_waves_along_contact_lines_return_as_their_order_with_their_amplitude(
    curves, states, role, number
):
    size, phase = 0.5e-6, 0.4
    found = added(curves, **{role: {"waves": {"drive": waves_of(role, size, phase)}}})
    teeth = Z_P if role == "pinion" else Z_G
    amplitude = order(found[:teeth].ravel(), number)
    arm = np.mean([TORQUE / np.linalg.norm(state.force) for state in states])
    # more material: earlier by A / R_p; a contact 0.3 mm wide sees a small part of a wave
    assert arm * amplitude == pytest.approx(-size * np.exp(1j * phase), rel=0.03)


def waves_of(role, size, phase):
    """Waves in the order of WAVES, of which the first has a size."""
    numbers = WAVES[0] if role == "pinion" else WAVES[1]
    return tuple(Wave(n, size if k == 0 else 0.0, phase) for k, n in enumerate(numbers))


def test_points_are_as_far_from_contact_as_the_gear_turns_until_they_carry(states):
    """Centres of force of one tooth pair, a quarter of a mesh period apart."""
    centres = {}
    for state in states:
        for one in state.pairs:
            weight = one.forces / one.forces.sum() if one.torque > 10.0 else None
            if weight is not None and abs(one.phase) < 1.1:
                parameters = one.strip.gear_parameters.reshape(-1, 3)[np.argmax(weight)]
                centres[round(4 * one.phase)] = PAIR.gear.sample_parameters(parameters)
    here = sorted(centres)
    now = {k: PAIR.gear_in_place(here[1] / 4 * PAIR.gear_pitch, centres[k].r, centres[k].normal)
           for k in here}  # fmt: skip
    turns = [float(contact_turns(PAIR, *now[k])) for k in here]
    ahead = np.array([k - here[1] for k in here]) / 4 * PAIR.gear_pitch
    assert len(here) >= 3
    # flanks that are crowned carry up to some hundredths of a period beside the conjugate line
    np.testing.assert_allclose(turns, ahead, atol=0.1 * PAIR.gear_pitch)


def test_waves_shorter_than_the_contact_are_wide_are_averaged_away(curves):
    short = (Wave(10, 0.0, 0.0), Wave(130, 0.5e-6, 0.0))
    found = added(curves, pinion={"waves": {"drive": short}})
    long = added(curves, pinion={"waves": {"drive": waves_of("pinion", 0.5e-6, 0.0)}})
    assert np.std(found) < 0.9 * np.std(long)


def test_shifted_curves_are_the_contact_of_shifted_cells(curves):
    """All kinds of errors at once, against all pairs solved together with gaps changed."""
    rng = np.random.default_rng(1)
    pitch = 1.5e-4 * rng.normal(size=Z_P), 0.8e-4 * rng.normal(size=Z_G)
    found = added(
        curves,
        pinion={"pitch": {"drive": pitch[0]}},
        gear={"pitch": {"drive": pitch[1]}, "waves": {"drive": (Wave(30, 1e-6, 0.5),)}},
    )
    i = 1
    position = MeshPosition.at(PAIR, PHASES[i])
    wide = position.load(2.0 * TORQUE, stiffness(), COARSE)

    def rotation(mesh):
        strips = []
        for one in wide.pairs:
            strip, tooth = one.strip, mesh - round(one.phase - PHASES[i])
            gap = strip.gap
            if mesh >= 0:
                turn = 2.0 * math.pi * (mesh + PHASES[i]) / Z_G + contact_turns(
                    PAIR, strip.point, strip.normal
                )
                gap = gap + strip.arm * pitch[0][tooth % Z_P]
                gap = gap - strip.gear_arm * pitch[1][tooth % Z_G] - 1e-6 * np.cos(30 * turn + 0.5)
            strips.append(coupled_strip(PAIR, replace(strip, gap=gap), stiffness()))
        return solve_coupled(strips, stiffness(), TORQUE, 1e-6).solution.rotation

    nominal = rotation(-1)
    for mesh in (3, 200, 333):
        # cells of strips cut for one torque; errors as large as the deflection
        assert found[mesh, i] == pytest.approx(rotation(mesh) - nominal, abs=8e-6)
    assert np.ptp(found) > 4e-4


def test_errors_beyond_all_curves_are_refused(curves):
    pitch = np.zeros(Z_P)
    pitch[::2] = 5e-3
    with pytest.raises(ConvergenceError, match=r"errors of single teeth are too large"):
        added(curves, pinion={"pitch": {"drive": pitch}})


def cycle_of(error, alike=()):
    return ToothErrorCycle(
        phases=PHASES, torque=np.array([50.0]), error=error[None], pinion_teeth=Z_P,
        gear_teeth=Z_G, alike=alike,
    )  # fmt: skip


def test_orders_of_the_turns_are_what_the_dynamics_adds_up():
    meshes = np.arange(Z_P * Z_G)[:, None] + PHASES
    # mesh phase -1.5 is pinion angle zero
    pinion = 2.0 * np.pi * (meshes + 1.5) / Z_P
    gear = pinion * Z_P / Z_G
    error = 3e-6 * np.cos(2 * pinion - 0.3) + 1e-6 * np.sin(5 * gear) + 2e-7 * np.cos(30 * gear)
    both = 4e-7 * np.cos(pinion + gear)  # repeats with the hunting turn alone
    cycle = cycle_of(error + both)
    tail = np.concatenate(
        [[0.0, 0.0, Z_P / Z_G], *(one[0].ravel() for one in cycle.orders().values())]
    )
    tail[:2] = [one.shape[1] for one in cycle.orders().values()]
    for mesh, i in ((0, 0), (5, 3), (400, 2)):
        found = shaft_error(tail, float(pinion[mesh, i]))
        assert found == pytest.approx(error[mesh, i], abs=1e-15)
    assert cycle.turns()[1] == pytest.approx(4e-7 / np.sqrt(2.0), rel=1e-9, abs=0.0)
    orders, amplitudes = cycle.hunting_orders()
    assert orders == pytest.approx([1.0 + Z_P / Z_G])
    assert amplitudes[0] == pytest.approx([4e-7])
    assert cycle_of(error).hunting_orders()[0].size == 0
    table = cycle_of(error).added_to(one_level())
    assert table.shaft_error["gear"].shape == (1, Z_G, 2)


def test_what_repeats_with_the_mesh_is_counted_once():
    error = np.tile(1e-6 * np.cos(2.0 * np.pi * PHASES), (Z_P * Z_G, 1))
    orders = cycle_of(error).orders()
    assert np.abs(orders["pinion"][0, Z_P - 1]).max() == pytest.approx(1e-6, abs=1e-15)
    assert np.abs(orders["gear"]).max() < 1e-18
    assert set(cycle_of(error, alike=("pinion",)).orders()) == {"gear"}


def one_level():
    table = shipped_mesh_table("mohammadpour_2015")
    at = int(np.argmin(np.abs(table.torque - 50.0)))
    return replace(
        table,
        torque=table.torque[[at]],
        series={key: values[[at]] for key, values in table.series.items()},
        windows={key: values[[at]] for key, values in table.windows.items()},
    )


@pytest.mark.parametrize(
    ("table", "waves", "words"),
    [
        (replace(one_level(), gear_teeth=41), 10, "13 and 36 teeth, got one of 13 and 41"),
        (one_level(), 14, "at most 13 a turn with 4 positions, got 14. Take at least 5"),
    ],
)
def test_a_foreign_table_and_too_many_waves_are_refused(table, waves, words):
    errors = ToothErrors(pinion=MemberErrors(waves={"drive": (Wave(waves, 1e-6, 0.0),)}))
    both = {"drive": stiffness(), "coast": stiffness()}
    settings = CycleSettings(torques=(50.0,), positions=4)
    with pytest.raises(ParameterError, match=words):
        tooth_error_cycle(FILE, both, table, errors, settings)
