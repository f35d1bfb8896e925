"""Frames between the service and a worker process: pickled calls and results. For any thread.

Both ends are the same program with the same code, started by the service itself; nothing that a client sent
is ever unpickled.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable
from struct import Struct
from types import MappingProxyType
from typing import Any, Final

LENGTH: Final = Struct(">Q")
"""The length of a frame in bytes, before it."""


SHARE: Final = Struct(">d")
"""How much of a call is done: what follows a length of 0 among the answers."""


class NotTransferableError(Exception):
    """A call that cannot be pickled, such as one of a function inside another."""


def pack_call(function: Callable[..., Any], arguments: tuple[Any, ...]) -> bytes:
    """A call as a frame's content. Raises `NotTransferableError`."""
    try:
        return pickle.dumps((function, arguments), pickle.HIGHEST_PROTOCOL)
    except (pickle.PicklingError, TypeError, AttributeError) as error:
        raise NotTransferableError(str(error)) from error


def run_call(packed: bytes) -> bytes:
    """Run a packed call; its result, or what it raised, as a frame's content."""
    try:
        function, arguments = pickle.loads(packed)
        return pickle.dumps((True, function(*arguments)), pickle.HIGHEST_PROTOCOL)
    except Exception as error:
        return _pack_error(error)


def unpack_result(packed: bytes) -> Any:
    """The result of a call. Raises what the call raised."""
    done, value = pickle.loads(packed)
    if done:
        return value
    raise _error(*value)


def _pack_error(error: Exception) -> bytes:
    # By its parts: most problems are made of more than `args`, which is all that pickle hands to `__init__`.
    parts = {key: _plain(value) for key, value in error.__dict__.items()}
    try:
        return pickle.dumps((False, (type(error), error.args, parts)), pickle.HIGHEST_PROTOCOL)
    except Exception:
        return pickle.dumps((False, (RuntimeError, (repr(error),), {})), pickle.HIGHEST_PROTOCOL)


def _plain(value: Any) -> Any:
    return dict(value) if isinstance(value, MappingProxyType) else value


def _error(kind: type[Exception], args: tuple[Any, ...], parts: dict[str, Any]) -> Exception:
    error = kind.__new__(kind)
    error.args = args
    error.__dict__.update(parts)
    return error
