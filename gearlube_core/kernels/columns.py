"""Columns of a matrix times vectors, many at once in the registers of a processor."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np import arrayobj

_ANY_ORDER = ("reassoc", "contract")


def _add_columns(
    typingctx: Any, matrix: Any, vectors: Any, outs: Any, first: Any, count: Any
) -> Any:
    """Add so many columns of a matrix, row by row, times each of some vectors to each of `outs`.

    Matrix and vectors may be of single precision; then so are the sums. `count` is a constant.
    """
    if not isinstance(count, types.IntegerLiteral):
        return None
    number = ir.FloatType() if matrix.dtype == types.float32 else ir.DoubleType()
    lanes = ir.VectorType(number, count.literal_value)
    doubles = ir.VectorType(ir.DoubleType(), count.literal_value)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        start = arrayobj.make_array(signature.args[0])(context, builder, arguments[0]).data
        xs, sums = (
            [
                arrayobj.make_array(signature.args[k].dtype)(context, builder, one)
                for one in cgutils.unpack_tuple(builder, arguments[k])
            ]
            for k in (1, 2)
        )
        at = context.cast(builder, arguments[3], signature.args[3], types.intp)
        rows, stride = (builder.extract_value(one[0].shape, 0) for one in (xs, sums))
        # a sum of even rows and one of odd rows: none waits for the other
        totals = [[cgutils.alloca_once(builder, lanes) for _ in range(2)] for _ in xs]
        for total in (one for pair in totals for one in pair):
            builder.store(ir.Constant(lanes, None), total)

        def lanes_at(data: Any, at: Any, kind: Any) -> Any:
            return builder.bitcast(builder.gep(data, [at], inbounds=True), kind.as_pointer())

        def add_row(i: Any, parity: int) -> None:
            place = lanes_at(start, builder.add(at, builder.mul(i, stride)), lanes)
            row = builder.load(place, align=number.get_abi_size(context.target_data))
            for x, pair in zip(xs, totals, strict=True):
                factor = builder.load(builder.gep(x.data, [i], inbounds=True))
                one = builder.insert_element(
                    ir.Constant(lanes, ir.Undefined), factor, ir.IntType(32)(0)
                )
                chosen = ir.Constant(ir.VectorType(ir.IntType(32), lanes.count), None)
                same = builder.shuffle_vector(one, one, chosen)
                product = builder.fmul(row, same, flags=_ANY_ORDER)
                total = builder.fadd(builder.load(pair[parity]), product, flags=_ANY_ORDER)
                builder.store(total, pair[parity])

        one = rows.type(1)
        with cgutils.for_range(builder, builder.lshr(rows, one)) as loop:
            even = builder.shl(loop.index, one)
            add_row(even, 0)
            add_row(builder.add(even, one), 1)
        with builder.if_then(builder.trunc(rows, ir.IntType(1))):
            add_row(builder.sub(rows, one), 0)
        for out, (even, odd) in zip(sums, totals, strict=True):
            total = builder.fadd(builder.load(even), builder.load(odd), flags=_ANY_ORDER)
            if number != ir.DoubleType():
                total = builder.fpext(total, doubles)
            place = lanes_at(out.data, at, doubles)
            builder.store(builder.fadd(builder.load(place, align=8), total), place, align=8)
        return context.get_dummy_value()

    return types.none(matrix, vectors, outs, first, count), generate


add_columns: Any = intrinsic(prefer_literal=True)(_add_columns)
