"""Parts of an array, without counted references."""

from numba.core import cgutils, config, types
from numba.extending import intrinsic
from numba.np import arrayobj


def part(array, start, shape):
    """Part of an array, as one of another shape.

    In compiled code it is borrowed: references to it are not counted, so that a function without
    `counted` can make it, and it must not be used when the array is gone.

    Parameters
    ----------
    array : (length,)
    start : int
        Place of the first number of the part.
    shape : tuple of int

    Returns
    -------
    ndarray of that shape
    """
    size = 1
    for n in shape:
        size *= n
    return array[start : start + size].reshape(shape)


@intrinsic
def _part(typingctx, array, start, shape):
    kind = types.Array(array.dtype, len(shape), "C")

    def generate(context, builder, signature, arguments):
        source = context.make_array(signature.args[0])(context, builder, arguments[0])
        sizes = cgutils.unpack_tuple(builder, arguments[2])
        strides = [source.itemsize]
        for size in sizes[:0:-1]:
            strides.insert(0, builder.mul(strides[0], size))
        borrowed = context.make_array(kind)(context, builder)
        arrayobj.populate_array(
            borrowed,
            data=builder.gep(source.data, [arguments[1]]),
            shape=sizes,
            strides=strides,
            itemsize=source.itemsize,
            meminfo=None,
        )
        return borrowed._getvalue()

    return kind(array, types.intp, types.UniTuple(types.intp, len(shape))), generate


if not config.DISABLE_JIT:
    part = _part
