"""The places where a source file can be changed, and one change for each of them.

Changed are operators (+ and -, * and /, ** and *), signs, comparisons (turned into their opposite),
`and` and `or`, numbers (a tenth more; whole numbers and exponents one more), indices (one less),
pairs of functions (sin and cos, min and max), and sums and products lose a term.

Left alone are texts, annotations, decorators, limits of inputs and what makes an error: these are
the matter of tests of inputs. Of the texts of `gearlube` the numbers in them are changed: they are
its results. A comparison does not become one that differs at equality only, because of floats
nearly all such changes are without effect.
"""

from __future__ import annotations

import ast
import copy
import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass

_OPERATORS: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Pow: ast.Mult,
    ast.FloorDiv: ast.Div,
    ast.Mod: ast.Mult,
}
_OPPOSITES: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.GtE,
    ast.LtE: ast.Gt,
    ast.Gt: ast.LtE,
    ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
_PAIRS = (("sin", "cos"), ("min", "max"), ("minimum", "maximum"), ("argmin", "argmax"))
_PAIRS += (("floor", "ceil"), ("zeros", "ones"), ("any", "all"), ("sinh", "cosh"))
_TWINS = dict(_PAIRS) | {after: before for before, after in _PAIRS}
_NOT_PHYSICS = re.compile(r"check_\w+|within\w*|Field|warn\w*|\w*Error|\w*Warning|TypeVar|print")
_INDEX = re.compile(r"[a-z]{1,2}|index|row|column|node|cell|last|first|here")


@dataclass(frozen=True, slots=True)
class Mutant:
    """One change of one file."""

    key: str  # of what is changed and how, not of its line: it outlives changes around it
    file: str
    line: int
    scope: str  # function or class around it, with dots
    before: str
    after: str
    start: int  # of the changed text in the file's bytes
    end: int

    def applied(self, source: bytes) -> bytes:
        """Return the file's content with the change."""
        return source[: self.start] + f"({self.after})".encode() + source[self.end :]


def mutants_of(file: str, source: bytes, seed: int) -> list[Mutant]:
    """Return one mutant for each place in a file; the seed picks where there are several."""
    lines = [0]
    for line in source.splitlines(keepends=True):
        lines.append(lines[-1] + len(line))
    found: list[Mutant] = []
    seen: dict[str, int] = {}
    texts = file.startswith("gearlube/")
    for scope, node in _places(ast.parse(source), "", texts):
        before = ast.unparse(node)
        number = seen[place] = seen.get(place := f"{file} {scope} {before}", -1) + 1
        changes = [(_key(seed, place, number, after), after) for after in _changes(node)]
        if not changes:
            continue
        key, after = min(changes)
        start = lines[node.lineno - 1] + node.col_offset
        end = lines[(node.end_lineno or 0) - 1] + (node.end_col_offset or 0)
        if texts and not _reads(source[start:end], before):
            continue  # before Python 3.12 places in texts of several lines are wrong
        found.append(Mutant(key, file, node.lineno, scope, before, after, start, end))
    return found


def _key(*parts: object) -> str:
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:12]


def _reads(source: bytes, text: str) -> bool:
    try:
        return ast.unparse(ast.parse(b"(" + source + b")", mode="eval")) == text
    except SyntaxError:
        return False


def _places(node: ast.AST, scope: str, texts: bool) -> Iterator[tuple[str, ast.expr]]:
    """Yield expressions with the scope they stand in, outer ones first."""
    if isinstance(node, ast.expr):
        yield scope, node
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        scope = f"{scope}.{node.name}".lstrip(".")
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list", "type_params"):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not _is_left_alone(child, texts):
                yield from _places(child, scope, texts)


def _is_left_alone(node: ast.AST, texts: bool) -> bool:
    if isinstance(node, ast.Call):
        name = getattr(node.func, "id", getattr(node.func, "attr", ""))
        return bool(_NOT_PHYSICS.fullmatch(name))
    if isinstance(node, ast.If):
        return "TYPE_CHECKING" in ast.unparse(node.test)
    if isinstance(node, ast.Subscript):  # a type
        return getattr(node.value, "id", "") in ("Annotated", "Literal", "Callable", "NDArray")
    if isinstance(node, ast.JoinedStr):
        return not texts
    return isinstance(node, (ast.Raise, ast.Assert, ast.Import, ast.ImportFrom))


def _changes(node: ast.expr) -> list[str]:
    return [ast.unparse(changed) for changed in _changed(node)]


def _changed(node: ast.expr) -> Iterator[ast.expr]:
    if isinstance(node, ast.BinOp) and not _holds_text(node):
        yield from _of_operation(node)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.Not)):
        if not isinstance(node.operand, ast.Constant):
            yield node.operand
    elif isinstance(node, ast.Compare) and type(node.ops[0]) in _OPPOSITES:
        opposite = _OPPOSITES[type(node.ops[0])]()
        yield ast.Compare(node.left, [opposite, *node.ops[1:]], node.comparators)
    elif isinstance(node, ast.BoolOp):
        yield ast.BoolOp(ast.Or() if isinstance(node.op, ast.And) else ast.And(), node.values)
    elif isinstance(node, ast.Constant):
        yield from _of_number(node.value)
    elif isinstance(node, ast.Subscript):
        yield from _of_index(node)
    elif isinstance(node, ast.Call):
        yield from _of_call(node)


def _of_operation(node: ast.BinOp) -> Iterator[ast.expr]:
    if type(node.op) in _OPERATORS:
        yield ast.BinOp(node.left, _OPERATORS[type(node.op)](), node.right)
    if isinstance(node.op, (ast.Add, ast.Sub, ast.Mult, ast.Div)):
        yield node.left
    if isinstance(node.op, (ast.Add, ast.Mult)):
        yield node.right


def _holds_text(node: ast.BinOp) -> bool:
    sides = (node.left, node.right)
    return any(
        isinstance(side, ast.JoinedStr)
        or (isinstance(side, ast.Constant) and not isinstance(side.value, (int, float)))
        for side in sides
    )


def _of_number(value: object) -> Iterator[ast.expr]:
    if isinstance(value, bool):
        yield ast.Constant(not value)
    elif isinstance(value, int):
        yield ast.Constant(value + 1)
    elif isinstance(value, float):
        yield ast.Constant(float(f"{1.1 * value:.12g}") if value else 1.0)


def _of_index(node: ast.Subscript) -> Iterator[ast.expr]:
    parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
    for place, part in enumerate(parts):
        if isinstance(part, ast.Name) and _INDEX.fullmatch(part.id):
            less = ast.BinOp(part, ast.Sub(), ast.Constant(1))
            changed = copy.copy(node)
            changed.slice = less
            if isinstance(node.slice, ast.Tuple):
                elements = [*parts[:place], less, *parts[place + 1 :]]
                changed.slice = ast.Tuple(elements, ast.Load())
            yield changed


def _of_call(node: ast.Call) -> Iterator[ast.expr]:
    called = copy.copy(node.func)
    if isinstance(called, ast.Name) and called.id in _TWINS:
        called.id = _TWINS[called.id]
    elif isinstance(called, ast.Attribute) and called.attr in _TWINS:
        called.attr = _TWINS[called.attr]
    else:
        return
    yield ast.Call(called, node.args, node.keywords)
