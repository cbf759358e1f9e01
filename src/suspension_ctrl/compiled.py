"""Functions with settings, handed to compiled loops in a form that numba can store.

Numba stores no function that takes another function as an argument. It does store one that takes a named tuple: a
verb is a callable named tuple of settings, and `call` finds its ``__call__`` at compile time.
"""

from collections import namedtuple
from collections.abc import Callable
from functools import lru_cache
from itertools import count
from typing import Any, TypeVar

from numba import njit, types
from numba.core import cgutils
from numba.extending import lower_builtin, register_jitable, type_callable

F = TypeVar("F", bound=Callable[..., Any])


def compiled(**options: Any) -> Callable[[F], F]:
    """Compile a function at first use and store the result, without the wrapper for callers in C: nobody is.

    In a read-only installation without a home there is no place to store it.
    """
    options |= {"no_cfunc_wrapper": True}

    def decorator(function: F) -> F:
        try:
            return njit(**options, cache=True)(function)
        except RuntimeError:
            return njit(**options)(function)

    return decorator


def compilable(**options: Any) -> Callable[[F], F]:
    """Let compiled functions call a function, which stays as it is in Python."""
    decorator: Callable[[F], F] = register_jitable(no_cfunc_wrapper=True, no_cpython_wrapper=True, **options)
    return decorator


def call(verb: Any, arguments: tuple[Any, ...]) -> Any:
    """Call a verb, in compiled code as in Python."""
    return verb(*arguments)


@type_callable(call)
def _type_of_call(context: Any) -> Callable[..., Any]:
    return lambda verb, arguments: _typed(context, verb, arguments)[2].return_type


def _lowered_call(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    function, given, inner = _typed(context.typing_context, *signature.args)
    settings, arguments = (cgutils.unpack_tuple(builder, value) for value in values)
    passed = [*arguments, *settings] if is_spread(signature.args[0]) else [values[0], *arguments]
    cast = [context.cast(builder, *each) for each in zip(passed, given, inner.args, strict=True)]
    return context.get_function(function, inner)(builder, cast)


lower_builtin(call, types.BaseTuple, types.BaseTuple)(_lowered_call)


def _typed(context: Any, verb: Any, arguments: Any) -> tuple[Any, tuple[Any, ...], Any]:
    """Return numba's types of a verb's function, of the values given to it, and of the call.

    A method gets the verb, then the arguments; a user's compiled function the arguments, then the settings.
    """
    given = (*arguments.types, *verb.types) if is_spread(verb) else (verb, *arguments.types)
    found = context.resolve_value_type(verb.instance_class.__call__)
    return found, given, context.resolve_function_type(found, given, {})


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
