"""The functions of a codec by their names, compiled for one class at a time.

The generators are imported when the first codec is compiled: a program that only reads
definitions needs none of them.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from aioros1.errors import SerializationError
from aioros1.idl.check import normalise
from aioros1.idl.structure import Structure
from aioros1.idl.values import made_later

if TYPE_CHECKING:
    from aioros1.idl.codegen_decode import Mode

__all__ = ["CODEC", "compiled"]

_pack_length = struct.Struct("<I").pack


def compiled(name: str) -> Any:
    """A class attribute that compiles a function of the codec when it is first read.

    Loading a type must not cost more than reading its definition, and few of the types
    that are loaded travel in both directions. The compiled function takes the place of
    this in the class, so that it is found without a detour from then on. Two threads may
    both compile it; each then has a whole function, and the class keeps either.
    """
    return _Compiled(name)  # Any, for it is declared as what its __get__ returns


class _Compiled:
    def __init__(self, name: str) -> None:
        self._name = name

    def __get__(self, instance: object, owner: Any) -> Callable[..., Any]:
        if not hasattr(owner, "_type"):
            raise AttributeError(f"type object {owner.__name__!r} has no attribute {self._name!r}")
        function = CODEC[self._name](owner)
        setattr(owner, self._name, staticmethod(function))
        return function


def _encoder(
    cls: type[Structure],
    slow: Callable[[Any, Exception], Any] | None = None,
    *,
    frame: bool = False,
    split: bool = False,
) -> Callable[..., Any]:
    from aioros1.idl.codegen import make_encoder

    return make_encoder(cls, slow, frame=frame, split=split)


def _encode(cls: type[Structure]) -> Callable[..., Any]:
    return _encoder(cls, _slow_path(cls))


def _frame(cls: type[Structure]) -> Callable[..., Any]:
    slow = _slow_path(cls)

    def slow_frame(message: Any, failure: Exception) -> bytes:
        body = slow(message, failure)
        return _pack_length(len(body)) + body

    return _encoder(cls, slow_frame, frame=True)


def _frame_parts(cls: type[Structure]) -> Callable[..., Any]:
    slow = _slow_path(cls)

    def slow_parts(message: Any, failure: Exception) -> list[bytes | memoryview]:
        body = slow(message, failure)
        return [_pack_length(len(body)), body]

    return _encoder(cls, slow_parts, frame=True, split=True)


def _slow_path(cls: type[Structure]) -> Callable[[Any, Exception], bytes]:
    """What encodes when the fast encoder could not: it looks at every value."""
    encode_escaped = made_later(lambda: _encoder(cls))

    def encode(message: Any, failure: Exception) -> bytes:
        octets: bytes
        if isinstance(failure, UnicodeEncodeError):
            # Most likely text that was not UTF-8 when it was received.
            try:
                octets = encode_escaped(message)
            except Exception:
                pass
            else:
                return octets
        try:
            clean = normalise(cls, message)
        except SerializationError as error:
            raise error.locate(cls._type)  # noqa: B904 - it is the same error
        try:
            octets = encode_escaped(clean)
        except Exception as exc:
            raise SerializationError(f"{cls._type}: {exc}") from exc
        return octets

    return encode


def _decoder(mode: Mode) -> Callable[[type[Structure]], Callable[..., Any]]:
    def make(cls: type[Structure]) -> Callable[..., Any]:
        from aioros1.idl.decoders import make_decoder

        return make_decoder(cls, mode)

    return make


def _from_bytes(cls: type[Structure]) -> Callable[..., Any]:
    from aioros1.idl.decoders import make_whole_decoder

    return make_whole_decoder(cls)


CODEC: Final[dict[str, Callable[[type[Structure]], Callable[..., Any]]]] = {
    "_encode": _encode,
    "_frame": _frame,
    "_frame_parts": _frame_parts,
    "_from_bytes": _from_bytes,
    "_decode": _decoder("bytes"),
    "_decode_view": _decoder("view"),
    "_decode_views": _decoder("views"),
}
"""What compiles each function, by the attribute of the class that holds it."""
