"""Rows of a table called into the processor's cache while something else is computed."""

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import lower_builtin, type_callable
from numba.np.arrayobj import make_array

from ..quantities import Integer

_LINE, _MOST = 64, 4096  # bytes of a line of the cache, and of a row; the processor itself fetches what follows


def prefetch(rows: Integer, i: int) -> None:
    """Call row i of rows (n, k), C-contiguous, into the cache; in Python nothing happens."""


@type_callable(prefetch)
def _type_of_prefetch(_context: Any) -> Callable[..., Any]:
    return lambda rows, i: types.none if isinstance(rows, types.Array) and isinstance(i, types.Integer) else None


def _lowered(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    rows = make_array(signature.args[0])(context, builder, values[0])
    stride, _ = cgutils.unpack_tuple(builder, rows.strides)
    size, byte = stride.type, cgutils.voidptr_t
    start = builder.gep(builder.bitcast(rows.data, byte), [builder.mul(values[1], stride)])
    most = size(_MOST)
    end = builder.select(builder.icmp_signed("<", stride, most), stride, most)
    flag = ir.IntType(32)
    call = cgutils.get_or_insert_function(
        builder.module, ir.FunctionType(ir.VoidType(), [byte, flag, flag, flag]), "llvm.prefetch.p0i8"
    )
    with cgutils.for_range_slice(builder, size(0), end, size(_LINE), inc=True) as (offset, _):
        builder.call(call, [builder.gep(start, [offset]), flag(0), flag(3), flag(1)])  # to read, to keep, data
    return context.get_dummy_value()


lower_builtin(prefetch, types.Array, types.Integer)(_lowered)
