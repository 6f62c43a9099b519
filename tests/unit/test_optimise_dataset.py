"""Every variable of optimised flanks: known answers of measures that are written down."""

import numpy as np
import pytest

from gearlube.studies.optimise.dataset import measure_rows, optimise_dataset
from tests.helpers.contact_cases import shipped_file
from tests.helpers.known_answers import assert_variables, named

OF_ORDERS = ("orders", "whine", "spread", "swing")


def an_evaluation(k):
    """Return measures of one torque, two errors and four phases, times k."""
    whine_of = 1e-6 * k * np.array([[20.0, 30.0]])
    return named(
        rotation=1e-5 * k * np.arange(8.0).reshape(1, 2, 4),
        pressure=1e9 * k * np.ones((1, 2, 4)),
        sliding=0.1 * k * np.ones((1, 2, 4)),
        edge_share=0.03 * k * np.ones((1, 2, 4)),
        force=500.0 * k * np.ones((1, 2, 4)),
        orders=lambda _: (1e-6 * k * np.array([[[3.0 + 4.0j], [6.0 + 8.0j]]]), None),
        whine=lambda _: whine_of,
        spread=lambda _: np.array([1e-6 * k * 7.0]),
        swing=lambda _: (np.array([0.11 * k]), None),
        highest_pressure=np.array([1.3e9 * k]),
        mean_sliding=np.array([0.17 * k]),
        largest_edge_share=np.array([0.19 * k]),
        highest_other_pressure=np.array([1.9e9 * k]),
        largest_other_edge_share=np.array([0.23 * k]),
    )


def test_optimise_variables_are_known():
    limits = named(
        sensitivity=1.1, pressure=1.2, loss=1.3, force_swing=1.4, edge_share=0.4,
        other_side_torques_n_m=(60.0,), other_side_pressure=1.5, other_side_edge_share=0.6,
    )  # fmt: skip
    given = named(orders=(1,), torques_n_m=(50.0,), limits=limits, name="mine", aim="mean")
    file = shipped_file()
    problem = named(
        given=given,
        file=file,
        names=("pinion.machine.radial_setting_mm",),
        low=np.array([5.0]),
        high=np.array([40.0]),
        scenarios=[named(name="none"), named(name="axial")],
        is_hypoid=True,
        other_side="coast",
    )
    better = named(
        checked=an_evaluation(0.5), values=np.array([12.0]), file=file, rounds=[named(kept=True)]
    )
    point = named(whine=0.8, loss=0.9, values=np.array([9.0]))
    found = named(
        problem=problem, before=an_evaluation(1.0), better=better, nominal=None, front=[point]
    )
    made = optimise_dataset(found)
    both = np.array([1.0, 0.5]).reshape(2, 1, 1, 1)
    whole = np.ones((1, 2, 4))
    measures = [
        (50.0, "mesh order 1", "urad", 5.0, np.nan),
        (50.0, "all orders", "urad", 20.0, np.nan),
        (50.0, "all orders, root mean square over errors", "urad", 650.0**0.5, np.nan),
        (50.0, "all orders, worst error", "urad", 30.0, np.nan),
        (50.0, "sensitivity to errors", "urad", 7.0, 1.1),
        (50.0, "highest pressure", "GPa", 1.3, 1.2),
        (50.0, "sliding loss over friction coefficient", "1", 0.17, 1.3),
        (50.0, "mesh orders of the force over its mean", "1", 0.11, 1.4),
        (50.0, "largest share of load in the border", "1", 0.19, 0.4),
        (60.0, "highest pressure, coast flanks", "GPa", 1.9, 1.5),
        (60.0, "largest share of load in the border, coast flanks", "1", 0.23, 0.6),
    ]
    torque, name, unit, before, limit = zip(*measures, strict=True)
    own = file.pinion.machine.radial_setting_mm
    expected = {
        "transmission_error": ("rad", both * 1e-5 * np.arange(8.0).reshape(1, 2, 4)),
        "pressure": ("Pa", both * 1e9 * whole),
        "sliding_loss": ("1", both * 0.1 * whole),
        "edge_share": ("1", both * 0.03 * whole),
        "force": ("N", both * 500.0 * whole),
        "amplitude": ("rad", both * 1e-6 * np.array([[[5.0], [10.0]]])),
        "whine": ("rad", both[..., 0] * 1e-6 * np.array([[20.0, 30.0]])),
        "spread": ("rad", both[..., 0, 0] * 7e-6),
        "value": ("", [[own], [12.0]]),
        "value_unit": ("", ["mm"]),
        "low": ("", [5.0]),
        "high": ("", [40.0]),
        "measure_torque": ("N.m", torque),
        "measure_name": ("", name),
        "measure_unit": ("", unit),
        "measure_before": ("as in measure_unit", before),
        "measure_after": ("as in measure_unit", 0.5 * np.array(before)),
        "measure_limit": ("1", limit),
        "front_whine": ("1", [0.8]),
        "front_loss": ("1", [0.9]),
        "front_value": ("", [[9.0]]),
        "design": ("", ["before", "better"]),
        "torque": ("N.m", [50.0]),
        "error": ("", ["none", "axial"]),
        "phase": ("1", [0.0, 0.25, 0.5, 0.75]),
        "order": ("", [1]),
        "parameter": ("", list(problem.names)),
    }
    assert_variables(made, expected)
    assert made.attrs["improved"] == 0  # the first round is the start
    better.rounds.append(named(kept=True))
    assert optimise_dataset(found).attrs["improved"] == 1
    # the second of two torques has its own measures, 10 times as large
    for k, one in ((1.0, found.before), (0.5, better.checked)):
        more = an_evaluation(10.0 * k)
        for name in ("highest_pressure", "mean_sliding", "largest_edge_share"):
            setattr(one, name, np.append(getattr(one, name), getattr(more, name)))
        pairs = {name: (getattr(one, name)(None), getattr(more, name)(None)) for name in OF_ORDERS}
        for name, (own, other) in pairs.items():
            both = [
                np.concatenate([a, b])
                for a, b in zip(
                    *(
                        (part,) if isinstance(part, np.ndarray) else part[:1]
                        for part in (own, other)
                    ),
                    strict=True,
                )
            ]
            value = both[0] if isinstance(own, np.ndarray) else (both[0], None)
            setattr(one, name, lambda _, value=value: value)
    given.torques_n_m = (50.0, 60.0)
    rows = [row for row in measure_rows(found) if row.torque == 60.0 and "coast" not in row.what]
    assert [row.before for row in rows] == pytest.approx([10.0 * one for one in before[:9]])
    given.torques_n_m = (50.0,)
