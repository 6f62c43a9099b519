"""Files of reduced models: all formats give the same matrices; wrong ones are refused."""

from __future__ import annotations

import logging
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.errors import ParameterError
from gearlube_core.housings.housing_modes import housing_motion
from gearlube_core.housings.model_files import read_reduced_model
from gearlube_core.housings.reduced_model import GENERALISED, InterfaceNode, ReducedModel
from gearlube_core.housings.text_formats import read_dmig
from tests.helpers.frame_model import box_frame, reduced

FRAME = box_frame()
MODEL = replace(reduced(FRAME, modes=5), damping=1e-6 * reduced(FRAME, modes=5).stiffness)
CASE = read_reduced_model("e_axle_case")  # which has no damping, and nodes with one coordinate
NUMBERS = [101 + 10 * i for i in range(len(CASE.nodes))]
FAR = 1 + int(abs(MODEL.stiffness[0, 1:]).argmax())
LETTERS = {"K": "stiffness", "M": "mass", "C": "damping"}


def in_millimetres(model: ReducedModel) -> ReducedModel:
    """Return the model as a program in mm, t and s has it."""
    moving = np.where((model.owner == GENERALISED) | (model.direction >= 3), 1.0, 1e-3)
    factor = 1e-3 * 1e6 * np.outer(moving, moving)  # t mm2 per kg m2
    changed = {one: getattr(model, one) * factor for one in LETTERS.values()}
    nodes = tuple(InterfaceNode(n, 1e3 * x, 1e3 * y, 1e3 * z) for n, x, y, z in model.nodes)
    return replace(model, nodes=nodes, **changed)


def table(model: ReducedModel, path: Path) -> Path:
    rows = zip(NUMBERS, model.nodes, strict=False)
    lines = [f"{n},{one.name},{one.x!r},{one.y!r},{one.z!r}" for n, one in rows]
    path.write_text("\n".join(["node,name,x,y,z", *lines]))
    return path


def labels(model: ReducedModel) -> list[tuple[int, int]]:
    """Return number of node and coordinate of each row; scalar points count from 9001."""
    points = iter(range(9001, 9999))
    return [
        (next(points), 0) if owner == GENERALISED else (NUMBERS[owner], direction + 1)
        for owner, direction in zip(model.owner, model.direction, strict=True)
    ]


def punch(model: ReducedModel, style: str) -> str:
    """Return DMIG entries of form 6: large fields, small fields, or free ones."""
    rows, lines = labels(model), ["$ TITLE = CASE"]
    for letter, what in {"K": "KAAX", "M": "MAAX", "C": "BAAX"}.items():
        matrix = getattr(model, LETTERS[letter])
        if matrix is None:
            continue
        lines.append(
            f"DMIG    {what}           0       6       2       0        {'':8}{len(rows):8d}"
        )
        for j, (node, way) in enumerate(rows):
            below = [(rows[i], matrix[i, j]) for i in range(j, len(rows))]
            if style == "large":
                lines.append(f"DMIG*   {what:16}{node:16d}{way:16d}")
                lines += [
                    f"*       {n:16d}{w:16d}" + f"{a:16.9E}".replace("E", "D")
                    for (n, w), a in below
                ]
            elif style == "free":
                lines += [f"DMIG,{what},{node},{way},,{n},{w},{float(a)!r}" for (n, w), a in below]
            else:
                for (n, w), a in below:
                    short = f"{a:.2E}".replace("E", "")  # -1.23+05
                    lines.append(f"DMIG    {what:8}{node:8d}{way:8d}        {n:8d}{w:8d}{short:>8}")
    return "\n".join(lines)


def abaqus(model: ReducedModel) -> str:
    rows = [(node, max(way, 1)) for node, way in labels(model)]
    nodes = list(dict.fromkeys(node for node, _ in rows))
    lines = ["**", f"*USER ELEMENT, NODES= {len(nodes):8d}, LINEAR", "** ELEMENT NODES"]
    lines += ["** " + ", ".join(map(str, nodes[k : k + 5])) for k in range(0, len(nodes), 5)]
    before = ""
    for i, node in enumerate(nodes):
        own = ", ".join(str(way) for one, way in rows if one == node)
        if own != before:  # coordinates stand until others do
            lines.append(own if i == 0 else f"{i + 1}, {own}")
        before = own
    for letter, kind in {"K": "STIFFNESS", "M": "MASS", "C": "VISCOUS DAMPING"}.items():
        matrix = getattr(model, LETTERS[letter])
        if matrix is None:
            continue
        lines.append(f"*MATRIX,TYPE={kind}")
        for i in range(len(matrix)):
            row = [f"{a:.17e}" for a in matrix[i, : i + 1]]
            lines += [", ".join(row[k : k + 4]) + (" ," if i == 0 else "")
                      for k in range(0, i + 1, 4)]  # fmt: skip
    return "\n".join(lines)


def matrix_market(matrix: np.ndarray) -> str:
    n = len(matrix)
    entries = [f"{i + 1} {j + 1} {float(matrix[i, j])!r}" for i in range(n) for j in range(i + 1)]
    head = "%%MatrixMarket matrix coordinate real symmetric"
    return "\n".join([head, f"{n} {n} {len(entries)}", *entries])


def written(model: ReducedModel, style: str, folder: Path) -> dict[str, Path]:
    """Write the model; return what `read_reduced_model` takes."""
    nodes = {"node_table": table(model, folder / "nodes.csv")}
    if style == "npz":
        path = folder / "case.npz"
        arrays = {one: getattr(model, one) for one in LETTERS.values()}
        np.savez(path, names=[one.name for one in model.nodes], owner=model.owner,
                 places=[one[1:] for one in model.nodes], direction=model.direction,
                 **arrays)  # fmt: skip
        return {"model_file": path}
    if style == "matrix_market":
        found = {}
        for field, what in zip(("model_file", "mass_file", "damping_file"), LETTERS.values(),
                               strict=True):  # fmt: skip
            found[field] = folder / f"{what}.mtx"
            found[field].write_text(matrix_market(getattr(model, what)))
        return found | nodes
    if style == "abaqus":
        path = folder / "case.mtx"
        path.write_text(abaqus(model))
        with nodes["node_table"].open("a") as file:
            file.writelines(f"\n{n},,,," for n, way in labels(model) if way == 0)
        return {"model_file": path} | nodes
    path = folder / "case.pch"
    path.write_text(punch(model, style))
    return {"model_file": path} | nodes


@pytest.mark.parametrize(
    ("model", "style", "digits"),
    [(MODEL, "npz", 0.0), (MODEL, "large", 1e-9), (MODEL, "free", 0.0), (MODEL, "abaqus", 1e-15),
     (MODEL, "matrix_market", 0.0), (CASE, "free", 0.0), (CASE, "abaqus", 1e-15)],
)  # fmt: skip
def test_all_formats_give_the_same_model(
    model: ReducedModel, style: str, digits: float, tmp_path: Path
):
    """To the digits that are written: 10 in large fields."""
    found = read_reduced_model(**written(model, style, tmp_path))
    assert found.nodes == model.nodes
    np.testing.assert_array_equal(found.owner, model.owner)
    at_nodes = found.owner != GENERALISED
    np.testing.assert_array_equal(found.direction[at_nodes], model.direction[at_nodes])
    for what in LETTERS.values():
        one, other = getattr(found, what), getattr(model, what)
        if other is None:
            assert one is None
        else:
            np.testing.assert_allclose(one, other, rtol=digits)


def test_small_fields_have_three_digits_and_exponents_without_a_letter():
    found = read_dmig(punch(MODEL, "small"))
    for letter, what in LETTERS.items():
        np.testing.assert_allclose(found.matrices[letter], getattr(MODEL, what), rtol=5e-3)


def test_places_of_a_punch_file_name_its_nodes(tmp_path):
    path = tmp_path / "case.pch"
    grids = [f"GRID*   {n:16d}{'':16}{one.x:16.9E}{one.y:16.9E}\n*       {one.z:16.9E}"
             for n, one in zip(NUMBERS, MODEL.nodes, strict=False)]  # fmt: skip
    path.write_text("\n".join([*grids, punch(MODEL, "free")]))
    found = read_reduced_model(path)
    assert [one.name for one in found.nodes] == [f"n{n}" for n in NUMBERS[: len(MODEL.nodes)]]
    # nine digits
    np.testing.assert_allclose([one[1:] for one in found.nodes],
                               [one[1:] for one in MODEL.nodes], rtol=1e-9)  # fmt: skip


def test_a_model_in_millimetres_and_tonnes_is_converted(tmp_path):
    files = written(in_millimetres(MODEL), "free", tmp_path)
    found = read_reduced_model(**files, length_unit="mm", mass_unit="t").si()
    for what in LETTERS.values():
        np.testing.assert_allclose(getattr(found, what), getattr(MODEL, what), rtol=1e-12)
    np.testing.assert_allclose([one[1:] for one in found.nodes],
                               [one[1:] for one in MODEL.nodes], rtol=1e-12)  # fmt: skip


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({}, 'got 0.0148 kg and 209 m. length_unit = "mm" and mass_unit = "t" give 14.8 kg and'),
        (
            {"length_unit": "mm"},
            'got 0.0148 kg and 0.209 m. length_unit = "mm" and mass_unit = "t"',
        ),
        ({"mass_unit": "t"}, 'got 14.8 kg and 209 m. length_unit = "mm" and mass_unit = "t"'),
    ],
)
def test_a_model_of_millimetres_and_tonnes_is_refused_as_another_one(change: dict, words: str):
    with pytest.raises(ParameterError, match=words):
        housing_motion(replace(in_millimetres(MODEL), **change), True, 5e3, 0.0, "case")


def with_matrix(what: str, factor: float, row: int = 0, column: int = 0) -> ReducedModel:
    matrix = getattr(MODEL, what).copy()
    matrix[row, column] *= factor
    return replace(MODEL, **{what: matrix})


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: with_matrix("stiffness", 1.001, 0, FAR), "stiffness must be symmetric to 1e-08"),
        (lambda: with_matrix("mass", -1.0), "mass must not be negative in any motion.*x of a_low"),
        (lambda: replace(MODEL, mass=np.eye(3)), "mass must be 53 x 53 finite numbers"),
        (lambda: replace(MODEL, nodes=(*MODEL.nodes, InterfaceNode("lost", 0.0, 0.0, 0.0))),
         "node lost has a name but no row"),
        (lambda: replace(MODEL, direction=np.array([1, *MODEL.direction[1:]])),
         "y of a_low must have one row, got a second one, 2"),
        (lambda: replace(MODEL, nodes=(InterfaceNode("a.b", 0.0, 0.0, 0.0), *MODEL.nodes[1:])),
         "names of their own without a point"),
        (lambda: replace(MODEL, nodes=(InterfaceNode("a", 0.0, np.inf, 0.0), *MODEL.nodes[1:])),
         "y of a must be"),
        (lambda: replace(MODEL, owner=MODEL.owner + 1), "row 43 must belong to a node, 0 to 7"),
    ],
)  # fmt: skip
def test_matrices_that_are_no_housing_are_refused(make, words: str):
    with pytest.raises(ParameterError, match=words):
        make()


@pytest.mark.parametrize(
    ("make", "free", "words"),
    [
        (lambda: with_matrix("stiffness", 1.1), True, "must not hold a free housing.*along x"),
        (lambda: MODEL, False, "case must be held by its model, got one that floats"),
        (lambda: replace(MODEL, nodes=tuple(n._replace(z=2.0 * n.z) for n in MODEL.nodes)), True,
         "must not hold a free housing.*about"),
        (lambda: replace(MODEL, mass=1e6 * MODEL.mass), True, "1.48e.07 kg and 0.209 m. No unit"),
        (lambda: replace(MODEL, stiffness=1e-7 * MODEL.stiffness), True, "first elastic mode"),
        (lambda: with_matrix("stiffness", 0.0, -1, -1), True, "every coordinate.*row 53"),
    ],
)  # fmt: skip
def test_models_that_cannot_move_as_they_say_are_refused(make, free: bool, words: str):
    with pytest.raises(ParameterError, match=words):
        housing_motion(make(), free, 5e3, 0.0, "case")


def test_a_loose_part_of_a_fixed_model_is_named():
    fixed = reduced(FRAME, modes=0, fixed=True)
    n = len(fixed.owner)
    stiffness, mass = np.zeros((n + 2, n + 2)), np.eye(n + 2)
    stiffness[:n, :n], mass[:n, :n] = fixed.stiffness, fixed.mass
    stiffness[n:, n:] = 1e8 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    loose = replace(
        fixed,
        stiffness=stiffness,
        mass=mass,
        nodes=(*fixed.nodes, *(InterfaceNode(f"lid_{i}", 0.1, 0.0, 0.0) for i in (1, 2))),
        owner=np.array([*fixed.owner, 8, 9]),
        direction=np.array([*fixed.direction, 0, 0]),
    )
    with pytest.raises(ParameterError, match=r"mainly x of lid_.*a part of it is loose"):
        housing_motion(loose, False, 5e3, 0.0, "case")


def test_coordinates_without_mass_give_their_flexibility_alone():
    """A Guyan reduction of a node without mass: no mode of its own, no singular matrix."""
    fixed = reduced(FRAME, modes=0, fixed=True)
    mass = fixed.mass.copy()
    mass[:6], mass[:, :6] = 0.0, 0.0
    motion = housing_motion(replace(fixed, mass=mass), False, 5e3)
    shapes = motion.shapes.reshape(motion.stiffness.size, -1)
    exact = np.linalg.inv(fixed.stiffness)
    own = np.sqrt(np.diag(exact))
    found = (shapes.T / motion.stiffness) @ shapes
    assert abs((found - exact) / np.outer(own, own)).max() < 1e-6  # left out: 1e-9 each


def test_damping_between_modes_is_told(caplog):
    damping = np.zeros_like(MODEL.stiffness)
    damping[0, 0] = 100.0
    with caplog.at_level(logging.WARNING):
        housing_motion(replace(MODEL, damping=damping), True, 5e3)
    assert "damping between its modes" in caplog.text


@pytest.mark.parametrize(
    ("style", "old", "new", "words"),
    [
        ("large", "       6       2", "       6       4", "KAAX must be real and symmetric"),
        ("large", "MAAX", "MXXX", "case.pch must have mass, got K, C"),
        ("free", "DMIG,KAAX,101,1,,101,1", "DMIG,KAAX,101,1,,101,x", "entry DMIG, KAAX, 101"),
        ("abaqus", "*MATRIX,TYPE=MASS", "*MATRIX,TYPE=MASS\n1.0", "must have 1431 numbers"),
        ("matrix_market", "53 53", "530000 530000", "1 to 5000 rows, got 530000"),
        ("abaqus", "ELEMENT NODES", "NODES", "must list its nodes in a comment"),
        ("abaqus", "1, 2, 3, 4, 5, 6", "1, 2, three", "Abaqus line '1, 2, three'"),
    ],
)  # fmt: skip
def test_damaged_texts_are_refused(style: str, old: str, new: str, words: str, tmp_path):
    files = written(MODEL, style, tmp_path)
    text = files["model_file"].read_text()
    assert old in text
    files["model_file"].write_text(text.replace(old, new))
    with pytest.raises(ParameterError, match=words):
        read_reduced_model(**files)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("101,a_low", "102,a_low", "a row for every node of the matrices, got none for 101"),
        ("111,a_high", "101,a_high", "line 3 of .*nodes.csv must have a number"),
        ("node,", "grid,", "must have the columns node, name, x, y, z"),
    ],
)
def test_wrong_tables_of_nodes_are_refused(old: str, new: str, words: str, tmp_path):
    files = written(MODEL, "large", tmp_path)
    text = files["node_table"].read_text()
    assert old in text
    files["node_table"].write_text(text.replace(old, new))
    with pytest.raises(ParameterError, match=words):
        read_reduced_model(**files)


def test_a_train_file_takes_its_housing_from_beside_itself(tmp_path):
    """Paths count from its folder; the case carries a bearing and stands on mounts."""
    written(in_millimetres(MODEL), "npz", tmp_path)
    text = TrainFile.shipped_text("e_axle") + """
[bodies.case]
kind = "housing"
model_file = "case.npz"
length_unit = "mm"
mass_unit = "t"
highest_frequency_hz = 2000.0
model_axes = ["y", "z", "x"]

[elements.seat]
kind = "joint"
first = "motor"
second = "case.a_low"
K_xx_n_per_um = 100.0
""" + "".join(f"""
[elements.mount_{i}]
kind = "joint"
first = "case.mount_{i}"
second = "ground"
K_xx_n_per_um = 0.4
K_yy_n_per_um = 0.4
K_zz_n_per_um = 0.4
""" for i in range(1, 5))  # fmt: skip
    path = tmp_path / "axle.toml"
    path.write_text(text)
    train = TrainFile.from_toml(path).case().train
    names = {body.name for body in train.bodies}
    assert {"case.a_low", "case.mount_4", "case.modes_1", "ground"} <= names
    shown = {one.name for one in train.output_records}
    assert "case.a_low.displacement.x" in shown
    with pytest.raises(ParameterError, match=r"bodies.case.free"):
        TrainFile.from_data(
            tomllib.loads(text.replace("length_unit", "free = 3\nlength_unit")), "f"
        )
    with pytest.raises(ParameterError, match=r"case.stp was not found|must end in"):
        TrainFile.from_data(tomllib.loads(text.replace("case.npz", "case.stp")), "file")


@pytest.mark.parametrize("axes", [("x", "y"), ("x", "y", "-z"), ("x", "x", "z"), ("a", "b", "c")])
def test_axes_that_are_none_are_refused(axes: tuple[str, ...]):
    with pytest.raises(ParameterError, match="three right-handed ones"):
        Housing(name="case", model=MODEL, model_axes=axes)
