"""A run-up: known answers of a ramp that is written by hand."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.runup.findings import findings, numbers
from gearlube.studies.runup.report import runup_report, summary_csv, tables
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables, quantities

RPM = np.pi / 30.0  # rad/s
KMH = 3.6 * 0.3 * 10.0 / 40.0 * RPM  # of the car at 1 rpm of the pinion
BLOCKS = np.array([1000.0, 1500.0, 2000.0])  # rpm; 10 teeth: 166.7, 250 and 333.3 Hz
OVERALL = [(12.0, 16.0), (25.0, 60.0), (18.0, 24.0)]  # N rms of two forces: 20, 65 and 30 together
# rms of the mesh orders over the blocks [N]; at 1500 rpm 30 N of order 1 on the pinion
PINION = np.array([[13.0, 5.0, 3.0], [30.0, 7.0, 2.0], [17.0, 11.0, 1.0]])
CRITICAL = {  # rpm, damping ratio
    ("turning", 1): (1530.0, 0.05),
    ("turning", 2): (765.0, 0.05),
    ("axial", 1): (2200.0, 0.02),
    ("axial", 2): (1100.0, 0.02),
    ("axial", 3): (733.0, 0.02),
}


def ramp(duration=20.0, separated=0.013, ranges=""):
    """Return a run-up of two bearings and directions, three blocks and orders, two modes."""
    track = np.zeros((3, 2, 2, 3))
    track[:, 0, 0] = PINION
    track[1, 1, 1, 0] = 40.0
    overall = np.zeros((3, 2, 2))
    overall[:, 0, 0], overall[:, 1, 1] = np.transpose(OVERALL)
    critical = np.full((2, 2, 3), np.nan)
    for (mode, order), (rpm, damping) in CRITICAL.items():
        critical[:, ("turning", "axial").index(mode), order - 1] = rpm * RPM, damping
    where = ("block", "bearing", "direction")
    loss = np.full((20, 2), 7.0)
    loss[-2:] = [110.0, 50.0], [90.0, 30.0]
    return xr.Dataset(
        {
            "block_speed": ("block", BLOCKS * RPM),
            "block_time": ("block", [2.0, 11.0, 19.0]),
            "mode_speed": ("mode_speed", np.array([1000.0, 2000.0]) * RPM),
            "bearing_force_track": ((*where, "mesh_order"), np.sqrt(2.0) * track),
            "bearing_force_overall": (where, overall),
            "dte_track": (("block", "mesh_order"), 1e-6 * np.sqrt(2.0) * PINION[::-1] / 10.0),
            "dte_overall": ("block", [1.9e-6, 3.1e-6, 2.3e-6]),
            "critical_speed": (("mode", "mesh_order"), critical[0]),
            "critical_damping": (("mode", "mesh_order"), critical[1]),
            "shape_share": ("mode", [0.7, 0.3]),
            "separated_fraction": separated,
            "loss": (("slow_time", "source"), loss),
        },
        coords={
            "bearing": ["pinion", "gear"],
            "direction": ["axial", "radial 1"],
            "mesh_order": [1, 2, 3],
            "mode": ["turning", "axial"],
            "source": ["friction_viscous", "bearing_torque"],
        },
        attrs={
            "ramp": "run-up",
            "pinion_teeth": 10,
            "gear_teeth": 40,
            "rolling_radius": 0.3,
            "setting_start_speed": 100.0,
            "setting_end_speed": 200.0,
            "setting_duration": duration,
            "setting_pinion_torque": 80.0,
            "setting_oil_temperature": 353.15,
            "setting_order_resolution": 0.25,
            "setting_highest_frequency": 4000.0,
            "setting_sample_rate": 32768.0,
            "setting_settling_time": 1.0,
            "gearlube_version": "1",
            "axle": "made",
            "axle_source": "by hand",
            "mesh_table": "a table",
            "bearing_preload": 2500.0,
            "oil": "an_oil",
            "inputs_given": '[["oil", "an_oil", "", "given", ""]]',
            "inputs_assumed": "[]",
            "ranges_left": ranges,
        },
    )


def test_a_ramp_has_its_known_key_numbers_and_findings():
    known = [
        ("largest bearing forces, all frequencies", 65.0, "N rms", "65.0"),
        ("largest bearing forces of mesh order 1", 50.0, "N rms", "50.0"),  # of 30 and 40
        ("pinion speed there, order 1", 1500.0, "rpm", "1500"),
        ("largest bearing forces of mesh order 2", 11.0, "N rms", "11.0"),
        ("pinion speed there, order 2", 2000.0, "rpm", "2000"),
        ("largest bearing forces of mesh order 3", 3.0, "N rms", "3.00"),
        ("pinion speed there, order 3", 1000.0, "rpm", "1000"),
        ("largest transmission error, all frequencies", 3.1, "µm rms", "3.10"),
        ("critical speeds of orders 1 to 3 within the ramp", 2.0, "", "2"),
        (
            "from the end of the ramp to the next critical speed of the loudest order",
            10.0,
            "%",
            "10",
        ),
        ("time without contact", 1.3, "%", "1.3"),
        ("loss at the fast end", 140.0, "W", "140"),
    ]
    assert_numbers(numbers(ramp()), known)
    said = [
        (WARNING, "The loudest … on the gear in direction radial 1 … is 2 % above … 'turning' … "
         "of the kinetic energy there. The others",
         "1, 50.0 N rms, 1500 rpm, 42 km/h, 250 Hz, 40.0 N, 1, 2 %, 255 Hz, 70 %, "
         "2, 11.0 N, 2000 rpm, 3, 3.00 N, 1000 rpm"),
        # order 1 from 50 N at 1500 to 17 N at 2000 rpm, order 2 from 5 N at 1000 to 7 N at 1500
        (NOTE, "meet natural frequencies at … after that of the loudest: order 2 with 'axial' at",
         "1, 3, 2, 2, 1100 rpm, 31 km/h, 5.40 N"),
        (WARNING, "next critical speed … above the ramp … 'axial' … already raises",
         "1, 10 %, 2200 rpm, 62 km/h"),
        # the faster: 20 * 0.833 Hz/s over 3.6 (0.02 * 366.7 Hz)^2 is 8.6 %
        (GOOD, "slow enough", "9 %, 7626, 2"),
        (WARNING, "teeth are apart", "1.3 %"),
        (NOTE, "At the fast end … flank friction (fluid) 71 %, bearing drag 29 % … windage",
         "140 W, 71 %, 29 %"),
        (GOOD, "Nothing left the range", ""),
    ]  # fmt: skip
    assert_findings(findings(ramp()), said)


def test_a_fast_ramp_with_teeth_in_contact_and_a_range_left_says_so():
    left = "film.ratio: ratio should be within 1 to 2, got 3.\nrange.torque: torque is 9."
    time, speed = np.arange(20.0), np.linspace(1000.0, 1950.0, 20)
    made = ramp(duration=1.0, separated=0.0, ranges=left).assign(
        time=time, slow_time=time, pinion_speed=("time", RPM * speed),
        range_exceeded=("slow_time", speed > 1700.0),
    )  # fmt: skip
    found = findings(made)[3:]
    said = [
        (WARNING, "too fast: the worst is mesh order … 'axial'", "1, 2, 1.7, 7626, 2"),
        (GOOD, "stay in contact", ""),
        (NOTE, "At the fast end", "140 W, 71 %, 29 %"),
        (
            WARNING,
            "quantities left the range … Usable for … not for … Ratio should … Torque is",
            "2, 1000, 1700 rpm, 75 %, 1750, 1950 rpm, 1, 2, 3, 9",
        ),
    ]
    assert_findings(found, said)


@pytest.mark.parametrize(("rpm", "level"), [(2299.0, WARNING), (2301.0, GOOD)])
def test_a_margin_below_15_percent_is_a_warning(rpm, level):
    near = ramp()
    near["critical_speed"][1, 0] = rpm * RPM
    (one,) = [one for one in findings(near) if "next critical" in one.headline]
    assert one.level == level


def test_a_ramp_has_its_known_tables_and_rows():
    def critical(mode, order, force, margin):
        rpm, damping = CRITICAL[mode, order]
        hz = order * rpm / 6.0
        passes = order * 10.0 * (1000.0 / 60.0 / 20.0) / (3.6 * (damping * hz) ** 2)
        return [mode, order, rpm, KMH * rpm, hz, 100.0 * damping, force, margin, 100.0 * passes]

    expected = {
        "Crests of the mesh orders": [
            ["mesh order", "bearing forces [N rms]", "pinion speed [rpm]", "vehicle speed [km/h]",
             "frequency [Hz]", "bearing", "direction", "its part [N rms]"],
            [1, 50.0, 1500.0, 1500.0 * KMH, 250.0, "gear", "radial 1", 40.0],
            [2, 11.0, 2000.0, 2000.0 * KMH, 2000.0 / 3.0, "pinion", "axial", 11.0],
            [3, 3.0, 1000.0, 1000.0 * KMH, 500.0, "pinion", "axial", 3.0],
        ],
        "Critical speeds": [
            ["natural mode", "mesh order", "pinion speed [rpm]", "vehicle speed [km/h]",
             "frequency [Hz]", "damping ratio [%]", "bearing forces [N rms]", "margin [%]",
             "rate [%]"],
            critical("axial", 3, None, -26.7),
            critical("turning", 2, None, -23.5),
            critical("axial", 2, 5.4, 0.0),
            critical("turning", 1, 48.02, 0.0),
            critical("axial", 1, None, 10.0),
        ],
    }  # fmt: skip
    assert_tables(tables(ramp()), expected)
    head, *rows = summary_csv([ramp()]).splitlines()
    assert head == (
        "ramp,time_s,pinion_speed_rpm,vehicle_speed_kmh,bearing_forces_rms_n,"
        "bearing_forces_h1_rms_n,bearing_forces_h2_rms_n,bearing_forces_h3_rms_n,"
        "dte_rms_um,dte_h1_rms_um,dte_h2_rms_um,dte_h3_rms_um"
    )
    assert rows == [
        "run-up,2.0,1000.0,28.274,20.0,13.0,5.0,3.0,1.9,1.7,1.1,0.1",
        "run-up,11.0,1500.0,42.412,65.0,50.0,7.0,2.0,3.1,3.0,0.7,0.2",
        "run-up,19.0,2000.0,56.549,30.0,17.0,11.0,1.0,2.3,1.3,0.5,0.3",
    ]


def test_the_report_of_a_ramp_says_what_ran():
    report = runup_report([ramp()], {})
    assert report.title == "Run-up of a lubricated hypoid axle"
    # 100 and 200 rad/s; 27 and 54 km/h
    known = ["80 N·m", "955", "1910 rpm", "27", "54 km/h", "20 s"]
    assert quantities(report.subtitle) == known
    assert [(one.value, one.unit) for one in report.inputs] == [
        ("bench", ""), ("954.93", "rpm"), ("1909.86", "rpm"), ("20", "s"), ("80", "N·m"),
        ("80", "°C"), ("0.25", ""), ("4000", "Hz"), ("32768", "Hz"), ("1", "s"), ("an_oil", ""),
    ]  # fmt: skip
    facts = ["1", "made by hand", "a table", "2500 N", "an_oil"]
    assert [fact for _, fact in report.facts] == facts
    down = ramp().assign_attrs(ramp="coast-down")
    down.attrs |= {"setting_start_speed": 200.0, "setting_end_speed": 100.0}
    both = runup_report([ramp(), down], {})
    assert [one.name for one in both.numbers[12:14]] == [
        "Coast-down: largest bearing forces, all frequencies",
        "Coast-down: largest bearing forces of mesh order 1",
    ]
    assert both.numbers[-1].value == 14.0  # the first tenth of a coast-down is the fastest


def test_a_peak_beyond_the_ramp_is_explained_by_the_slip_of_the_tyres():
    short = ramp().assign(mode_speed=("mode_speed", np.array([1000.0, 1480.0]) * RPM))
    said = [one[0].detail for one in (findings(ramp()), findings(short))]  # the peak: 1500 rpm
    assert ["tyres slip" in one for one in said] == [False, True]
