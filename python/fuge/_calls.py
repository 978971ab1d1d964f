"""Calls of C functions: messages become exceptions and warnings, handles are freed."""

from __future__ import annotations

import ctypes
import os
import signal
import threading
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any, Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from fuge._arrays import doubles, vector
from fuge._library import CALLBACKS, HEADERS, function
from fuge._messages import Shapes, in_python
from fuge.errors import Status, error, finish

MESSAGE_LENGTH = HEADERS.constants["MESSAGE_LENGTH"]

NO_SHAPES: Shapes = MappingProxyType({})

# For each thread: the exception that a callback has raised, until the call of the library returns, and whether Ctrl-C
# was pressed.
_pending = threading.local()


def _take_exception() -> BaseException | None:
    exception: BaseException | None = getattr(_pending, "exception", None)
    _pending.exception = None
    return exception


@contextmanager
def interruptible() -> Iterator[None]:
    """Let Ctrl-C end a call of the library at its next callback.

    Python by itself raises KeyboardInterrupt where the callback begins, before its `try`, and ctypes drops it there.
    """
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return

    def remember(number: int, frame: object) -> None:
        _pending.interrupted = True

    signal.signal(signal.SIGINT, remember)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if _interrupted():
            _pending.interrupted = False
            raise KeyboardInterrupt


def _interrupted() -> bool:
    return bool(getattr(_pending, "interrupted", False))


def _check_interrupt() -> None:
    if _interrupted():
        _pending.interrupted = False
        raise KeyboardInterrupt


def end_call(code: int, read_message: Callable[[], str], shapes: Shapes = NO_SHAPES) -> None:
    """Raise the exception of a callback, if there is one; otherwise raise or warn as the status demands."""
    exception = _take_exception()
    if exception is not None:
        raise exception
    if code != 0:
        message = read_message()
        # Numbers in messages about a file are those of its lines.
        finish(code, message if code == Status.ERR_FILE else in_python(message, shapes))


def call(name: str, *arguments: Any, shapes: Shapes = NO_SHAPES) -> None:
    """Call a function with `arguments`, followed by its last two, message and len.

    `shapes` are those of arrays to which the message may refer, as :func:`in_python` takes them.
    """
    message = ctypes.create_string_buffer(MESSAGE_LENGTH + 1)
    code = function(name)(*arguments, message, MESSAGE_LENGTH + 1)
    end_call(code, lambda: message.value.decode(errors="replace"), shapes)


class Handle:
    """A C object, freed when nothing uses it any more.

    The handles that it needs are freed after it, in whatever order the garbage collector or the caller closes them.
    """

    # Reentrant, because the garbage collector may free one handle while another one is being freed.
    _counting = threading.RLock()
    # There is nothing to free until __init__ has ended, which fails where the library lacks a function.
    _freed = True

    def __init__(self, name: str, free: str, pointer: ctypes.c_void_p) -> None:
        self.name = name
        self._free = function(free)
        self._pointer = pointer
        self._needs: list[Handle] = []
        self._kept: list[Any] = []
        self._users = 0
        self._readers = 0
        self._closed = False
        self._lock = threading.Lock()
        self._owner: int | None = None
        self._freed = False

    def need(self, other: Handle) -> None:
        """Keep `other` until this one has been freed."""
        with self._counting:
            other._check_open()
            self._needs.append(other)
            other._users += 1

    def keep(self, *objects: Any) -> None:
        """Keep arrays and callbacks to which the C object refers, as long as it lives."""
        self._kept.extend(objects)

    def keep_only(self, callback: Any) -> None:
        """Keep this callback, and nothing that was kept before."""
        self._kept = [callback]

    @property
    def pointer(self) -> ctypes.c_void_p:
        """The address of the C object, for calls during which nothing else can close it."""
        self._check_open()
        return self._pointer

    def _check_open(self) -> None:
        if self._closed:
            raise error(Status.ERR_CALL_ORDER, f"the {self.name} is closed")

    @contextmanager
    def use(self) -> Iterator[ctypes.c_void_p]:
        """The pointer, for one thread at a time, and not for a callback of the call that it is used in."""
        with self._alone():
            yield self.pointer

    @contextmanager
    def reading(self, closed: bool = False) -> Iterator[ctypes.c_void_p]:
        """The pointer, for calls that may run side by side; a handle closed meanwhile is freed after the last of them.

        `closed`: it may have been closed before, as long as another handle needs it.
        """
        with self._alone(), self._counting:
            if not closed:
                self._check_open()
            self._users += 1
            self._readers += 1
        try:
            yield self._pointer
        finally:
            with self._counting:
                self._readers -= 1
                self._users -= 1
                self._release()

    @contextmanager
    def changing(self) -> Iterator[ctypes.c_void_p]:
        """The pointer, for a call that changes the object; an error while calls read it."""
        with self.use() as pointer:
            if self._readers > 0:
                reason = "it cannot be changed during a product or a solve"
                raise error(Status.ERR_CALL_ORDER, f"the {self.name} is in use: {reason}")
            yield pointer

    @contextmanager
    def _alone(self) -> Iterator[None]:
        me = threading.get_ident()
        if self._owner == me:
            raise error(Status.ERR_CALL_ORDER, f"the {self.name} is in use: its functions cannot be called from inside")
        with self._lock:
            self._owner = me
            try:
                yield
            finally:
                self._owner = None

    def close(self) -> None:
        """Free the object, now or when its last user has ended."""
        if not self._closed:
            with self.use():
                self._closed = True
        self._release()

    def _release(self) -> None:
        with self._counting:
            if not self._freed and self._closed and self._users == 0:
                self._freed = True
                self._free(ctypes.byref(self._pointer))
                for other in self._needs:
                    other._users -= 1
                    other._release()

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError(f"cannot copy or pickle the {self.name}: it is in the memory of the library")

    def __del__(self) -> None:
        # No call is using the handle, because it would hold a reference.
        self._closed = True
        self._release()


# In a forked child the thread that holds the lock does not exist: nobody may hold it during a fork.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(
        before=Handle._counting.acquire,
        after_in_parent=Handle._counting.release,
        after_in_child=Handle._counting.release,
    )


class Owner:
    """Base of the classes that own a handle: ``close()``, and use in a ``with`` statement."""

    _handle: Handle

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Refuse copies and pickles: the memory is the library's."""
        name = type(self).__name__
        raise TypeError(f"cannot copy or pickle {name!r} object: it is in the memory of the library; make another one")

    def close(self) -> None:
        """Free the memory of the library now; otherwise that happens when the object is no longer used.

        Not while another thread is inside one of its functions.
        """
        self._handle.close()

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def _call(self, name: str, *arguments: Any, shapes: Shapes | None = None) -> None:
        """Call a function of the handle that stores its message in the handle."""
        with self._handle.use() as pointer:
            code = function(name)(pointer, *arguments)
            end_call(code, lambda: self._read_message(pointer), self._shapes if shapes is None else shapes)

    def _counts(self, getter: str) -> list[int]:
        """The ints that a function of the handle returns, one in each argument after the handle."""
        signature = HEADERS.functions[getter]
        counts = [np.empty(1, dtype=np.intc) for _ in signature.parameters[1:]]
        self._call(getter, *counts)
        return [int(count[0]) for count in counts]

    # Shapes of arrays to which messages may refer.
    _shapes: Shapes = NO_SHAPES

    _message_function = ""

    def _read_message(self, pointer: ctypes.c_void_p) -> str:
        message = ctypes.create_string_buffer(MESSAGE_LENGTH + 1)
        function(self._message_function)(pointer, message, MESSAGE_LENGTH + 1)
        return message.value.decode(errors="replace")


def new_handle(
    name: str, create: str, free: str, *arguments: Any, needs: Sequence[Handle] = (), shapes: Shapes = NO_SHAPES
) -> Handle:
    """Call `create` with `arguments`, followed by the address of the handle, message and len."""
    handle = Handle(name, free, ctypes.c_void_p())
    for other in needs:
        handle.need(other)
    call(create, *arguments, ctypes.byref(handle.pointer), shapes=shapes)
    return handle


def _keep(exception: BaseException) -> int:
    _pending.exception = exception
    return 1


def _read_only(address: Any, n: int) -> NDArray[np.float64]:
    """A copy of an array of the library, whose memory may be freed after the call.

    It is read-only, so that a callback fails if it tries to change the numbers of the library.
    """
    values = np.array(np.ctypeslib.as_array(address, (n,)))
    values.flags.writeable = False
    return values


def product_callback(apply: Callable[[NDArray[np.float64]], Any]) -> Any:
    """A C function that calls ``apply(forces)`` and checks what it returns."""

    def called(n: int, f: Any, u: Any, user: Any) -> int:
        try:
            _check_interrupt()
            result = apply(_read_only(f, n))
            np.ctypeslib.as_array(u, (n,))[:] = vector("the result of the operator's function", result, n)
            return 0
        except BaseException as exception:
            return _keep(exception)

    return CALLBACKS["fuge_apply"](called)


def progress_callback(progress: Callable[[int, float, int], Any] | None) -> Any:
    """A C function that calls ``progress(iteration, residual, contacts)``.

    Without a function it only lets Python see Ctrl-C.
    """

    def called(iteration: int, residual: float, contacts: int, user: Any) -> int:
        try:
            _check_interrupt()
            return 1 if progress is not None and progress(iteration, residual, contacts) else 0
        except BaseException as exception:
            return _keep(exception)

    return CALLBACKS["fuge_progress"](called)


def profile_callback(profile: Callable[[NDArray[np.float64]], Any]) -> Any:
    """A C function that calls ``gap, slope = profile(x)``."""

    def called(n: int, x: Any, gap: Any, slope: Any, user: Any) -> int:
        try:
            _check_interrupt()
            values = profile(_read_only(x, n))
            if not (isinstance(values, (tuple, list)) and len(values) == 2):
                raise TypeError("the profile has to return two arrays, gap and slope")
            for place, value in zip((gap, slope), values):
                np.ctypeslib.as_array(place, (n,))[:] = doubles("the result of the profile", value)
            return 0
        except BaseException as exception:
            return _keep(exception)

    return CALLBACKS["fuge_smooth_profile"](called)


def gap_callback(gap: Callable[..., Any], coordinates: int) -> Any:
    """A C function that calls ``gap(x)`` or ``gap(x, y)``, for one or two coordinates."""

    def called(n: int, x: Any, y: Any, values: Any, user: Any) -> int:
        try:
            _check_interrupt()
            places = (_read_only(array, n) for array in (x, y)[:coordinates])
            np.ctypeslib.as_array(values, (n,))[:] = doubles("the result of the gap function", gap(*places))
            return 0
        except BaseException as exception:
            return _keep(exception)

    return CALLBACKS["fuge_gap_function"](called)
