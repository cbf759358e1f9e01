"""Verbs: functions with settings, handed to compiled loops in a form that numba can store.

Numba stores no function that takes another function as an argument. It does store one that takes a named tuple: a
verb is a callable named tuple of settings, and `call` finds its ``__call__`` at compile time.
"""

from collections import namedtuple
from collections.abc import Callable
from functools import lru_cache
from itertools import count
from typing import Any, NamedTuple

import numpy as np
from numba import njit, typeof, types
from numba.core import cgutils
from numba.core.errors import TypingError
from numba.core.registry import cpu_target
from numba.extending import intrinsic, is_jitted, lower_builtin, models, register_model, type_callable
from numba.np.arrayobj import make_array

from .compiled import alike, compiled, once, overload


def call(verb: Any, arguments: tuple[Any, ...]) -> Any:
    """Call a verb, in compiled code as in Python."""
    return verb(*arguments)


@type_callable(call)
def _type_of_call(context: Any) -> Callable[..., Any]:
    return lambda verb, arguments: _typed(context, verb, arguments)[2].return_type


def _lowered_call(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    function, given, inner = _typed(context.typing_context, *signature.args)
    (kind, _), (verb, arguments) = signature.args, values
    arguments = cgutils.unpack_tuple(builder, arguments)
    if is_linked(kind):
        return _jump(context, builder, inner, cgutils.unpack_tuple(builder, verb), arguments)
    if isinstance(kind, _AtAddress):
        kind, verb = kind.verb, builder.load(_pointer(context, builder, verb, kind.verb))
    verb = _borrowed(builder, kind, verb)
    passed = [*arguments, *cgutils.unpack_tuple(builder, verb)] if is_spread(kind) else [verb, *arguments]
    cast = [context.cast(builder, *each) for each in zip(passed, given, inner.args, strict=True)]
    return context.get_function(function, inner)(builder, cast)


lower_builtin(call, types.Any, types.BaseTuple)(_lowered_call)


def _borrowed(builder: Any, kind: Any, value: Any) -> Any:
    """Return a verb or one of its settings without owners of its arrays: whoever calls a verb holds it.

    A function counts references to all arrays that it gets, which takes as long as the work of a short verb.
    """
    if isinstance(kind, types.Array):
        return builder.insert_value(value, cgutils.get_null_value(value.type.elements[0]), 0)
    for place, inner in enumerate(getattr(kind, "types", ())):  # of a tuple
        setting = _borrowed(builder, inner, builder.extract_value(value, place))
        value = builder.insert_value(value, setting, place)
    return value


def _jump(context: Any, builder: Any, signature: Any, verb: Any, vectors: Any) -> Any:
    """Call a linked verb by numba's own convention; an exception is handed on to the caller."""
    convention, (address, memory), result = context.call_conv, verb, signature.return_type
    function = builder.inttoptr(address, convention.get_function_type(result, signature.args).as_pointer())
    given = [_start(context, builder, memory), *vectors]
    status, value = convention.call_function(builder, function, result, signature.args, given)
    with cgutils.if_unlikely(builder, status.is_error):
        convention.return_status_propagate(builder, status)
    return value


def _typed(context: Any, verb: Any, arguments: Any) -> tuple[Any, tuple[Any, ...], Any]:
    """Return numba's types of a verb's function, of the values given to it, and of the call.

    A method gets the verb, then the arguments; a user's compiled function the arguments, then the settings.
    """
    if is_linked(verb):
        if arguments.types != (_VECTOR, _VECTOR):
            raise TypingError(f"a linked verb takes two arrays {_VECTOR}, got {arguments.types}")
        return None, (), types.int64(types.voidptr, _VECTOR, _VECTOR)
    kind = verb.verb if isinstance(verb, _AtAddress) else verb
    given = (*arguments.types, *kind.types) if is_spread(kind) else (kind, *arguments.types)
    found = context.resolve_value_type(kind.instance_class.__call__)
    return found, given, context.resolve_function_type(found, given, {})


class Linked(NamedTuple):
    """A verb of two arrays (k,) of real numbers that returns a whole number: where its function and settings lie.

    Numba copies the code of a function into each caller and optimises it there again, and compiles the caller anew
    for each type of settings; across an address it does neither. Addresses belong to a process: verbs are linked
    where a loop begins. Whoever links a verb holds its arrays.
    """

    function: int
    memory: Any  # integers, with the settings


_VECTOR, _MEMORY = types.float64[::1], types.int64[::1]


class _AtAddress(types.Type):
    """Numba's type of the address of a verb."""

    def __init__(self, verb: Any) -> None:
        self.verb = verb
        super().__init__(f"at_address({verb})")


register_model(_AtAddress)(models.OpaqueModel)


def _start(context: Any, builder: Any, memory: Any) -> Any:
    """Return the address at which memory starts."""
    return builder.bitcast(make_array(_MEMORY)(context, builder, memory).data, cgutils.voidptr_t)


def _pointer(context: Any, builder: Any, address: Any, verb: Any) -> Any:
    """Return an address as that of a verb of a type."""
    return builder.bitcast(address, context.get_value_type(verb).as_pointer())


def _copy(_context: Any, verb: Any, _memory: Any) -> Any:
    """Copy a verb into memory."""

    def lowered(context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        builder.store(values[0], _pointer(context, builder, _start(context, builder, values[1]), verb))
        return context.get_dummy_value()

    return types.none(verb, _MEMORY), lowered


_copy_to: Any = intrinsic(_copy)


def _remember(verb: Any, memory: Any) -> None:
    _copy_to(verb, memory)


def _recall(verb: Any, first: Any, second: Any) -> int:
    found: int = call(verb, (first, second))
    return found


_NO_COUNTS: dict[str, Any] = {"_nrt": False}
_NO_WRAPPER: dict[str, Any] = {"no_cpython_wrapper": True}
_REMEMBER = njit(**_NO_COUNTS)(_remember), compiled(**_NO_COUNTS)(_remember)
_RECALL = njit(**_NO_WRAPPER)(_recall), compiled(**_NO_WRAPPER)(_recall)


def linked(verb: Any) -> Any:
    """Return where a verb lies in memory; without numba the verb as it is."""
    if not is_jitted(_REMEMBER[0]):  # NUMBA_DISABLE_JIT
        return verb
    size, remember, function = once(_LINKS, alike(verb), lambda: _link(verb))
    memory = np.empty(size, dtype=np.int64)
    remember(verb, memory)
    return Linked(function, memory)


_LINKS: dict[Any, tuple[int, Any, int]] = {}


def _link(verb: Any) -> tuple[int, Any, int]:
    """Return how many integers hold a verb, what puts it there, and the address of the function that calls it."""
    kind, stored, target = typeof(verb), storable(verb), cpu_target.target_context
    size = -(-target.get_abi_sizeof(target.get_value_type(kind)) // 8)
    remember = overload(_REMEMBER[stored], (kind, _MEMORY)).entry_point
    made = overload(_RECALL[stored], (_AtAddress(kind), _VECTOR, _VECTOR))
    return size, remember, made.library.get_pointer_to_function(made.fndesc.llvm_func_name)


def is_linked(verb: Any) -> bool:
    """Whether a verb's type is `Linked`."""
    return getattr(verb, "instance_class", None) is Linked


def is_spread(verb: Any) -> bool:
    """Whether the function of a verb's type is a user's, with the settings as its last arguments."""
    return hasattr(verb.instance_class, "spread")


def call_compiled(verb: Any, *arguments: Any) -> Any:
    """Call a verb from Python, compiled: ``toolbox.register("repair", call_compiled, RedrawOutside(...))``."""
    return _compiled(type(verb).__call__)(verb, *arguments)


@lru_cache
def _compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    return compiled()(function)


def verb_of(given: tuple[Any, ...]) -> Any:
    """Return a compiled function and its last arguments as a verb of a class of this process; a verb as it is."""
    if callable(given):
        return given
    function, settings = given
    return _class_of(function, len(settings))(*settings)


@lru_cache
def _class_of(function: Callable[..., Any], settings: int) -> Any:
    name = f"Verb{next(_numbers)}"  # numba takes two classes of one name and the same fields for one
    fields = namedtuple(name, [f"setting_{i}" for i in range(settings)])  # type: ignore[misc]
    return type(name, (fields,), {"__call__": function, "spread": True, "__module__": function.__module__})


_numbers = count()


def storable(verb: Any) -> bool:
    """Whether a verb and the verbs in its settings are of this package: numba's store holds classes by name."""
    ours = type(verb).__module__.startswith(f"{__package__.split('.')[0]}.")
    return ours and all(storable(setting) for setting in verb if callable(setting))
