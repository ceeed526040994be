"""Codecs of the two sides of a service: requests or responses, as messages or bytes."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from aioros1.errors import SerializationError
from aioros1.idl.codec import codec_of
from aioros1.idl.message_from import message_from

if TYPE_CHECKING:
    from aioros1.idl import Service

__all__ = ["Side", "callers_side", "providers_side", "raw_side"]

_pack_length = struct.Struct("<I").pack


@dataclass(frozen=True, slots=True)
class Side:
    """The codec of one side of a service."""

    decode: Callable[[bytes, int, int], Any]
    """Decodes what lies in some bytes, from a position to an end.

    Raises :class:`~aioros1.DeserializationError`."""

    outgoing_class: type
    """The class whose instances :attr:`frame` takes directly."""

    outgoing_type: str
    """Its type, for errors."""

    frame: Callable[[Any], bytes]
    """Encodes such an instance, with its length in front."""

    outgoing: Callable[[Any, Mapping[str, Any]], Any]
    """Makes such an instance from a message, a dict or nothing, and from fields.

    Raises :class:`~aioros1.SerializationError` and :class:`TypeError`."""


def providers_side(service_class: type[Service[Any, Any]]) -> Side:
    """Requests come in, responses go out."""
    response_class = service_class._response_class
    requests, responses = codec_of(service_class._request_class), codec_of(response_class)
    outgoing = partial(message_from, response_class)
    return Side(requests.decode, response_class, response_class._type, responses.frame, outgoing)


def callers_side(service_class: type[Service[Any, Any]]) -> Side:
    """Requests go out, responses come in."""
    request_class = service_class._request_class
    requests, responses = codec_of(request_class), codec_of(service_class._response_class)
    outgoing = partial(message_from, request_class, keyword="request")
    return Side(responses.decode, request_class, request_class._type, requests.frame, outgoing)


def raw_side(what: str) -> Side:
    """Bytes come in and bytes go out, unchecked. Errors name ``what``."""

    def outgoing(value: Any, fields: Mapping[str, Any]) -> bytes:
        if value is None and not fields:
            return b""
        if fields or not isinstance(value, (bytes, bytearray, memoryview)):
            got = ", ".join(fields) if fields else repr(value)
            raise SerializationError(f"{what}: expected serialised bytes, got {got:.100}")
        return bytes(value)

    return Side(lambda data, start, stop: data[start:stop], bytes, "bytes", _frame, outgoing)


def _frame(data: bytes) -> bytes:
    return _pack_length(len(data)) + data
