"""A service call that waits for your answer."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from typing import Any, Generic, TypeVar

from aioros1._public import public
from aioros1.errors import ClosedError, SerializationError, ServiceError
from aioros1.idl.genpy_types import GenpyMessage
from aioros1.quoting import printable
from aioros1.services.side import Side

__all__ = ["ServiceCall"]

Q = TypeVar("Q")
A = TypeVar("A")


@public
class ServiceCall(Generic[Q, A]):
    """A call that waits for your answer; an item of ``async for call in provider``."""

    __slots__ = ("_answer", "_closed", "_service", "_side", "header", "request")

    def __init__(self, service: str, request: Q, header: Mapping[str, str], side: Side) -> None:
        self.request = request
        """The request; bytes for a raw provider."""
        self.header = header
        """The caller's connection header; ``header["callerid"]`` is its name."""
        self._service = service
        self._side = side
        # An error is stored as a result, because the caller may be gone and never await it.
        self._answer: asyncio.Future[bytes | ServiceError] = (
            asyncio.get_running_loop().create_future()
        )
        self._closed: ClosedError | None = None

    @property
    def caller_id(self) -> str:
        """The name of the calling node."""
        return self.header["callerid"]

    async def reply(
        self, response: A | GenpyMessage | Mapping[str, Any] | None = None, /, **fields: Any
    ) -> None:
        """Answer with a response, a dict of its fields, or its ``fields``; with bytes for a
        raw provider.

        Raises :class:`~aioros1.SerializationError` for values that do not fit; the call
        then still waits. Raises :class:`~aioros1.ClosedError` once the provider is closed,
        which answers the call itself, and :class:`RuntimeError` for a second answer. You may
        answer a call whose caller is gone.
        """
        side = self._side
        try:
            answer = side.frame(side.outgoing(response, fields))
        except SerializationError as error:
            raise error.locate(side.outgoing_type, f"from {self._service}")  # noqa: B904 - the same
        self._settle(answer)

    async def fail(self, text: str) -> None:
        """Answer that the call failed; the caller gets ``text``."""
        self._settle(ServiceError(text))

    def _settle(self, answer: bytes | ServiceError) -> None:
        if self._answer.done():
            raise self._closed or RuntimeError("the call is answered already")
        self._answer.set_result(answer)

    def _close(self, error: ClosedError) -> None:
        if not self._answer.done():
            self._closed = error
            self._answer.set_result(ServiceError("the service is shut down"))

    def __repr__(self) -> str:
        state = "answered" if self._answer.done() else "waits for an answer"
        return f"<ServiceCall of {printable(self.caller_id)}, {state}>"
