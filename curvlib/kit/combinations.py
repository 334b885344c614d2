"""Linear combinations of rows, as in `lanes`."""

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types

from .lanes import LANES, VECTOR, _every, _load, _matrix, _store, in_lanes


def combine(rows, i, number, first, count, factors):
    """Set rows[i + f] to the sum of factors[j, f] rows[first + j], j < count, for f < number.

    Parameters
    ----------
    number : int literal
        Of rows that are set, at most LANES.
    factors : (count or more, LANES)
    """
    for f in range(number):
        total = np.zeros(rows.shape[1])
        for j in range(count):
            total = total + factors[j, f] * rows[first + j]
        rows[i + f] = total


def substitute(rows, i, count, factors):
    """Subtract the sum of factors[j] rows[i + 1 + j], j < count, from rows[i].

    Parameters
    ----------
    factors : (count or more,)
    """
    whole, s = count // 4 * 4, np.zeros((4, rows.shape[1]))
    for j in range(count):
        s[j % 4 if j < whole else 0] += factors[j] * rows[i + 1 + j]
    rows[i] -= (s[0] + s[1]) + (s[2] + s[3])


def _combined(rows, i, number, first, count, factors):
    if isinstance(number, types.IntegerLiteral):
        return types.void(rows, types.intp, number, types.intp, types.intp, factors)
    return None


@in_lanes(combine, _combined)
def _(context, builder, signature, arguments):
    row, blocks = _matrix(context, builder, signature.args[0], arguments[0])
    _, i, _, first, count, _ = arguments
    outputs = signature.args[2].literal_value
    factor = context.make_array(signature.args[5])(context, builder, arguments[5]).data
    totals = [cgutils.alloca_once(builder, VECTOR) for _ in range(outputs)]
    with cgutils.for_range(builder, blocks) as block:
        for total in totals:
            builder.store(ir.Constant(VECTOR, [0.0] * LANES), total)
        with cgutils.for_range(builder, count) as loop:
            value = _load(builder, row(builder.add(first, loop.index)), block.index)
            place = builder.mul(loop.index, loop.index.type(LANES))
            for f, total in enumerate(totals):
                at = builder.gep(factor, [builder.add(place, place.type(f))])
                product = builder.fmul(_every(builder, builder.load(at)), value)
                builder.store(builder.fadd(builder.load(total), product), total)
        for f, total in enumerate(totals):
            _store(builder, builder.load(total), row(builder.add(i, i.type(f))), block.index)
    return context.get_dummy_value()


def _substituted(rows, i, count, factors):
    return types.void(rows, types.intp, types.intp, factors)


@in_lanes(substitute, _substituted)
def _(context, builder, signature, arguments):
    row, blocks = _matrix(context, builder, signature.args[0], arguments[0])
    _, i, count, _ = arguments
    factor = context.make_array(signature.args[3])(context, builder, arguments[3]).data
    totals = [cgutils.alloca_once(builder, VECTOR) for _ in range(4)]
    whole = builder.mul(builder.udiv(count, count.type(4)), count.type(4))

    def add(j, block, total):
        x = _every(builder, builder.load(builder.gep(factor, [j])))
        below = row(builder.add(builder.add(i, i.type(1)), j))
        product = builder.fmul(x, _load(builder, below, block))
        builder.store(builder.fadd(builder.load(total), product), total)

    with cgutils.for_range(builder, blocks) as block:
        for total in totals:
            builder.store(ir.Constant(VECTOR, [0.0] * LANES), total)
        with cgutils.for_range_slice(builder, count.type(0), whole, count.type(4)) as (j, _):
            for f, total in enumerate(totals):
                add(builder.add(j, j.type(f)), block.index, total)
        with cgutils.for_range_slice(builder, whole, count, count.type(1)) as (j, _):
            add(j, block.index, totals[0])
        a, b, c, d = map(builder.load, totals)
        s = builder.fadd(builder.fadd(a, b), builder.fadd(c, d))
        value = builder.fsub(_load(builder, row(i), block.index), s)
        _store(builder, value, row(i), block.index)
    return context.get_dummy_value()
