"""The tangent of a native model: its entry along a direction, made from the same kernels.

Forward differentiation of LLVM's code. Every number gets a second one, its change along the
direction, and every pointer a second one, to the changes of what it points to. What cannot depend
on the direction, such as the data of the model, gets none. Branches follow the numbers. Whatever is
not known to keep both together is refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import count
from typing import NamedTuple

from fmu_src.native.model import Operation
from fmu_src.native.slopes import FLAT, SLOPES, Code
from fmu_src.object_code import linked, specialised
from gearlube_core.errors import GearLubeError

TANGENT = "gearlube_tangent"
_POINTERS = ("data", "parameters", "inputs", "state", "work", "outputs")
_CHANGED = ("state", "work", "outputs")  # their changes are the last arguments of the tangent
# each operation as a constant, so that no other kernels are in the tangent
_BOTH = """
define hidden i64 @{tangent}(i64 %operation, double %step, {pointers}) {{
  %rates = icmp eq i64 %operation, {rates}
  br i1 %rates, label %of_rates, label %of_outputs
of_rates:
  %first = call i64 @{entry}(i64 {rates}, double %step, {pointers})
  ret i64 %first
of_outputs:
  %second = call i64 @{entry}(i64 {outputs}, double %step, {pointers})
  ret i64 %second
}}
"""
_ZERO = "zeroinitializer"  # of any type
_NAME = r'(?:"[^"]*"|[-\w$.]+)'
_LOCAL = re.compile(f"%{_NAME}")
_KIND = r"(double|ptr|<\d+ x (?:double|ptr)>)(?=[ ,]|$)"  # types whose values have changes
_OPERAND = re.compile(rf"{_KIND} (?:.*? )??((?:getelementptr|splat) .*|<.*>|\S+)$")
_RESULT = re.compile(f"(%{_NAME}) = (.*)")
_FLAGS = "(?:(?:nnan|ninf|nsz|arcp|contract|afn|reassoc|fast) )*"
_CALL = re.compile(rf"(?:tail |musttail |notail )?call .*?@({_NAME})\((.*)\)")
_DEFINE = re.compile(rf"define (.*?)@({_NAME})\((.*)\)[^()]*\{{")
_METADATA = re.compile(r",? ![-\w.]+(?: !\d+)?(?=,|$)|(?<=\)) #\d+$")
_EQUAL = re.compile(rf"fcmp {_FLAGS}(oeq|ueq|one|une) {_KIND} %.*, %")
_ELEMENTS = ("select", "freeze", "insertelement", "extractelement", "shufflevector")
# functions whose changes are the same of changes
_LINEAR = ("llvm.masked.", "llvm.vector.reduce.fadd.")
# what makes no numbers that have changes, whatever it is made of
_WHOLE = ("icmp", "fcmp", "fptosi", "fptoui", "ptrtoint", "br", "ret", "switch", "store")
_WHOLE_LOAD = re.compile(r"load (i\d+|<\d+ x i\d+>),")
# numbers and pointers made of bits; results of functions
_HIDDEN = re.compile(r"inttoptr|bitcast .* to .*double|(extract|insert)value .*(double|ptr)")
_RETURNS = re.compile(r"\b(double|ptr)\b|[{<]")


def with_tangent(code: str, entry: str) -> str:
    """Return the code of a native model with its tangent, a second symbol.

    Parameters
    ----------
    code : str
        From `intermediate_code`.
    entry : str
        Its symbol. The tangent takes the same arguments and then the changes of state, work and
        outputs. It knows the operations OUTPUTS and DERIVATIVES.

    Raises
    ------
    GearLubeError
        The kernels call a function, or do something else, whose slope is not known.
    """
    both = _BOTH.format(
        tangent=TANGENT,
        entry=entry,
        pointers=", ".join(f"ptr %{name}" for name in _POINTERS),
        rates=int(Operation.DERIVATIVES),
        outputs=int(Operation.OUTPUTS),
    )
    return linked(code, _Module(specialised(code + both, TANGENT)).tangent())


class _Line(NamedTuple):
    text: str  # without metadata
    result: str  # name of its value, or ""
    body: str  # behind that
    operation: str
    function: str  # that it calls, or ""
    operands: tuple[str, ...]  # with types; only of what needs them
    names: tuple[str, ...]  # values of the function in the body

    @classmethod
    def of(cls, text: str) -> _Line:
        text = _METADATA.sub("", text.split(" ;")[0])
        found = _RESULT.match(text.strip())
        result, body = found.groups() if found else ("", text.strip())
        operation, _, rest = body.partition(" ")
        call = _CALL.match(body)
        function, given = call.groups() if call else ("", re.sub(f"^{_FLAGS}", "", rest))
        operation = "call" if call else operation
        names = tuple(_LOCAL.findall(body))
        return cls(text, result, body, operation, function, tuple(_split(given)), names)

    @property
    def kind(self) -> str:
        """Type of the result if its values have changes, else ""; of a comparison, of its sides."""
        if self.operation in ("getelementptr", "alloca"):
            return "ptr"
        if self.operation == "extractelement":
            return self.operands[0].split(" ")[2].rstrip(">")
        found = re.search(_KIND, self.body.partition("," if self.operation == "load" else "@")[0])
        return found[1] if found else ""

    @property
    def mathematics(self) -> str:
        """Name of what is computed, as in C: `llvm.exp.f64` -> `exp`."""
        return self.function.removeprefix("llvm.").split(".")[0] or self.operation


def _split(text: str) -> list[str]:
    """Return the parts of a list between its outer commas."""
    parts, depth, begin = [], 0, 0
    for place, letter in enumerate(text):
        depth += (letter in "([{<") - (letter in ")]}>")
        if letter == "," and depth == 0:
            parts.append(text[begin:place].strip())
            begin = place + 1
    return [*parts, text[begin:].strip()] if text.strip() else []


def _change(name: str, word: str = "change") -> str:
    """Return the name of the change of a value."""
    return f'%"{word} {name[1:].strip(chr(34))}"'


def _typed(operand: str) -> tuple[str, str]:
    """Return the type and the value of an operand."""
    found = _OPERAND.match(operand)
    if found is None:
        raise _unknown(operand)
    return found[1], found[2]


def _unknown(text: str) -> GearLubeError:
    return GearLubeError(
        f"The derivatives of a native FMU need the slopes of all that its kernels do, got: "
        f"{text.strip()}. In a law of your own use functions such as exp, log, sqrt and tanh."
    )


@dataclass
class _Function:
    head: str
    parameters: list[str]
    lines: list[_Line]
    moving: set[str] = field(default_factory=set)  # values that have changes
    bits: set[str] = field(default_factory=set)  # whole numbers made of pointers

    @property
    def names(self) -> list[str]:
        """Names of the parameters."""
        return [_LOCAL.findall(parameter)[-1] for parameter in self.parameters]

    @property
    def places(self) -> list[int]:
        """Places of the parameters that have changes."""
        return [i for i, name in enumerate(self.names) if name in self.moving]

    @property
    def loaded(self) -> set[str]:
        """Numbers whose bits may be those of others."""
        return {line.result for line in self.lines if line.operation in ("load", "bitcast")}

    def moves(self, line: _Line) -> bool:
        """Whether the value of a line has a change."""
        if line.operation == "alloca":
            return True
        if _HIDDEN.match(line.body):
            raise _unknown(line.text)
        if not line.result or line.operation in _WHOLE or line.mathematics in FLAT:
            return False
        if self.moving.isdisjoint(line.names) or _WHOLE_LOAD.match(line.body):
            return False
        if not line.kind and line.operation != "call":
            raise _unknown(line.text)
        return bool(line.kind)

    def follow_bits(self, line: _Line) -> None:
        """Note a number made of addresses, which may only be compared: changes have others."""
        if line.operation == "ptrtoint" or not self.bits.isdisjoint(line.names):
            if line.operation in ("getelementptr", "store", "call"):
                raise _unknown(line.text)
            if line.operation != "icmp":
                self.bits.add(line.result)

    def change_of(self, operand: str) -> str:
        """Return the change of an operand with its type: zero if it does not move."""
        kind, value = _typed(operand)
        names = _LOCAL.findall(value)
        if names and names[-1] in self.moving:
            return _change(names[-1])
        if "ptr" in kind and value not in ("null", "poison"):
            raise _unknown(operand)
        return _ZERO

    def renamed(self, found: re.Match[str]) -> str:
        """Return the name of the change of what is found, or its own if it does not move."""
        return _change(found[0]) if found[0] in self.moving else found[0]

    def typed_change(self, operand: str) -> str:
        """Return the same with its type; an operand of another type as it is."""
        found = re.match(_KIND, operand)
        return f"{found[1]} {self.change_of(operand)}" if found else operand


class _Module:
    def __init__(self, code: str) -> None:
        self.others: list[str] = []
        self.declarations: dict[str, str] = {}
        self.functions: dict[str, _Function] = {}
        self.numbers = count()
        lines = iter(code.splitlines())
        for line in lines:
            found = _DEFINE.match(line)
            if found:
                if _RETURNS.search(found[1]):
                    raise _unknown(line)
                body = [_Line.of(one) for one in iter(lines.__next__, "}")]
                self.functions[found[2]] = _Function(found[1], _split(found[3]), body)
            elif line.startswith("declare"):
                self.declare(line)
            elif line.startswith(("target", "@", "%")):
                self.others.append(line)

    def declare(self, line: str) -> None:
        name = line.partition("@")[2].partition("(")[0]
        self.declarations.setdefault(name, re.sub(r" #\d+$", "", line))

    def tangent(self) -> str:
        """Return the code of the tangent."""
        self.functions[TANGENT].moving.update(f"%{name}" for name in _CHANGED)
        before, now = -1, 0
        while now > before:
            before = now
            now = sum(map(self._mark, self.functions.values()))
        bodies = [line for name, one in self.functions.items() for line in self._define(name, one)]
        return "\n".join([*self.others, *self.declarations.values(), *bodies, ""])

    def _mark(self, function: _Function) -> int:
        """Find what moves in a function, and what it hands to others; return how much that is."""
        for line in function.lines:
            function.follow_bits(line)
            inner = self.functions.get(line.function)
            if inner:
                for name, given in zip(inner.names, line.operands, strict=True):
                    if given.split(" ")[-1] in function.moving:
                        inner.moving.add(name)
            elif function.moves(line):
                function.moving.add(line.result)
        return len(function.moving) + len(function.bits)

    def _define(self, name: str, function: _Function) -> Iterator[str]:
        given = list(function.parameters)
        given += [function.typed_change(given[i]) for i in function.places]
        yield f"define {function.head}@{name}({', '.join(given)}) {{"
        for line in function.lines:
            inner = self.functions.get(line.function)
            if inner:
                given = [*line.operands]
                given += [function.typed_change(given[i]) for i in inner.places]
                yield f"{line.text.partition('@')[0]}@{line.function}({', '.join(given)})"
            elif _EQUAL.match(line.body) and function.moving.issuperset(line.names):
                yield from _same(line)
            else:
                yield line.text
                if line.result in function.moving:
                    yield from self._changed(function, line)
                elif not function.moving.isdisjoint(line.names):
                    yield from self._written(function, line)
        yield "}"

    def _changed(self, function: _Function, line: _Line) -> Iterator[str]:
        """Give the lines that compute the change of a line's value."""
        new = _change(line.result)
        if line.mathematics in SLOPES:
            yield from self._computed(function, line)
        elif line.operation == "phi":
            pairs = [
                f"[ {function.change_of(f'{line.kind} {value}')}, {origin} ]"
                for value, origin in re.findall(rf"\[ (.+?), (%{_NAME}) \]", line.body)
            ]
            yield f"{new} = phi {line.kind} {', '.join(pairs)}"
        elif line.operation in _ELEMENTS:
            given = map(function.typed_change, line.operands)
            yield f"{new} = {line.operation} {', '.join(given)}"
        elif line.function.startswith(_LINEAR):
            given = map(function.typed_change, line.operands)
            yield f"{new} = call {line.kind} @{line.function}({', '.join(given)})"
        elif line.operation in ("load", "getelementptr", "alloca"):
            yield f"{new} = {_LOCAL.sub(function.renamed, line.body)}"
        else:
            raise _unknown(line.text)

    def _computed(self, function: _Function, line: _Line) -> Iterator[str]:
        """Give the lines of the sum of slopes times changes."""
        given = [one if re.match(_KIND, one) else f"{line.kind} {one}" for one in line.operands]
        values = {name: _typed(one)[1] for name, one in zip("xy", given, strict=False)}
        code, total = Code(line.kind, self.numbers), ""
        for slope, operand in zip(SLOPES[line.mathematics], given, strict=True):
            change = function.change_of(operand)
            if change == _ZERO:
                continue
            term = code.formula(f"d * ({slope})", d=change, r=line.result, **values)
            if line.function:  # what does not change stays so where the slope is infinite
                term = code.formula("0 if d == 0 else t", d=change, t=term)
            total = code.formula("a + b", a=total, b=term) if total else term
        for declaration in sorted(code.declarations):
            self.declare(declaration)
        *lines, last = code.lines
        yield from lines
        yield f"{_change(line.result)} = {last.partition(' = ')[2]}"

    def _written(self, function: _Function, line: _Line) -> Iterator[str]:
        """Give the lines that write the changes of what a line writes."""
        if line.operation == "store":
            value, place, alignment = line.operands
            if re.match(_KIND, value):
                changes = function.typed_change(value), function.typed_change(place)
                yield f"store {', '.join(changes)}, {alignment}"
            elif not function.loaded.isdisjoint(_LOCAL.findall(value)):
                raise _unknown(line.text)
        elif line.function.startswith(("llvm.lifetime", *_LINEAR)):
            given = map(function.typed_change, line.operands)
            yield f"call void @{line.function}({', '.join(given)})"
        elif line.mathematics in ("memset", "memcpy", "memmove"):
            to, source, size, volatile = line.operands
            copied = source.split(" ")[-1] in function.moving
            called = line.function if copied else "llvm.memset.p0.i64"
            source = function.typed_change(source) if copied else "i8 0"
            self.declare("declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)")
            yield f"call void @{called}({function.typed_change(to)}, {source}, {size}, {volatile})"
        elif line.operation not in (*_WHOLE, "load") and line.mathematics not in (*FLAT, "is"):
            raise _unknown(line.text)


def _same(line: _Line) -> Iterator[str]:
    """Give the lines of a test whether two numbers are equal: here their changes must be too.

    So what is kept for a number, until another one comes, is renewed for another direction too.
    """
    numbers, changes = _change(line.result, "same"), _change(line.result, "same change")
    sides = _LOCAL.sub(lambda found: _change(found[0]), line.body)
    joined = "and" if re.match(f"fcmp {_FLAGS}.eq", line.body) else "or"
    yield f"{numbers} = {line.body}"
    yield f"{changes} = {sides}"
    yield f"{line.result} = {joined} {line.kind.replace('double', 'i1')} {numbers}, {changes}"
