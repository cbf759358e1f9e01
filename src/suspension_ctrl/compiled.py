"""Numba's compiler as loops need it here: quick to run, results stored, parts made within their callers alone.

A function that Python calls is `compiled`, or `filling` where it makes no array; one that only compiled functions
call is `compilable`, or `uncounted` where it makes no array.
"""

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

import numpy as np
from llvmlite import binding as llvm
from numba import njit, typeof
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, Flags
from numba.extending import is_jitted, register_jitable

F = TypeVar("F", bound=Callable[..., Any])
_Library: Any = JITCodeLibrary  # most of numba has no annotations
_Compiler: Any = Compiler
_Flags: Any = Flags


def compiled(*, unrolled: bool = True, interleaved: bool = True, **options: Any) -> Callable[[F], F]:
    """Compile a function at first use and store the result, without a wrapper for callers in C: there are none.

    A large function without counts of references (`uncounted`) compiles in less time if its loops are not
    `interleaved`, and in less still if they are not `unrolled` either.
    In a read-only installation without a home there is no place to store it.
    """
    compiler = _WholeCompiler if unrolled and interleaved else _BriefCompiler if unrolled else _RolledCompiler
    options |= {"no_cfunc_wrapper": True, "pipeline_class": compiler}

    def decorator(function: F) -> F:
        try:
            return njit(**options, cache=True)(function)
        except RuntimeError:
            return njit(**options)(function)

    return decorator


def filling(**options: Any) -> Callable[[F], F]:
    """Compile a function that makes no array, without counts of references and unrolled loops: it takes less time.

    Divisions are as numpy's, by zero too.
    """
    return compiled(_nrt=False, error_model="numpy", unrolled=False, **options)


def compilable(**options: Any) -> Callable[[F], F]:
    """Let compiled functions call a function, which stays as it is in Python.

    It becomes machine code as part of its callers alone. It cannot print or format, for which numba keeps an
    environment beside the machine code of a function.
    """
    decorator: Callable[[F], F] = register_jitable(**as_part(options))
    return decorator


def as_part(options: dict[str, Any]) -> dict[str, Any]:
    """Return numba's options of a function that becomes machine code as part of its callers alone."""
    return options | {"no_cfunc_wrapper": True, "no_cpython_wrapper": True, "pipeline_class": _PartCompiler}


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

    def make() -> Any:
        return overload(function, tuple(map(typeof, arguments))).entry_point

    return once(_ENTRIES, (function, *map(alike, arguments)), make)


_ENTRIES: dict[Any, Any] = {}
_MOST = 1000  # that are kept


def once(kept: dict[Any, Any], key: Any, make: Callable[[], Any]) -> Any:
    """Return what is kept under a key; it is made if there is nothing."""
    found = kept.get(key)
    if found is None:
        if len(kept) >= _MOST:
            kept.clear()
        found = kept[key] = make()
    return found


def alike(argument: Any) -> Any:
    """Return what is equal for arguments of one type alone.

    Numba takes a third of a millisecond to tell the types of all arguments of a search.
    """
    kind = type(argument)
    if kind is np.ndarray:
        return argument.dtype, argument.ndim, argument.flags.num
    if isinstance(argument, tuple):
        return kind, *map(alike, argument)
    return kind if kind is float or kind is bool else typeof(argument)


def overload(function: Any, kinds: tuple[Any, ...]) -> Any:
    """Return what numba compiled of a function for types of arguments."""
    if kinds not in function.overloads:
        function.get_call_template(kinds, {})  # compiles, or loads from numba's store
    return function.overloads[kinds]


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


class _Frozen:
    """Whether somebody else has frozen objects, which stay so; counting a million takes a tenth of a second."""

    found = False

    @classmethod
    def seen(cls) -> bool:
        """Count until there are some."""
        cls.found = cls.found or gc.get_freeze_count() > 0
        return cls.found


class _Whole(_Library):  # type: ignore[misc]
    """The code of a function, optimised once.

    Numba optimises a function when it is added, and again with all that it calls: a tenth of the time to compile.
    """

    def _optimize_functions(self, module: Any) -> None:
        module.data_layout = str(self._codegen.target_data)


class _Brief(_Whole):
    """The code of a function without counts of references, optimised in one pass and with loops not interleaved.

    Numba's first pass serves these counts. It and vectors of several rounds of a loop side by side take a third
    of the time to optimise and translate a large function.
    """

    _unrolls = True

    def _optimize_final_module(self) -> None:
        options = llvm.create_pipeline_tuning_options(speed_level=3)
        options.loop_vectorization, options.slp_vectorization = True, False  # as numba does
        options.loop_unrolling, options.loop_interleaving = self._unrolls, False
        triple, processor, features = self._codegen.magic_tuple()
        target = llvm.Target.from_triple(triple).create_target_machine(cpu=processor, features=features, opt=3)
        builder = llvm.create_pass_builder(target, options)
        builder.getModulePassManager().run(self._final_module, builder)


class _Rolled(_Brief):
    """The code of such a function with its loops as they are."""

    _unrolls = False


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
        """Itself, in place of the generator of code, of which numba asks nothing here but `set_env`."""
        return self

    def set_env(self, _name: str, _environment: Any) -> None:
        """Leave the environment of the function alone: no machine code needs it."""


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

    _library = _Whole

    def __init__(self, typing: Any, target: Any, _library: Any, arguments: Any, result: Any, flags: Any, of: Any):
        whole = self._library(target.codegen(), "whole")
        whole.enable_object_caching()  # as numba does for those that it makes
        super().__init__(typing, target, whole, arguments, result, flags, of)

    def compile_extra(self, function: Any) -> Any:
        """Return the compiled function."""
        with uncollected():
            return super().compile_extra(function)


class _BriefCompiler(_WholeCompiler):
    """Numba's compiler of a function whose loops are not interleaved."""

    _library = _Brief


class _RolledCompiler(_WholeCompiler):
    """Numba's compiler of a function whose loops are not unrolled."""

    _library = _Rolled


class _PartCompiler(_QuickCompiler):
    """Numba's compiler of a function that only other compiled functions call."""

    def __init__(self, typing: Any, target: Any, _library: Any, arguments: Any, result: Any, flags: Any, of: Any):
        part = _Part(target.codegen(), "part", is_loop=bool(flags.fastmath))
        super().__init__(typing, target, part, arguments, result, flags, of)
