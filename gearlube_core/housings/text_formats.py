"""Reduced models as Nastran and Abaqus write them: a number of node and coordinate for each row."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

Label = tuple[int, int]  # number of a node, 1 to 6; 0 for a scalar point
_OF_DMIG = {"K": ("KAAX", "KAA"), "M": ("MAAX", "MAA"), "C": ("BAAX", "BAA")}
_OF_ABAQUS = {"STIFFNESS": "K", "MASS": "M", "VISCOUS DAMPING": "C"}
_BARE_EXPONENT = re.compile(r"(?<=[0-9.])([+-]\d+)$")
_WHOLE = re.compile(r"[*\s,\d-]+")
MOST_ROWS = 5000
_SYMMETRIC, _SQUARE = 6, 1
_REAL = (1, 2)  # single, double


class Labelled(NamedTuple):
    """Matrices by K, M and C, with the label of each row."""

    rows: tuple[Label, ...]
    matrices: dict[str, Array]
    places: dict[int, tuple[float, float, float]]  # of nodes that the file has


def number(text: str) -> float:
    """Return a number as Fortran or Nastran write it.

    Examples
    --------
    >>> number(" 1.25D+03"), number("-2.5+3"), number("7.")
    (1250.0, -2500.0, 7.0)
    """
    return float(_BARE_EXPONENT.sub(r"e\1", text.strip().upper().replace("D", "E")))


def check_rows(count: int) -> None:
    """Raise ParameterError where a matrix is too large to be a reduced one.

    Examples
    --------
    >>> check_rows(120)
    """
    if not 1 <= count <= MOST_ROWS:
        raise ParameterError(
            f"matrices must have 1 to {MOST_ROWS} rows, got {count}. Reduce the model to the nodes "
            "that carry something."
        )


def _cards(text: str) -> Iterator[list[str]]:
    """Yield the cards of Nastran: the name and fields of a line with its continuations."""
    card: list[str] = []
    for line in text.splitlines():
        line = line.partition("$")[0].rstrip().expandtabs(8)
        if not line:
            continue
        head, *fields = line.split(",") if "," in line else [line[:8]]
        if "," not in line:
            width = 16 if "*" in head else 8
            fields = [line[8 + i : 8 + i + width] for i in range(0, 64, width)]
        elif len(fields) < 8:
            fields += [""] * (8 - len(fields))
        head = head.strip().upper().rstrip("*")
        if head and not head.startswith("+"):
            if card:
                yield card
            card = [head]
        elif not card:
            continue
        card += [one.strip().upper() for one in fields[:8]]
    if card:
        yield card


def read_dmig(text: str) -> Labelled:
    """Return the matrices KAAX, MAAX and BAAX of a punch file of Nastran or OptiStruct.

    Parameters
    ----------
    text : str
        DMIG entries of form 6, symmetric, or 1, square; in small, large or free fields. GRID
        entries in the basic system give places.

    Raises
    ------
    ParameterError
        A matrix is complex or rectangular, or a field is no number.

    Examples
    --------
    >>> punch = '''
    ... DMIG    KAAX           0       6       2       0                       1
    ... DMIG*   KAAX                           7               1
    ... *                      7               1 4.000000000D+06
    ... '''
    >>> found = read_dmig(punch)
    >>> found.rows, float(found.matrices["K"][0, 0])
    (((7, 1),), 4000000.0)
    """
    named = {name: kind for kind, names in _OF_DMIG.items() for name in names}
    entries: dict[str, dict[tuple[Label, Label], float]] = {}
    forms: dict[str, int] = {}
    places = {}
    for card in _cards(text):
        try:
            if card[0] == "GRID":
                if card[2] not in ("", "0") or card[6] not in ("", "0"):
                    raise ParameterError(
                        f"GRID {card[1]} must stand in the basic system, got systems "
                        f"{card[2] or 0} and {card[6] or 0}. Give a node table, and matrices in "
                        "the basic system."
                    )
                x, y, z = (number(one or "0") for one in card[3:6])
                places[int(card[1])] = x, y, z
            if card[0] != "DMIG" or card[1] not in named:
                continue
            kind = named[card[1]]
            if card[2] == "0":
                forms[kind] = int(card[3])
                if forms[kind] not in (_SYMMETRIC, _SQUARE) or int(card[4] or 1) not in _REAL:
                    raise ParameterError(
                        f"{card[1]} must be real and symmetric (form 6) or square (form 1), got "
                        f"form {card[3]} and type {card[4]}."
                    )
                continue
            column = int(card[2]), int(card[3] or 0)
            for i in range(5, len(card) - 2, 4):
                if card[i]:
                    row = int(card[i]), int(card[i + 1] or 0)
                    entries.setdefault(kind, {})[row, column] = number(card[i + 2])
        except ParameterError:
            raise
        except (ValueError, IndexError):
            raise ParameterError(
                f"the Nastran entry {', '.join(card[:9])} must have numbers in its fields of 8 or "
                "16 characters, or between commas."
            ) from None
    rows = tuple(sorted({label for own in entries.values() for pair in own for label in pair}))
    check_rows(len(rows))
    at = {label: i for i, label in enumerate(rows)}
    matrices = {}
    for kind, own in entries.items():
        matrices[kind] = np.zeros((len(rows), len(rows)))
        for (row, column), value in own.items():
            matrices[kind][at[row], at[column]] = value
            if forms.get(kind, _SYMMETRIC) == _SYMMETRIC:
                matrices[kind][at[column], at[row]] = value
    return Labelled(rows, matrices, places)


def read_abaqus(text: str) -> Labelled:
    """Return the matrices of a substructure in the form of *USER ELEMENT, LINEAR.

    Parameters
    ----------
    text : str
        As *SUBSTRUCTURE MATRIX OUTPUT, OUTPUT FILE=USER DEFINED writes it: nodes in a comment,
        their active coordinates, lower triangles by rows.

    Raises
    ------
    ParameterError
        Nodes are not listed, or a triangle has too few or too many numbers.

    Examples
    --------
    >>> found = read_abaqus('''
    ... *USER ELEMENT, NODES= 1, LINEAR
    ... ** ELEMENT NODES
    ... ** 101
    ... 1, 2
    ... *MATRIX,TYPE=STIFFNESS
    ... 4.0,
    ... -1.0, 5.0
    ... ''')
    >>> found.rows, found.matrices["K"].tolist()
    (((101, 1), (101, 2)), [[4.0, -1.0], [-1.0, 5.0]])
    """
    nodes: list[int] = []
    active: list[list[int]] = []
    triangles: dict[str, list[float]] = {}
    numbers: list[float] | None = None
    part = ""
    for line in text.splitlines():
        words = line.strip()
        try:
            if words.startswith("**"):
                if "ELEMENT NODES" in words.upper():
                    part = "nodes"
                elif part == "nodes" and _WHOLE.fullmatch(words):
                    nodes += [int(one) for one in _split(words.strip("* "))]
            elif words.startswith("*"):
                key, *options = words.upper().replace(" ", "").split(",")
                part = key
                kinds = [one.removeprefix("TYPE=") for one in options if one.startswith("TYPE=")]
                if key == "*MATRIX" and kinds:
                    known = {name.replace(" ", ""): kind for name, kind in _OF_ABAQUS.items()}
                    numbers = triangles.setdefault(known.get(kinds[0], kinds[0]), [])
            elif part == "*MATRIX" and numbers is not None:
                numbers += [number(one) for one in _split(words)]
            elif part in ("nodes", "*USERELEMENT") and words:
                active.append([int(one) for one in _split(words)])
        except ValueError:
            raise ParameterError(
                f"the Abaqus line {words[:80]!r} must have numbers between commas."
            ) from None
    if not nodes or not active:
        raise ParameterError(
            "an Abaqus matrix file must list its nodes in a comment behind ** ELEMENT NODES, and "
            "their coordinates, got none. Write it with OUTPUT FILE=USER DEFINED."
        )
    # coordinates of the first node, then changes: position of a node, its coordinates
    changes = {0: active[0]} | {one[0] - 1: one[1:] for one in active[1:]}
    rows: list[Label] = []
    own: Sequence[int] = ()
    for i, node in enumerate(nodes):
        own = changes.get(i, own)
        rows += [(node, direction) for direction in own]
    check_rows(len(rows))
    n, matrices = len(rows), {}
    for kind, values in triangles.items():
        if len(values) != n * (n + 1) // 2:
            raise ParameterError(
                f"a symmetric matrix of {n} rows must have {n * (n + 1) // 2} numbers in its "
                f"triangle, got {len(values)}."
            )
        matrix = np.zeros((n, n))
        matrix[np.tril_indices(n)] = values
        matrices[kind] = matrix + np.tril(matrix, -1).T
    return Labelled(tuple(rows), matrices, {})


def _split(words: str) -> list[str]:
    return [one for one in re.split(r"[,\s]+", words) if one]
