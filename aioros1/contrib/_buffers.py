"""What the helpers for NumPy have in common: messages that fit, and the bytes inside."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["as_uint8", "bytes_of", "check_message", "describe_array"]


def check_message(message: object, *types: str) -> object:
    """Return a message of one of the types, ours or genpy's; :class:`TypeError` otherwise."""
    kind = getattr(message, "_type", None)
    if isinstance(message, type) or kind not in types:
        what = f"a {kind}" if isinstance(kind, str) else repr(message)[:200]
        if isinstance(message, type):
            what = f"the class {message.__name__}"
        raise TypeError(f"expected a {' or '.join(types)}, got {what}")
    return message


def as_uint8(data: Any, place: str) -> NDArray[np.uint8]:
    """The bytes of a ``uint8[]`` field as an array, without a copy if it is a buffer."""
    try:
        if isinstance(data, (list, tuple)):
            return np.frombuffer(bytes(data), np.uint8)
        view = memoryview(data)
        if view.nbytes and not view.c_contiguous:
            view = memoryview(view.tobytes())
        return np.frombuffer(view.cast("B") if view.nbytes else b"", np.uint8)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{place}: expected bytes, got {data!r:.200} ({error})") from None


def bytes_of(array: NDArray[Any], *, copy: bool) -> Any:
    """The bytes of a contiguous array for a ``uint8[]`` field: a view, or a copy."""
    return array.tobytes() if copy or not array.size else array.reshape(-1).view(np.uint8).data


def describe_array(array: NDArray[Any]) -> str:
    """The dtype and the shape of an array, for an error."""
    return f"{array.dtype} of shape {array.shape}"
