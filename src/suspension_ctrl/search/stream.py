"""The random numbers of a generator in compiled loops, drawn in line.

Compiled code calls numpy's generator through a pointer for each number, which takes three times as long as the
number itself. Here is the same algorithm on a copy of the generator's state.

M. E. O'Neill, "PCG: A family of simple fast space-efficient statistically good algorithms for random number
generation", Harvey Mudd College HMC-CS-2014-0905, 2014: PCG XSL RR 128/64, numpy's PCG64.
"""

from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload_method
from numba.np.arrayobj import make_array
from numpy.typing import NDArray

from ..compiled import as_part

_MULTIPLIER = 0x2360ED051FC65DA44385DF649FCCF645
_HALF, _WHOLE = ir.IntType(64), ir.IntType(128)
_LOW = (1 << 64) - 1


class Stream(NamedTuple):
    """The stream of a PCG64; compiled code draws by the method `random`, as from a generator."""

    state: NDArray[np.uint64]  # (4,) state and increment, the lower half of each first


def stream_of(rng: np.random.Generator) -> Any:
    """Return the stream of a generator, the generator itself if it is not a PCG64."""
    if type(rng.bit_generator) is not np.random.PCG64:
        return rng
    at: Any = rng.bit_generator.state["state"]
    halves = [half for whole in (at["state"], at["inc"]) for half in (whole & _LOW, whole >> 64)]
    return Stream(np.array(halves, dtype=np.uint64))


def put_back(stream: Any, rng: np.random.Generator) -> None:
    """Continue a generator where its stream ends."""
    if isinstance(stream, Stream):
        low, high, *_ = stream.state.tolist()
        before: Any = rng.bit_generator.state
        rng.bit_generator.state = {**before, "state": {**before["state"], "state": high << 64 | low}}


def _step(_context: Any, state: Any) -> Any:
    """Advance a state by one step; return 64 random bits."""

    def lowered(context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        halves = make_array(state)(context, builder, values[0]).data
        place = builder.bitcast(halves, _WHOLE.as_pointer())
        increment = builder.gep(place, [ir.IntType(32)(1)])
        product = builder.mul(builder.load(place, align=8), _WHOLE(_MULTIPLIER))
        after = builder.add(product, builder.load(increment, align=8))
        builder.store(after, place, align=8)
        high = builder.trunc(builder.lshr(after, _WHOLE(64)), _HALF)
        mixed, turn = builder.xor(high, builder.trunc(after, _HALF)), builder.lshr(high, _HALF(58))
        rotate = cgutils.get_or_insert_function(
            builder.module, ir.FunctionType(_HALF, [_HALF] * 3), "llvm.fshr.i64"
        )
        return builder.call(rotate, [mixed, mixed, turn])

    return types.uint64(state), lowered


_next: Any = intrinsic(_step)


def _number(stream: Any) -> Any:
    return (_next(stream.state) >> np.uint64(11)) * 2.0**-53  # as numpy does


def _random(stream: Any) -> Any:
    return _number if stream.instance_class is Stream else None


_overload_method: Any = overload_method
_overload_method(types.NamedUniTuple, "random", jit_options=as_part({"_nrt": False}))(_random)
