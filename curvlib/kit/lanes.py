"""Rows of a matrix as vectors: explicit lanes, eight numbers wide.

A sum over a row in its written order cannot be vectorised, and one in the order of the machine's
vector registers would have other last bits on another machine. Here a row is read eight numbers at
a time into eight partial sums on every machine.

In all functions `rows` is a C-contiguous array of float64 (m, n), n a multiple of LANES; i, j and k
are rows of it.
"""

import functools

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import lower_builtin, type_callable

LANES = 8
VECTOR = ir.VectorType(ir.DoubleType(), LANES)


def dot(rows, i, j):
    """The sum of rows[i] * rows[j].

    Returns
    -------
    float
        Eight partial sums, added in pairs.
    """
    s = np.add.accumulate((rows[i] * rows[j]).reshape(-1, LANES))[-1] if rows.size else np.zeros(8)
    s = s[:4] + s[4:]
    s = s[:2] + s[2:]
    return s[0] + s[1]


def multiply(rows, i, j, k):
    """Set rows[i] to rows[j] * rows[k]."""
    rows[i] = rows[j] * rows[k]


def project(rows, i, j, a):
    """Set rows[i] to a . e, e being the vectors of which rows[j : j + 3] are the components.

    Parameters
    ----------
    a : tuple of 3 floats
    """
    rows[i] = (a[0] * rows[j] + a[1] * rows[j + 1]) + a[2] * rows[j + 2]


def eliminate(rows, k, factors):
    """Subtract factors[i] rows[k] from rows[i] for each i > k, right of the diagonal.

    Parameters
    ----------
    factors : (m,)
    """
    # In whole blocks, to the left of the diagonal too.
    for i in range(k + 1, len(rows)):
        rows[i, i // LANES * LANES :] -= factors[i] * rows[k, i // LANES * LANES :]


def _matrix(context, builder, kind, value):
    """Pointer to the first vector of a row, as a function of its index; vectors in a row."""
    array = context.make_array(kind)(context, builder, value)
    columns = builder.extract_value(array.shape, 1)
    number = builder.udiv(columns, columns.type(LANES))
    data = builder.bitcast(array.data, VECTOR.as_pointer())
    return lambda i: builder.gep(data, [builder.mul(i, number)]), number


def _load(builder, row, k):
    return builder.load(builder.gep(row, [k]), align=8)


def _store(builder, value, row, k):
    builder.store(value, builder.gep(row, [k]), align=8)


def _every(builder, x):
    """A vector of LANES numbers x."""
    one = builder.insert_element(ir.Constant(VECTOR, ir.Undefined), x, ir.IntType(32)(0))
    mask = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(one, one, mask)


def _is_matrix(kind):
    return isinstance(kind, types.Array) and (kind.ndim, kind.layout) == (2, "C")


def in_lanes(function, signature):
    """Compile calls of a function to LLVM code that the decorated function generates.

    Parameters
    ----------
    function : callable
        Its first parameter is `rows`.
    signature : callable
        From the types of its parameters; None where they do not fit.
    """

    @functools.wraps(signature)
    def typed(rows, *kinds):
        return signature(rows, *kinds) if _is_matrix(rows) else None

    type_callable(function)(lambda context: typed)
    return lower_builtin(function, types.VarArg(types.Any))


@in_lanes(dot, lambda rows, i, j: types.float64(rows, types.intp, types.intp))
def _(context, builder, signature, arguments):
    row, number = _matrix(context, builder, signature.args[0], arguments[0])
    a, b = row(arguments[1]), row(arguments[2])
    total = cgutils.alloca_once_value(builder, ir.Constant(VECTOR, [0.0] * LANES))
    with cgutils.for_range(builder, number) as loop:
        product = builder.fmul(_load(builder, a, loop.index), _load(builder, b, loop.index))
        builder.store(builder.fadd(builder.load(total), product), total)
    s, width = builder.load(total), LANES
    while width > 1:
        width //= 2
        halves = [
            builder.shuffle_vector(s, s, ir.Constant(ir.VectorType(ir.IntType(32), width), part))
            for part in (list(range(width)), list(range(width, 2 * width)))
        ]
        s = builder.fadd(*halves)
    return builder.extract_element(s, ir.IntType(32)(0))


@in_lanes(multiply, lambda rows, i, j, k: types.void(rows, types.intp, types.intp, types.intp))
def _(context, builder, signature, arguments):
    row, number = _matrix(context, builder, signature.args[0], arguments[0])
    out, a, b = map(row, arguments[1:])
    with cgutils.for_range(builder, number) as loop:
        product = builder.fmul(_load(builder, a, loop.index), _load(builder, b, loop.index))
        _store(builder, product, out, loop.index)
    return context.get_dummy_value()


@in_lanes(
    project,
    lambda rows, i, j, a: types.void(
        rows, types.intp, types.intp, types.UniTuple(types.float64, 3)
    ),
)
def _(context, builder, signature, arguments):
    row, number = _matrix(context, builder, signature.args[0], arguments[0])
    out, first = row(arguments[1]), arguments[2]
    e = [row(builder.add(first, first.type(c))) for c in range(3)]
    factors = [_every(builder, x) for x in cgutils.unpack_tuple(builder, arguments[3])]
    with cgutils.for_range(builder, number) as loop:
        x, y, z = (
            builder.fmul(factor, _load(builder, component, loop.index))
            for factor, component in zip(factors, e)
        )
        _store(builder, builder.fadd(builder.fadd(x, y), z), out, loop.index)
    return context.get_dummy_value()


@in_lanes(eliminate, lambda rows, k, factors: types.void(rows, types.intp, factors))
def _(context, builder, signature, arguments):
    row, number = _matrix(context, builder, signature.args[0], arguments[0])
    count = builder.extract_value(
        context.make_array(signature.args[0])(context, builder, arguments[0]).shape, 0
    )
    factor = context.make_array(signature.args[2])(context, builder, arguments[2]).data
    k, size = arguments[1], number.type(LANES)
    start, after = builder.udiv(k, size), builder.add(k, k.type(1))
    with cgutils.for_range_slice(builder, start, number, start.type(1)) as (b, _):
        pivot = _load(builder, row(k), b)
        right = builder.mul(builder.add(b, b.type(1)), size)
        end = builder.select(builder.icmp_unsigned("<", right, count), right, count)
        with cgutils.for_range_slice(builder, after, end, after.type(1)) as (i, _):
            x = _every(builder, builder.load(builder.gep(factor, [i])))
            value = builder.fsub(_load(builder, row(i), b), builder.fmul(x, pivot))
            _store(builder, value, row(i), b)
    return context.get_dummy_value()
