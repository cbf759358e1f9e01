"""Functions with settings, handed to compiled loops in a form that numba can store.

Numba stores no function that takes another function as an argument. It does store one that takes a named tuple: a
verb is a callable named tuple of settings, and `call` finds its ``__call__`` at compile time.
"""

import gc
from collections import namedtuple
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from itertools import count
from types import FunctionType
from typing import Any, NamedTuple, TypeVar

from numba import njit, typeof, types
from numba.core import cgutils
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, Flags
from numba.core.errors import TypingError
from numba.extending import is_jitted, lower_builtin, register_jitable, type_callable

F = TypeVar("F", bound=Callable[..., Any])
_Library: Any = JITCodeLibrary  # most of numba has no annotations
_Compiler: Any = Compiler
_Flags: Any = Flags


def compiled(**options: Any) -> Callable[[F], F]:
    """Compile a function at first use and store the result, without the wrapper for callers in C: nobody is.

    In a read-only installation without a home there is no place to store it.
    """
    options |= {"no_cfunc_wrapper": True, "pipeline_class": _WholeCompiler}

    def decorator(function: F) -> F:
        try:
            return njit(**options, cache=True)(function)
        except RuntimeError:
            return njit(**options)(function)

    return decorator


def compilable(**options: Any) -> Callable[[F], F]:
    """Let compiled functions call a function, which stays as it is in Python.

    It becomes machine code as part of its callers alone. It cannot print or format, for which numba keeps an
    environment beside the machine code of a function.
    """
    options |= {"no_cfunc_wrapper": True, "no_cpython_wrapper": True, "pipeline_class": _PartCompiler}
    decorator: Callable[[F], F] = register_jitable(**options)
    return decorator


class _Frozen:
    """Whether somebody else has frozen objects, which stay so; counting a million takes a tenth of a second."""

    found = False

    @classmethod
    def seen(cls) -> bool:
        """Count until there are some."""
        cls.found = cls.found or gc.get_freeze_count() > 0
        return cls.found


@contextmanager
def uncollected() -> Iterator[None]:
    """Leave garbage alone in the block.

    Most of the objects that compilation makes are kept, and the collector would walk through all of them again and
    again: an eighth of the time to compile.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects and not _Frozen.seen():  # what was made grows old without being looked at
            gc.freeze()
            gc.unfreeze()
        if collects:
            gc.enable()


class _Whole(_Library):  # type: ignore[misc]
    """The code of a function, optimised once.

    Numba optimises a function when it is added, and again with all that it calls: a tenth of the time to compile.
    """

    def _optimize_functions(self, module: Any) -> None:
        module.data_layout = str(self._codegen.target_data)


class _Part(_Whole):
    """The code of a function that only other compiled functions call.

    Numba optimises and translates every function by itself, and again within each of its callers: up to a third of
    the time to compile. Loops over frequencies, which have options for fast arithmetic, are optimised alone: in a
    caller the compiler cannot tell their rows apart, and would not vectorise them.
    """

    def __init__(self, codegen: Any, name: str, *, is_loop: bool) -> None:
        super().__init__(codegen, name)
        self._is_loop = is_loop

    def _optimize_final_module(self) -> None:
        if self._is_loop:
            super()._optimize_final_module()

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    def get_pointer_to_function(self, _name: str) -> int:
        """Return 0, as of any function without a wrapper for callers in Python."""
        self._ensure_finalized()
        return 0

    @property
    def codegen(self) -> "_Part":
        """What numba tells of the function's environment: there is no machine code that needs it."""
        return self

    def set_env(self, _name: str, _environment: Any) -> None:
        """Leave the environment alone."""


class _QuickFlags(_Flags):  # type: ignore[misc]
    """Numba's options of a compilation.

    They are part of the key by which functions are looked up, ten thousand times for a large loop; numba compares
    them one by one with their defaults.
    """

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _QuickFlags) and bool(self._values == other._values)

    def __hash__(self) -> int:
        return hash(_QuickFlags)


class _QuickCompiler(_Compiler):  # type: ignore[misc]
    """Numba's compiler with options that are quick to compare."""

    def __init__(self, typing: Any, target: Any, library: Any, arguments: Any, result: Any, flags: Any, of: Any):
        super().__init__(typing, target, library, arguments, result, _QuickFlags(flags), of)


class _WholeCompiler(_QuickCompiler):
    """Numba's compiler of a function and of all that it calls."""

    def __init__(self, typing: Any, target: Any, _library: Any, arguments: Any, result: Any, flags: Any, of: Any):
        whole = _Whole(target.codegen(), "whole")
        whole.enable_object_caching()  # as numba does for those that it makes
        super().__init__(typing, target, whole, arguments, result, flags, of)

    def compile_extra(self, function: Any) -> Any:
        """Return the compiled function."""
        with uncollected():
            return super().compile_extra(function)


class _PartCompiler(_QuickCompiler):
    """Numba's compiler of a function that only other compiled functions call."""

    def __init__(self, typing: Any, target: Any, _library: Any, arguments: Any, result: Any, flags: Any, of: Any):
        part = _Part(target.codegen(), "part", is_loop=bool(flags.fastmath))
        super().__init__(typing, target, part, arguments, result, flags, of)


def uncounted(**options: Any) -> Callable[[F], F]:
    """Let compiled functions call a function that makes no array, without counts of references to arrays.

    Numba counts them atomically for every part of an array and every tuple of arrays that is passed on: this takes
    longer than the arithmetic of a design or of a step. Functions that are called in turn have no counts either.
    """
    return compilable(_nrt=False, **options)


def entry(function: Any, arguments: tuple[Any, ...]) -> Any:
    """Return the machine code of a compiled function for arguments; any other function as it is.

    A compiled function determines the types of its arguments at each call, in 10 us where they are many. Machine
    code does not: its arguments must have the same types.
    """
    if not is_jitted(function):
        return function
    return _overload(function, tuple(map(_kind_of, arguments))).entry_point


def _overload(function: Any, kinds: tuple[Any, ...]) -> Any:
    """Return what numba compiled of a function for types of arguments, None if it cannot for just these."""
    if kinds not in function.overloads:
        function.get_call_template(kinds, {})  # compiles, or loads from numba's store
    return function.overloads.get(kinds)


def _kind_of(value: Any) -> Any:
    """Return the type of an argument; that of a linked verb is known."""
    if isinstance(value, Linked):
        return types.NamedTuple((_KINDS[value.address], types.int64), Linked)
    return typeof(value)


def call(verb: Any, arguments: tuple[Any, ...]) -> Any:
    """Call a verb, in compiled code as in Python."""
    return verb(*arguments)


@type_callable(call)
def _type_of_call(context: Any) -> Callable[..., Any]:
    return lambda verb, arguments: _typed(context, verb, arguments)[2].return_type


def _lowered_call(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    function, given, inner = _typed(context.typing_context, *signature.args)
    (kind, _), (verb, arguments) = signature.args, values
    if is_linked(kind):
        verb, address = cgutils.unpack_tuple(builder, verb)
        kind = kind.types[0]
    verb = _borrowed(builder, kind, verb)
    settings, arguments = (cgutils.unpack_tuple(builder, value) for value in (verb, arguments))
    passed = [*arguments, *settings] if is_spread(kind) else [verb, *arguments]
    cast = [context.cast(builder, *each) for each in zip(passed, given, inner.args, strict=True)]
    if is_linked(signature.args[0]):
        return _jump(context, builder, address, inner, cast)
    return context.get_function(function, inner)(builder, cast)


lower_builtin(call, types.BaseTuple, types.BaseTuple)(_lowered_call)


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


def _jump(context: Any, builder: Any, address: Any, signature: Any, arguments: Any) -> Any:
    """Call the function at an address by numba's own convention; an exception is handed on to the caller."""
    convention, result = context.call_conv, signature.return_type
    function = builder.inttoptr(address, convention.get_function_type(result, signature.args).as_pointer())
    status, value = convention.call_function(builder, function, result, signature.args, arguments)
    with cgutils.if_unlikely(builder, status.is_error):
        convention.return_status_propagate(builder, status)
    return value


def _typed(context: Any, verb: Any, arguments: Any) -> tuple[Any, tuple[Any, ...], Any]:
    """Return numba's types of a verb's function, of the values given to it, and of the call.

    A method gets the verb, then the arguments; a user's compiled function the arguments, then the settings.
    """
    if is_linked(verb):
        signature = _LINKED[verb.types[0]].signature
        if _given(verb.types[0], arguments.types) != signature.args:
            raise TypingError(f"a linked verb takes arrays {_VECTOR}, got {arguments.types}")
        return None, signature.args, signature
    given = _given(verb, arguments.types)
    found = context.resolve_value_type(verb.instance_class.__call__)
    return found, given, context.resolve_function_type(found, given, {})


def _given(kind: Any, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the types that a verb's function gets, by the types of verb and arguments."""
    return (*arguments, *kind.types) if is_spread(kind) else (kind, *arguments)


class Linked(NamedTuple):
    """A verb of arrays (k,) of real numbers, and the address of its compiled function.

    Numba copies the code of a function into each caller and optimises it there again; across an address it does
    not. An address belongs to a process: verbs are linked where a loop begins and not kept.
    """

    verb: Any
    address: int


_VECTOR = types.float64[::1]
_LINKED: dict[Any, Any] = {}  # by type of verb what numba compiled, for good: the code at an address must stay
_KINDS: dict[int, Any] = {}  # types of verbs by address


def linked(verb: Any, vectors: int = 1) -> Any:
    """Return a verb of so many arrays (k,) with its address, or as it is if it cannot be compiled for them."""
    function, kind = _callee(type(verb).__call__, storable(verb)), typeof(verb)
    if not is_jitted(function):  # NUMBA_DISABLE_JIT
        return verb
    made = _overload(function, _given(kind, (_VECTOR,) * vectors))
    if made is None:  # a user's function, compiled for other types of arguments alone
        return verb
    address = made.library.get_pointer_to_function(made.fndesc.llvm_func_name)
    _LINKED[kind], _KINDS[address] = made, kind
    return Linked(verb, address)


@lru_cache
def _callee(function: Any, stored: bool) -> Any:
    """Return a verb's function, compiled without the wrapper for callers in Python.

    Under a name of its own: numba's store knows functions by name, and one with the wrapper may be there.
    """
    if is_jitted(function):
        return function
    twin = FunctionType(function.__code__, function.__globals__)
    twin.__module__, twin.__qualname__ = function.__module__, f"{function.__qualname__}_linked"
    decorator: Any = compiled if stored else njit
    return decorator(no_cpython_wrapper=True)(twin)


def is_linked(verb: Any) -> bool:
    """Whether a verb's type is `Linked`."""
    return verb.instance_class is Linked


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
