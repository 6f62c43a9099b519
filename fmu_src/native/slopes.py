"""Slopes of what kernels compute, as formulas, and their translation into LLVM's code."""

from __future__ import annotations

import ast
import math
import struct
from collections.abc import Mapping
from itertools import count

# slope of r = f(x), or slopes of r = f(x, y) by x and y
SLOPES: Mapping[str, tuple[str, ...]] = {
    "fadd": ("1", "1"),
    "fsub": ("1", "-1"),
    "fmul": ("y", "x"),
    "fdiv": ("1 / y", "-r / y"),
    "frem": ("1", "-trunc(x / y)"),
    "fneg": ("-1",),
    "sqrt": ("0.5 / r",),
    "cbrt": ("r / (3 * x)",),
    "exp": ("r",),
    "exp2": (f"{math.log(2.0)!r} * r",),
    "expm1": ("r + 1",),
    "log": ("1 / x",),
    "log2": (f"{1.0 / math.log(2.0)!r} / x",),
    "log10": (f"{1.0 / math.log(10.0)!r} / x",),
    "log1p": ("1 / (1 + x)",),
    "sin": ("cos(x)",),
    "cos": ("-sin(x)",),
    "tan": ("1 + r * r",),
    "asin": ("1 / sqrt(1 - x * x)",),
    "acos": ("-1 / sqrt(1 - x * x)",),
    "atan": ("1 / (1 + x * x)",),
    "atan2": ("y / (x * x + y * y)", "-x / (x * x + y * y)"),
    "sinh": ("cosh(x)",),
    "cosh": ("sinh(x)",),
    "tanh": ("1 - r * r",),
    "asinh": ("1 / sqrt(x * x + 1)",),
    "acosh": ("1 / sqrt(x * x - 1)",),
    "atanh": ("1 / (1 - x * x)",),
    "erf": (f"{2.0 / math.sqrt(math.pi)!r} * exp(-x * x)",),
    "erfc": (f"{-2.0 / math.sqrt(math.pi)!r} * exp(-x * x)",),
    "hypot": ("x / r", "y / r"),
    "pow": ("(1 if y == 1 else 0) if x == 0 else y * r / x", "r * log(x) if x > 0 else 0"),
    "fmod": ("1", "-trunc(x / y)"),
    "fabs": ("0 if x == 0 else copysign(1, x)",),  # the mean of both sides
    "copysign": ("copysign(1, x) * copysign(1, y)", "0"),
    "maxnum": ("1 if x >= y else 0", "0 if x >= y else 1"),
    "minnum": ("1 if x <= y else 0", "0 if x <= y else 1"),
}
# functions whose slope is 0 wherever they have one
FLAT = frozenset({"floor", "ceil", "trunc", "rint", "nearbyint", "round", "roundeven"})
_OPERATIONS = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}
_TESTS = {ast.Eq: "oeq", ast.Gt: "ogt", ast.GtE: "oge", ast.LtE: "ole"}


class Code:
    """Lines of LLVM's code that compute formulas.

    Parameters
    ----------
    kind : str
        Type of all numbers: double or a vector of doubles.
    names : iterator of int
        Numbers for the names of values.
    """

    def __init__(self, kind: str, names: count[int]) -> None:
        self.kind, self._names = kind, names
        self.lines: list[str] = []
        self.declarations: set[str] = set()

    def formula(self, text: str, **values: str) -> str:
        """Return the name of a formula's value; `values` are those of its variables."""
        return self._value(ast.parse(text, mode="eval").body, values)

    def _value(self, node: ast.expr, values: Mapping[str, str]) -> str:
        match node:
            case ast.Name(name):
                return values[name]
            case ast.Constant(int() | float() as number):
                bits = f"0x{struct.pack('>d', number).hex().upper()}"
                return bits if self.kind == "double" else f"splat (double {bits})"
            case ast.UnaryOp(ast.USub(), inner):
                return self._new(f"fneg {self.kind} {self._value(inner, values)}")
            case ast.BinOp(left, operation, right):
                both = f"{self._value(left, values)}, {self._value(right, values)}"
                return self._new(f"{_OPERATIONS[type(operation)]} {self.kind} {both}")
            case ast.IfExp(ast.Compare(left, [test], [right]), yes, no):
                both = f"{self._value(left, values)}, {self._value(right, values)}"
                chosen = self._new(f"fcmp {_TESTS[type(test)]} {self.kind} {both}")
                bits = self.kind.replace("double", "i1")
                typed = [f"{self.kind} {self._value(one, values)}" for one in (yes, no)]
                return self._new(f"select {bits} {chosen}, {', '.join(typed)}")
            case ast.Call(ast.Name(function), arguments):
                typed = [f"{self.kind} {self._value(one, values)}" for one in arguments]
                return self._call(function, typed)
        raise TypeError(f"no formula: {ast.unparse(node)}")

    def _call(self, function: str, typed: list[str]) -> str:
        suffix = "f64" if self.kind == "double" else f"v{self.kind[1:].split()[0]}f64"
        name = f"@llvm.{function}.{suffix}"
        kinds = ", ".join([self.kind] * len(typed))
        self.declarations.add(f"declare {self.kind} {name}({kinds})")
        return self._new(f"call {self.kind} {name}({', '.join(typed)})")

    def _new(self, text: str) -> str:
        name = f'%"slope {next(self._names)}"'
        self.lines.append(f"{name} = {text}")
        return name
