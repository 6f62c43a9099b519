"""Tables of every command in the forms that spreadsheets and instruments write."""

from __future__ import annotations

import re

import numpy as np
import pytest

from drivetrain.cycle.traces import DriveCycle
from gearlube.studies.film_model.audit import visited_points
from gearlube.studies.sound.transfer_path import read_csv_path
from gearlube_core.errors import ParameterError
from gearlube_core.friction.traction_measurements import read_traction
from gearlube_core.hypoid_geometry.measured.measured_file import read_pitch, read_waves
from gearlube_core.input_file import table
from gearlube_core.surface.measured_heights import read_profile
from tests.helpers.each import each

GEAR = ("gear", "drive")


# names, rows, what reads them, and numbers in the file's units that it must find
READERS = {
    "cycle": (
        ("time_s", "speed_kmh"),
        [("0", "0"), ("1", "3.5"), ("2", "7.25"), ("3", "9.5")],
        lambda path: DriveCycle.given(str(path)).speed * 3.6,
        (0.0, 3.5, 7.25, 9.5),
    ),
    "sound": (
        ("frequency [Hz]", "pinion.axial real [Pa/N]", "pinion.axial imag [Pa/N]"),
        [("100", "0.5", "0.25"), ("200", "0.6", "0.3"), ("400", "0.7", "0.1")],
        lambda path: read_csv_path(path).responses["pinion.axial"].imag,
        (0.25, 0.3, 0.1),
    ),
    "film-model": (
        ("pinion_speed_rpm", "pinion_torque_n_m", "oil_temperature_degc"),
        [("1000", "50.5", "80"), ("1500", "60.5", "90"), ("2000", "-20.25", "80")],
        lambda path: visited_points(path).torque,
        (50.5, 60.5, -20.25),
    ),
    "roughness": (
        ("x_mm", "height_um"),
        [("0", "0.5"), ("1", "-1.25"), ("2", "0"), ("3", "1.5")],
        lambda path: read_profile(path).height * 1e6,
        (0.5, -1.25, 0.0, 1.5),
    ),
    "oil fit": (
        (
            "slide_roll_ratio",
            "entrainment_speed_m_s",
            "hertz_pressure_gpa",
            "temperature_degc",
            "traction_coefficient",
        ),
        [(f"0.{k}", "2.5", "1.2", "60", f"0.03{k}") for k in range(1, 6)],
        lambda path: read_traction(path, "line").traction,
        (0.031, 0.032, 0.033, 0.034, 0.035),
    ),
    "measured: pitch": (
        ("member", "flank", "tooth", "deviation_um"),
        [(*GEAR, "1", "1.5"), (*GEAR, "2", "-2.5"), (*GEAR, "3", "1.0")],
        lambda path: read_pitch(path, {"gear": 3}, "cumulative")[GEAR] * 1e6,
        (1.5, -2.5, 1.0),
    ),
    "measured: waves": (
        ("member", "flank", "waves", "amplitude_um", "phase_deg"),
        [(*GEAR, "83", "0.25", "90.5"), (*GEAR, "84", "0.5", "0"), (*GEAR, "85", "1.5", "0")],
        lambda path: [1e6 * wave.amplitude for wave in read_waves(path)[GEAR]],
        (0.25, 0.5, 1.5),
    ),
}


def lines(head, rows, mark=",", quote=str):
    return "".join(mark.join(map(quote, row)) + "\n" for row in (head, *rows))


def commas(rows):
    return [[cell.replace(".", ",") for cell in row] for row in rows]


# bytes of a table with these names and rows
FORMS = {
    "plain": lambda h, r: lines(h, r).encode(),
    "tab": lambda h, r: lines(h, r, "\t").encode(),
    "semicolon, point": lambda h, r: lines(h, r, ";").encode(),
    "semicolon, comma": lambda h, r: lines(h, commas(r), ";").encode(),
    "tab, comma": lambda h, r: lines(h, commas(r), "\t").encode(),
    "quoted": lambda h, r: lines(h, r, quote=lambda one: f'"{one}"').encode(),
    "quoted, comma": lambda h, r: lines(h, commas(r), quote=lambda one: f'"{one}"').encode(),
    "spaces": lambda h, r: lines(h, r, " ,\t").encode(),
    "byte order mark": lambda h, r: lines(h, r).encode("utf-8-sig"),
    "UTF-16": lambda h, r: lines(h, r, "\t").encode("utf-16"),
    "UTF-16 big": lambda h, r: b"\xfe\xff" + lines(h, commas(r), ";").encode("utf-16-be"),
    "cp1252 comment": lambda h, r: ("# Prüfstand 5 µm\n" + lines(h, r)).encode("cp1252"),
    "comments": lambda h, r: (
        '% a "b\n// c\n"# d, e"\n'
        + lines(h, r[:1])
        + "\n# f,,\n"
        + lines(h, r[1:]).split("\n", 1)[1]
    ).encode(),
    "trailing": lambda h, r: lines((*h, "", ""), [(*row, "", "") for row in r]).encode(),
    "trailing in rows": lambda h, r: lines(h, [(*row, "") for row in r], ";").encode(),
    "empty lines": lambda h, r: ("\n" + lines(h, r).replace("\n", "\n\n  \n,,\n") + "\n").encode(),
    "Windows": lambda h, r: lines(h, r).replace("\n", "\r\n").encode(),
    "old Mac": lambda h, r: lines(h, r).replace("\n", "\r").encode(),
    "no last line end": lambda h, r: lines(h, r).rstrip().encode(),
    "sep=": lambda h, r: ("sep=;\n" + lines(h, commas(r), ";")).encode(),
    "capitals": lambda h, r: lines([h[0][0].upper() + h[0][1:], *h[1:]], r).encode(),
}


@each("form", FORMS)
@each("command", READERS)
def test_every_command_reads_every_form_of_a_table(command, form, tmp_path):
    head, rows, read, expected = READERS[command]
    path = tmp_path / "table.csv"
    path.write_bytes(FORMS[form](head, rows))
    # decimal digits to binary and back, and one sum over the teeth
    assert np.asarray(read(path)) == pytest.approx(expected, abs=1e-12)


def last(rows, change):
    return [*rows[:-1], change(rows[-1])]


# bytes of a table that is wrong, and the words about it; {n} is its last line, {w} its width
FAULTS = {
    "cut row": (lambda h, r: lines(h, last(r, lambda one: one[:1])), "line {n}: has 1 of {w} col"),
    "more cells": (
        lambda h, r: lines(h, last(r, lambda one: (*one, "8"))),
        "line {n}: has {m} of {w} columns",
    ),
    "no number": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], "abc"))),
        "line {n}: {name} must be a finite number.* got 'abc'",
    ),
    "gap": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], ""))),
        "line {n}: {name} must be a finite number.*, got ''. Fill the gap",
    ),
    "nan": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], "NaN"))),
        "line {n}: {name} must be a finite number.*, got 'NaN'. Fill",
    ),
    "infinite": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], "1e999"))),
        "line {n}: {name} must be a finite number.*, got '1e999'",
    ),
    "underscores": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], "1_0"))),
        "line {n}: {name} must be a finite number.*, got '1_0'",
    ),
    "thousands": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], "1.234,5")), ";"),
        "line {n}: {name} must be .*got '1.234,5'. Leave out the marks between thousands",
    ),
    "American thousands": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], '"1,234.5"'))),
        "line {n}: {name} must be .*got '1,234.5'. Leave out the marks between thousands",
    ),
    "two decimal marks": (
        lambda h, r: lines(h, last(r, lambda one: (*one[:-1], "1,5")), ";"),
        "one decimal mark, got '1,5' in line {n} and ",
    ),
    "column twice": (
        lambda h, r: lines((*h, h[-1]), [(*row, row[-1]) for row in r]),
        "each column once, got {name} in several",
    ),
    "column missing": (lambda h, r: lines(h[:-1], [row[:-1] for row in r]), "must have"),
    "no rows": (lambda h, r: lines(h, []), "at least [1-5] rows? of values below .*, got 0"),
    "nothing": (lambda h, r: "", "must have a line of names and rows, got none"),
    "comments only": (lambda h, r: "# a\n", "must have a line of names and rows, got none"),
    "open quote": (
        lambda h, r: lines(h, r) + '"' + lines(h, r),
        "a quote opened in line {after} is never closed",
    ),
    "long cell": (lambda h, r: lines(h, r) + "x" * 140_000, "line {after}: must be cells of at m"),
    "workbook": (lambda h, r: b"PK\x03\x04\x14\x00\x06", "must be text in UTF-8, .* workbook"),
    "cut UTF-16": (lambda h, r: lines(h, r).encode("utf-16")[:-1], "must be text in UTF-8"),
    "UTF-16 without mark": (lambda h, r: lines(h, r).encode("utf-16-le"), "must be text in UTF-8"),
}


@each("fault", FAULTS)
@each("command", READERS)
def test_every_command_refuses_a_wrong_table_with_its_line(command, fault, tmp_path):
    head, rows, read, _ = READERS[command]
    content, words = FAULTS[fault]
    path = tmp_path / "table.csv"
    made = content(head, rows)
    path.write_bytes(made if isinstance(made, bytes) else made.encode())
    n, w = len(rows) + 1, len(head)
    if command == "cycle" and fault == "column missing":
        words = "must have either speed, or pinion speed"
    if command == "oil fit" and fault == "no rows":
        words = "at least 5 rows"
    words = words.format(n=n, after=n + 1, w=w, m=w + 1, name=re.escape(head[-1]))
    with pytest.raises(ParameterError, match=words) as refused:
        read(path)
    if fault not in ("column missing",):
        assert "table.csv" in str(refused.value)


def test_quoted_thousands_in_a_comma_table_are_not_taken_as_decimals(tmp_path):
    path = tmp_path / "trace.csv"
    path.write_text('x_mm,height_um\n0,"1,234"\n1,"2,500"\n')
    with pytest.raises(ParameterError, match="line 2: '1,234' may be a decimal number or thousan"):
        table.read_table(path)
    path.write_text('x_mm,height_um\n0,"0,034"\n1,"2,500"\n')
    assert table.read_table(path).column("height_um").tolist() == [0.034, 2.5]


def test_names_with_separators_and_line_ends_in_quotes_are_kept(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text('"speed; measured [km/h]","torque,\n mean"\n"1,5",2\n')
    found = table.read_table(path)
    assert found.names == ["speed; measured [km/h]", "torque, mean"]
    assert next(iter(found)).where.endswith("t.csv, line 3")
    assert found.column("speed; measured [km/h]").tolist() == [1.5]


def test_a_table_larger_than_the_limit_is_refused_unread(tmp_path, monkeypatch):
    monkeypatch.setattr(table, "LARGEST", 20)
    path = tmp_path / "t.csv"
    path.write_text("a,b\n" + "1,2\n" * 10)
    with pytest.raises(ParameterError, match="at most 2e-05 MB, got 4"):
        table.read_table(path)
    with pytest.raises(ParameterError, match="must be an ordinary file, got a device"):
        table.read_table("/dev/zero")  # has no end
