"""Eight numbers at a time in compiled code, in the vector registers of whatever processor there is.

The compiler makes vectors of a loop by itself only if few of its arrays might overlap. A long chain of arithmetic
on many rows is written in lanes: it stays in registers, and its bits do not depend on their width.
"""

import operator
from collections.abc import Callable
from itertools import accumulate
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import lower_builtin, models, register_model, type_callable

from ..compiled import uncounted
from ..quantities import Real

WIDTH = 8

Lanes = Any
"""Eight numbers; in plain Python an array (8,)."""
Pair = tuple[Any, Any]
"""Real and imaginary parts of eight complex numbers."""

_VECTOR, _INDEX = ir.VectorType(ir.DoubleType(), WIDTH), ir.IntType(32)
_NUMBER = 8  # bytes
_LINE = WIDTH * _NUMBER  # of the cache: eight numbers across two lines take twice as long to load


class _Lanes(types.Type):
    """Numba's type of eight numbers."""

    def __init__(self) -> None:
        super().__init__("Lanes")


@register_model(_Lanes)
class _Model(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        models.PrimitiveModel.__init__(self, manager, kind, _VECTOR)


_LANES = _Lanes()


def empty(shape: tuple[int, ...]) -> Any:
    """Return an array to be filled, of which each multiple of eight numbers begins a line of the cache."""
    size = int(np.prod(shape))
    room = np.empty(size + WIDTH - 1)
    first = -room.ctypes.data // _NUMBER % WIDTH
    return room[first : first + size].reshape(shape)


def in_lines(array: Real) -> Real:
    """Return a copy of an array as of `empty`."""
    found: Real = empty(array.shape)
    found[...] = array
    return found


def load(array: Any, place: tuple[int, ...]) -> Lanes:
    """Return eight numbers of an array along its last dimension, the first at a place."""
    return array[(*place[:-1], slice(place[-1], place[-1] + WIDTH))]


def store(lanes: Lanes, array: Any, place: tuple[int, ...]) -> None:
    """Fill in eight numbers of an array along its last dimension, the first at a place."""
    array[(*place[:-1], slice(place[-1], place[-1] + WIDTH))] = lanes


def spread(value: float) -> Lanes:
    """Return eight times the same number."""
    return np.full(WIDTH, value)


def fused(factor: Lanes, other: Lanes, added: Lanes) -> Lanes:
    """Return ``factor * other + added``, rounded once in compiled code."""
    return factor * other + added


def total(lanes: Lanes) -> float:
    """Return the sum of eight numbers, of halves of them in turn."""
    while len(lanes) > 1:
        lanes = lanes[: len(lanes) // 2] + lanes[len(lanes) // 2 :]
    return float(lanes[0])


@uncounted(forceinline=True)
def product(a: Pair, b: Pair) -> Pair:
    """Return a b."""
    (x, y), (u, v) = a, b
    return fused(x, u, -(y * v)), fused(x, v, y * u)


@uncounted(forceinline=True)
def plus(z: Pair, a: Pair, b: Pair) -> Pair:
    """Return z + a b."""
    (x, y), (u, v), (re, im) = a, b, z
    return fused(x, u, fused(-y, v, re)), fused(x, v, fused(y, u, im))


@uncounted(forceinline=True)
def less(z: Pair, a: Pair, b: Pair) -> Pair:
    """Return z - a b."""
    (x, y), (u, v), (re, im) = a, b, z
    return fused(-x, u, fused(y, v, re)), fused(-x, v, fused(-y, u, im))


@uncounted(error_model="numpy", forceinline=True)
def reciprocal(a: Pair) -> Pair:
    """Return 1 / a."""
    x, y = a
    inverse = spread(1.0) / fused(x, x, y * y)
    return x * inverse, -(y * inverse)


@uncounted(forceinline=True)
def at(rows: Real, row: int, start: int) -> Pair:
    """Return eight complex numbers of a row of real and imaginary parts (2, n)."""
    return load(rows, (row, 0, start)), load(rows, (row, 1, start))


@uncounted(forceinline=True)
def row_at(rows: Real, row: int) -> Pair:
    """Return a row of eight complex numbers, real parts first, of an array (16 l,) with short addresses."""
    return load(rows, (2 * WIDTH * row,)), load(rows, (2 * WIDTH * row + WIDTH,))


@uncounted(forceinline=True)
def put(value: Pair, rows: Real, row: int) -> None:
    """Fill in a row of eight complex numbers of an array (16 l,)."""
    store(value[0], rows, (2 * WIDTH * row,))
    store(value[1], rows, (2 * WIDTH * row + WIDTH,))


def _register(function: Any, result: Any, *kinds: Any) -> Callable[[Any], None]:
    """Let compiled code call a function of these types of arguments, as the decorated function writes it."""
    typers: tuple[Callable[..., Any], ...] = (
        lambda a: result if _fits(kinds, a) else None,
        lambda a, b: result if _fits(kinds, a, b) else None,
        lambda a, b, c: result if _fits(kinds, a, b, c) else None,
    )
    type_callable(function)(lambda _context: typers[len(kinds) - 1])
    return lower_builtin(function, *kinds)


def _fits(kinds: tuple[Any, ...], *given: Any) -> bool:
    """Whether types of arguments are of these classes."""
    return all(map(isinstance, given, kinds))


def _emptied(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    """Make the array of `empty`, as numba makes one of a shape, in memory that begins a line of the cache."""
    kind, lengths = context.get_value_type(signature.return_type), cgutils.unpack_tuple(builder, values[0])
    shape = [context.cast(builder, *each, types.intp) for each in zip(lengths, signature.args[0], strict=True)]
    number = context.get_constant(types.intp, _NUMBER)
    *strides, size = accumulate([number, *reversed(shape)], builder.mul)  # in bytes
    memory = context.nrt.meminfo_alloc_aligned(builder, size, _LINE)
    data = builder.bitcast(context.nrt.meminfo_data(builder, memory), kind.elements[4])
    parent, count = cgutils.get_null_value(kind.elements[1]), builder.sdiv(size, number)
    dimensions = (cgutils.pack_array(builder, each) for each in (shape, strides[::-1]))
    return cgutils.make_anonymous_struct(builder, (memory, parent, count, number, data, *dimensions), kind)


def _loaded(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    """Read a vector from an array, of which numbers alone need to be aligned."""
    return builder.load(_pointer(context, builder, signature.args[0], *values), align=_NUMBER)


def _stored(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    """Write a vector to an array, of which numbers alone need to be aligned."""
    builder.store(values[0], _pointer(context, builder, signature.args[1], *values[1:]), align=_NUMBER)
    return context.get_dummy_value()


def _pointer(context: Any, builder: Any, kind: Any, array: Any, place: Any) -> Any:
    """Return the address of an array's place as that of a vector."""
    array, indices = context.make_array(kind)(context, builder, array), cgutils.unpack_tuple(builder, place)
    first = cgutils.get_item_pointer(context, builder, kind, array, indices, wraparound=False)
    return builder.bitcast(first, _VECTOR.as_pointer())


def _spread(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    """Put a number into the first lane, and the first lane into all others."""
    nothing, first = ir.Constant(_VECTOR, ir.Undefined), ir.Constant(_INDEX, 0)
    return builder.shuffle_vector(builder.insert_element(nothing, values[0], first), nothing, _places([0] * WIDTH))


def _fused(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    """Call the compiler's own fused multiplication and addition."""
    kind = ir.FunctionType(_VECTOR, [_VECTOR] * 3)
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.fma.v{WIDTH}f64"), values)


def _total(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    """Add the upper half of the lanes to the lower one until one number is left."""
    lanes, half = values[0], WIDTH // 2
    while half:
        nothing = ir.Constant(lanes.type, ir.Undefined)
        parts = (_places(list(range(first, first + half))) for first in (0, half))
        lanes, half = builder.fadd(*(builder.shuffle_vector(lanes, nothing, part) for part in parts)), half // 2
    return builder.extract_element(lanes, ir.Constant(_INDEX, 0))


def _places(numbers: list[int]) -> Any:
    """Return the numbers of lanes as the compiler takes them."""
    return ir.Constant(ir.VectorType(_INDEX, len(numbers)), numbers)


def _by(instruction: str) -> Callable[..., Any]:
    """Return how an instruction of the compiler is written."""
    return lambda _context, builder, _signature, values: getattr(builder, instruction)(*values)


type_callable(empty)(lambda _context: lambda shape: types.Array(types.float64, len(shape), "C"))
lower_builtin(empty, types.BaseTuple)(_emptied)
_register(load, _LANES, types.Array, types.BaseTuple)(_loaded)
_register(store, types.none, _Lanes, types.Array, types.BaseTuple)(_stored)
_register(spread, _LANES, types.Float)(_spread)
_register(fused, _LANES, _Lanes, _Lanes, _Lanes)(_fused)
_register(total, types.float64, _Lanes)(_total)
_register(operator.neg, _LANES, _Lanes)(_by("fneg"))
_register(operator.add, _LANES, _Lanes, _Lanes)(_by("fadd"))
_register(operator.mul, _LANES, _Lanes, _Lanes)(_by("fmul"))
_register(operator.truediv, _LANES, _Lanes, _Lanes)(_by("fdiv"))
