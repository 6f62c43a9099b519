"""Every variable of a resonance study: known answers of motions that are written down."""

import numpy as np
import pytest

from gearlube.studies.resonance import run
from gearlube.studies.resonance.cycle_dataset import cycle_dataset
from gearlube.studies.resonance.datasets import resonance_dataset
from gearlube.studies.resonance.figures.response_curves import draw_branch
from gearlube.studies.resonance.response import Response, Segment
from tests.helpers.known_answers import assert_attributes, assert_variables, made_up, named

TEETH, NATURAL = 13, 500.0  # Hz


def wave(periods, samples):
    """Return 7, 3 and 4 of the orders 0, 1 and 2 of the mesh: 4 from -3 to 7 - 4 + 3.

    Its least value is 7 + 3 c + 4 (2 c^2 - 1) at c = -3/16: 2.71875; its largest is 14.
    """
    phase = 2.0 * np.pi * periods * np.arange(samples) / samples
    return 7.0 + 3.0 * np.cos(phase) + 4.0 * np.cos(2.0 * phase)


def a_problem(periods=1):
    mesh = named(name="a mesh", orders=8, pinion_teeth=TEETH)
    model = named(
        natural_frequency=NATURAL, pinion_speed=lambda hertz: 2.0 * np.pi * hertz / TEETH,
        parameters=named(mesh=mesh, backlash=1e-4), damping_ratio=0.05, static_deflection=5e-6,
        stiffness=3e8, equivalent_mass=0.25, kernel_parameters=named(thermal_oil=named(tau0=5e6)),
    )  # fmt: skip

    def orbit(unknowns, speed):
        size = 1e-6 * float(unknowns[0])
        return named(x=size * wave(periods, 64 * periods), separation_share=1e4 * size)

    return named(periods=periods, model=model, orbit=orbit)


def a_segment(relative, unknowns, multipliers, stable, periods=1, special=()):
    speed = 2.0 * np.pi * NATURAL * np.array([*relative, *(one[1] for one in special)]) / TEETH
    points = [
        named(kind=kind, parameter=at, unknowns=np.array([z]))
        for (kind, _, z), at in zip(special, speed[len(relative) :], strict=True)
    ]
    branch = named(
        parameter=speed[: len(relative)], unknowns=np.array(unknowns)[:, None],
        multipliers=np.array(multipliers), stable=np.array(stable), special=points,
    )  # fmt: skip
    return Segment(problem=a_problem(periods), branch=branch)


def a_study(**parts):
    settings = named(
        radii="mean", friction="none", pinion_torque=50.0, oil_temperature=313.15, first=0.5,
        roughness_rms=5e-7, last=1.2,
        parameters=lambda model: named(mesh=named(pinion_teeth=TEETH)),
    )  # fmt: skip
    usual = {"settings": settings, "responses": {}, "sweeps": {}, "motions": [], "section": None,
             "cycles": [], "curves": [], "interrupted": False}  # fmt: skip
    return named(**usual | parts)


LEAST = wave(1, 64).min()  # of 64 samples, 2.71875 between them
NAN = np.nan


def test_variables_of_the_responses_are_known():
    """Three rows of one model, of which the last takes two mesh periods; one of the other."""
    first = a_segment([0.5, 0.75], [2.0, 3.0], [[0.5j, 0.25], [-1.5, 0.125]], [True, False])
    second = a_segment([1.0], [4.0], [[0.5, 0.25, 0.125]], [True], periods=2,
                       special=[("fold", 0.625, 2.5)])  # fmt: skip
    alone = a_segment([1.25], [5.0], [[0.75, 0.5]], [True])
    responses = {
        "two_dof": Response(model="two_dof", segments=[first, second]),
        "one_dof": Response(model="one_dof", segments=[alone]),
    }
    sweeps = {
        ("two_dof", direction): named(
            frequency=np.zeros(2), mean_speed=k * np.array([100.0, 200.0]),
            peak_to_peak=k * np.array([1e-6, 2e-6]), minimum=-k * np.array([3e-6, 4e-6]),
            separation_share=k * np.array([0.1, 0.2]),
        )
        for k, direction in ((1.0, "up"), (2.0, "down"))
    }  # fmt: skip
    made = resonance_dataset(a_study(responses=responses, sweeps=sweeps))
    size = 1e-6 * np.array([[2.0, 3.0, 4.0], [5.0, NAN, NAN]])
    relative = np.array([[0.5, 0.75, 1.0], [1.25, NAN, NAN]])
    both = np.array([1.0, 2.0])[None, :, None]
    expected = {
        "relative_frequency": ("1", relative),
        "frequency": ("Hz", NATURAL * relative),
        "peak_to_peak": ("m", (14.0 - LEAST) * size),
        "minimum": ("m", LEAST * size),
        "maximum": ("m", 14.0 * size),
        "mean": ("m", 7.0 * size),
        "separation_share": ("1", 1e4 * size),
        "multiplier": ("1", [[0.5, 1.5, 0.5], [0.75, NAN, NAN]]),
        "stable": ("1", [[1.0, 0.0, 1.0], [1.0, NAN, NAN]]),
        "segment": ("1", [[0.0, 0.0, 1.0], [0.0, NAN, NAN]]),
        "periods": ("1", [[1.0, 1.0, 2.0], [1.0, NAN, NAN]]),
        "harmonics": ("m", size[..., None] * np.array([3.0, 4.0, 0.0, 0.0, 0.0, 0.0])),
        "multipliers": (
            "1",
            [[[0.5, 0.25, NAN], [1.5, 0.125, NAN], [0.5, 0.25, 0.125]],
             [[0.75, 0.5, NAN], [NAN] * 3, [NAN] * 3]],
        ),
        "special_kind": ("", [["fold"], [""]]),
        "special_relative_frequency": ("1", [[0.625], [NAN]]),
        "special_peak_to_peak": ("m", [[(14.0 - LEAST) * 2.5e-6], [NAN]]),
        "special_segment": ("1", [[1.0], [NAN]]),
        "sweep_relative_frequency": (
            "1", both * np.array([100.0, 200.0]) * TEETH / (2.0 * np.pi * NATURAL)
        ),
        "sweep_peak_to_peak": ("m", both * np.array([1e-6, 2e-6])),
        "sweep_minimum": ("m", -both * np.array([3e-6, 4e-6])),
        "sweep_separation_share": ("1", both * np.array([0.1, 0.2])),
        "swept_model": ("", ["two_dof"]),
        "direction": ("", ["up", "down"]),
        "sweep": ("1", [0, 1]),
        "model": ("", ["two_dof", "one_dof"]),
        "harmonic": ("1", np.arange(1, 7)),
    }  # fmt: skip
    assert abs(LEAST - 2.71875) < 0.01
    assert_variables(made, expected)
    known = {
        "pinion_torque": 50.0, "oil_temperature": 313.15, "roughness_rms": 5e-7, "first": 0.5,
        "last": 1.2, "mesh_orders": 8, "natural_frequency": NATURAL, "damping_ratio": 0.05,
        "static_deflection": 5e-6, "mesh_stiffness": 3e8, "equivalent_mass": 0.25,
        "backlash": 1e-4, "pinion_teeth": TEETH,
    }  # fmt: skip
    assert_attributes(made, known)


def a_motion(model, size, periods, stable):
    x = size * wave(periods, 256 * periods)
    return named(
        model=model, relative=0.5 * periods, stable=stable, multiplier=0.75 * periods, rate=2.0 * x,
        orbit=named(x=x, force=3.0 * x, separation_share=0.125 * periods),
        problem=a_problem(periods),
    )  # fmt: skip


def test_variables_of_motions_and_contacts_are_known():
    units = {
        "load": "N", "R_sliding": "m", "entrainment_speed": "m s-1", "sliding_speed": "m s-1",
        "film_thickness": "m", "film_ratio": "1", "mean_pressure": "Pa", "inlet_viscosity": "Pa s",
        "effective_viscosity": "Pa s", "rise_centre": "K", "rise_effective": "K",
        "shear_rate": "s-1", "shear_stress": "Pa", "newtonian_stress": "Pa", "area": "m2",
        "asperity_area": "m2", "viscous_friction": "N", "boundary_friction": "N",
        "friction_coefficient": "1", "torque_pinion": "N m", "torque_gear": "N m",
        "pressure_number": "1", "film_number": "1", "slip_number": "1",
        "largest_stress_ratio": "1", "state": "1",
    }  # fmt: skip
    motions = [a_motion("two_dof", 2.0, 1, True), a_motion("one_dof", 3.0, 2, False)]
    values = {name: made_up(name, 3, 4) for name in units}
    cycles = [
        named(values={name: k * one for name, one in values.items()}, motion=motions[0],
              oil_temperature=310.0 * k)
        for k in (1.0, 2.0)
    ]  # fmt: skip
    curves = ("thermal_eyring", "isothermal_eyring", "thermal_newtonian", "isothermal_newtonian")
    traction = [
        named(stress={name: k * made_up(name, 121) for name in curves}, pressure=k * 1e9,
              effective_viscosity=k * made_up("eta", 121), film_thickness=k * 1e-7,
              viscosity=k * 5.0)
        for k in (1.0, 2.0)
    ]  # fmt: skip
    section = named(relative=0.75, x=made_up("x", 2, 5), rate=made_up("rate", 2, 5),
                    motions=motions)  # fmt: skip
    made = cycle_dataset(a_study(motions=motions, section=section, cycles=cycles, curves=traction))
    size, k = np.array([2.0, 3.0]), np.array([1.0, 2.0])
    shown = np.outer(size, wave(2, 512))
    orders = np.zeros(33)
    orders[[0, 2, 4]] = 7.0, 3.0, 4.0
    expected = {
        "motion_model": ("", ["two_dof", "one_dof"]),
        "sample": ("1", np.arange(512) / 256),
        "order": ("1", np.arange(33) / 2),
        "x": ("m", shown),
        "rate": ("m s-1", 2.0 * shown),
        "force": ("N", 3.0 * shown),
        "spectrum": ("m", np.outer(size, orders)),
        "motion_relative_frequency": ("1", [0.5, 1.0]),
        "motion_stable": ("1", [1.0, 0.0]),
        "motion_multiplier": ("1", [0.75, 1.5]),
        "motion_periods": ("1", [1.0, 2.0]),
        "motion_separation_share": ("1", [0.125, 0.25]),
        "section_x": ("m", section.x),
        "section_rate": ("m s-1", section.rate),
        "section_motion_x": ("m", 14.0 * size),
        "section_motion_rate": ("m s-1", 28.0 * size),
        "section_motion_stable": ("1", [1.0, 0.0]),
        "phase": ("1", np.arange(4) / 4),
        "case_relative_frequency": ("1", [0.5, 0.5]),
        "case_oil_temperature": ("K", 310.0 * k),
        "curve": ("", curves),
        "curve_shear_rate": ("s-1", 10.0 ** (2.0 + np.arange(121) / 20.0)),
        "curve_stress": ("Pa", [[f * made_up(name, 121) for name in curves] for f in k]),
        "curve_effective_viscosity": ("Pa s", np.outer(k, made_up("eta", 121))),
        "curve_pressure": ("Pa", 1e9 * k),
        "curve_film_thickness": ("m", 1e-7 * k),
        "curve_viscosity": ("Pa s", 5.0 * k),
    } | {name: (unit, np.multiply.outer(k, values[name])) for name, unit in units.items()}
    assert_variables(made, expected)
    assert_attributes(made, {"section_relative_frequency": 0.75, "eyring_stress": 5e6})


def test_variables_of_the_response_over_load_are_known(monkeypatch):
    """Two branches of the pair of two degrees of freedom, one of the other."""

    def branches(settings, relative, form, response):
        rows = {"two_dof": ([10.0, 20.0, 30.0], [40.0]), "one_dof": ([50.0, 60.0],)}[form]
        return [
            named(problem=a_problem(), torque=np.array(torque), stable=np.array(torque) % 20.0,
                  unknowns=np.array(torque)[:, None], special=np.array([25.0][: len(torque) - 1]),
                  special_unknowns=np.array([[25.0]][: len(torque) - 1]))
            for torque in rows
        ]  # fmt: skip

    monkeypatch.setattr(run, "_load_branches", branches)
    made = run.load_response(named(pinion_torque=50.0), 0.75, {})
    torque = np.array([[[10.0, 20.0, 30.0], [40.0, NAN, NAN]],
                       [[50.0, 60.0, NAN], [NAN, NAN, NAN]]])  # fmt: skip
    special = np.full((2, 2, 3), NAN)
    special[0, 0, 0] = special[1, 0, 0] = 25.0
    size = 1e-6 * torque
    expected = {
        "torque": ("N.m", torque),
        "peak_to_peak": ("m", (14.0 - LEAST) * size),
        "minimum": ("m", LEAST * size),
        "separation_share": ("1", 1e4 * size),
        "stable": ("1", torque % 20.0),
        "special_torque": ("N.m", special),
        "special_peak_to_peak": ("m", (14.0 - LEAST) * 1e-6 * special),
        "form": ("", ["two_dof", "one_dof"]),
        "branch": ("", [0, 1]),
    }
    assert_variables(made, expected)
    assert_attributes(made, {"relative_frequency": 0.75, "torque_asked_for": 50.0})


@pytest.mark.parametrize(
    ("stable", "stretches"),
    [
        ([1, 1, 0, 0, 1], [("-", 0, 3), ("--", 2, 5), ("-", 4, 5)]),
        ([0, 1, 1], [("--", 0, 2), ("-", 1, 3)]),
        ([1, 1], [("-", 0, 2)]),
    ],
)
def test_a_drawn_branch_has_no_gap_where_its_stability_changes(stable, stretches):
    drawn = []
    ax = named(plot=lambda x, y, color, ls: drawn.append((ls, int(x[0]), int(x[-1]) + 1, *y)))
    place = np.arange(float(len(stable)))
    branch = {
        name: named(values=values)
        for name, values in (("relative_frequency", place), ("stable", np.array(stable, float)))
    }
    draw_branch(ax, branch, 10.0 * place, "black")
    assert drawn == [(ls, a, b, *(10.0 * place[a:b])) for ls, a, b in stretches]
