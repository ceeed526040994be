"""Calling masters and nodes: an XML-RPC client, and the answers ``[code, status, value]``.

The servers of ROS 1 need a Content-Length and no chunked body, and the path ``/RPC2`` if the
URI has none. Some of their answers are not XML-RPC.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator
from threading import get_ident
from typing import Any, TypeVar

from aioros1.errors import ClosedError, MasterError, PeerError
from aioros1.net.http_client import HttpClient, server_at
from aioros1.net.loop_state import LoopState, loop_state
from aioros1.net.turns import Turn
from aioros1.options import Limits, Timeouts
from aioros1.quoting import printable
from aioros1.waiting import Deadlines
from aioros1.wire.http import HttpError
from aioros1.wire.xmlrpc import (
    PIECE,
    XmlRpcError,
    XmlRpcFault,
    call_pieces,
    decode_response,
    decoding_response,
)
from aioros1.wire.xmlrpc_scalars import brief

__all__ = [
    "SHORT_ANSWER",
    "HttpStatusError",
    "XmlRpcClient",
    "as_it_is",
    "call_triple",
    "is_judgement",
]

SHORT_ANSWER = 64 << 10
"""Bytes of an answer that has a few words, from a node that anybody may have registered."""

T = TypeVar("T")


class HttpStatusError(XmlRpcError):
    """A server answered with an HTTP ``status`` other than 200."""

    def __init__(self, text: str, status: int) -> None:
        super().__init__(text)
        self.status = status


class XmlRpcClient:
    """Calls methods of XML-RPC servers. You can create it outside an event loop."""

    def __init__(self, *, timeouts: Timeouts | None = None, limits: Limits | None = None) -> None:
        self._timeouts = timeouts if timeouts is not None else Timeouts()
        self._limits = limits if limits is not None else Limits()
        self._http = HttpClient(max_bytes=self._limits.xmlrpc_bytes)
        self._deadlines = Deadlines()  # of the calls in progress
        self._closed = False
        self._loop_state: LoopState | None = None  # of the loop of the first call

    async def call(
        self,
        uri: str,
        method: str,
        *params: Any,
        timeout: float | None = None,
        any_path: bool = False,
        body: bytes | None = None,
        max_bytes: int | None = None,
    ) -> Any:
        """Call ``method(*params)`` at ``uri`` and return the answer, whatever it is.

        Requests go to the path ``/RPC2`` or ``/``, whatever ``uri`` says, unless you pass
        ``any_path``; see :func:`.server_at`. ``body`` is what :meth:`encode` returned, to be
        sent in place of ``params``. An answer has at most ``max_bytes``, if that is less than
        ``limits.xmlrpc_bytes``.

        ``timeout`` limits the whole call, in seconds; the default is ``Timeouts.xmlrpc``,
        and ``math.inf`` means no limit. Calls without a limit do not count in the number of
        connections to one server: each could hold one for ever. Their number is up to the
        caller. Raises

        - :class:`TimeoutError` after that time,
        - :class:`ConnectionError` if the server cannot be reached, and
          :class:`ConnectionResetError` if the connection is lost before the answer,
        - :class:`.XmlRpcFault` if the server answers with a fault,
        - :class:`.XmlRpcError` if the answer is not XML-RPC, or too large;
          :class:`.HttpStatusError` if it has an HTTP status other than 200,
        - :class:`TypeError`, :class:`ValueError` or :class:`OverflowError` for parameters
          that cannot be sent (see :func:`.encode_call`), before anything is sent,
        - :class:`~aioros1.ClosedError` after :meth:`close`,
        - :class:`RuntimeError` in another thread than the first call.
        """
        if body is None:
            body = await self.encode(method, *params)
        if self._closed:
            raise ClosedError("the XML-RPC client is closed")
        state = self._loop_state
        if state is None:
            state = self._loop_state = loop_state()
        if get_ident() != state.thread_id:
            state.check_thread(method)
        try:
            server = server_at(uri, any_path=any_path)
        except ValueError:
            raise ConnectionError(
                f"{printable(uri)!r} is not the URI of a ROS node or master (http://host:port/)"
            ) from None
        seconds = self._timeouts.xmlrpc if timeout is None else timeout
        limit = None if seconds == math.inf else seconds
        try:
            async with self._deadlines.limit(limit, "no answer"):
                answer = await self._http.post(
                    server, body, counts=limit is not None, max_bytes=max_bytes
                )
            if answer.status != 200:
                what = f"HTTP status {answer.status} {answer.reason}"
                raise HttpStatusError(what, answer.status)
            depth, values = self._limits.xmlrpc_depth, self._limits.xmlrpc_values
            if len(answer.body) <= PIECE:
                return decode_response(answer.body, max_depth=depth, max_values=values)
            steps = decoding_response((answer.body,), max_depth=depth, max_values=values)
            return await Turn(state.turns).run(steps)
        except TimeoutError as error:
            if self._closed:
                raise ConnectionAbortedError(
                    f"{_place(method, uri)}: the client was closed"
                ) from None
            raise TimeoutError(f"{_place(method, uri)}: {error}") from None
        except ConnectionResetError as error:
            raise ConnectionResetError(f"{_place(method, uri)}: {error}") from None
        except ConnectionError as error:
            raise ConnectionError(f"{_place(method, uri)}: {error}") from None
        except HttpStatusError as error:
            what = f"{_place(method, uri)}: {printable(error)}"
            raise HttpStatusError(what, error.status) from None
        except (HttpError, XmlRpcError) as error:
            raise XmlRpcError(f"{_place(method, uri)}: {printable(error)}") from None

    def losses(self, uri: str) -> int:
        """How many kept connections to the server at ``uri`` were lost, as far as it is known.

        Servers keep connections while they live, so a loss may mean that another one has taken
        the place of this one.
        """
        try:
            return self._http.losses(server_at(uri))
        except ValueError:
            return 0

    async def encode(self, method: str, *params: Any) -> bytes:
        """Make the document of a call, which :meth:`call` takes as its ``body``.

        Large ones take long; others run meanwhile. Raises as :func:`.encode_call` does.
        """
        pieces = call_pieces(method, params, max_depth=self._limits.xmlrpc_depth)
        document = next(pieces)
        more = next(pieces, None)
        if more is None:
            return document
        found = [document, more]
        await Turn(loop_state().turns).run(_appending(found, pieces))
        return b"".join(found)

    def close_idle(self) -> None:
        """Close the connections that are idle now, because they may all be dead."""
        self._http.close_idle()

    async def close(self) -> None:
        """Close every connection. Calls in progress fail with :class:`ConnectionError`."""
        self._closed = True
        self._deadlines.expire()
        await self._deadlines.wait_ended()
        await self._http.close()


def is_judgement(error: MasterError | PeerError) -> bool:
    """Whether the other side has judged the request: it refused, or raised a fault."""
    return error.is_refusal or error.is_fault


def _appending(found: list[bytes], pieces: Iterator[bytes]) -> Generator[None, None, None]:
    for piece in pieces:
        found.append(piece)
        yield


def _whole(code: float) -> int:
    """A code as an int. Python compares it with 1, and so takes bools and doubles."""
    return int(code) if math.isfinite(code) else -1


def as_it_is(value: Any) -> Any:
    """What reads an answer that nothing is to be made of."""
    return value


def _place(method: str, uri: str) -> str:
    """What was asked, and where; others may have chosen the address."""
    return f"{method} at {printable(uri)}"


async def call_triple(
    client: XmlRpcClient,
    uri: str,
    method: str,
    params: tuple[Any, ...],
    refused: type[MasterError] | type[PeerError],
    unreachable: Callable[[str, OSError], MasterError | PeerError],
    *,
    bare: bool = False,
    read: Callable[[Any], T] = as_it_is,
    timeout: float | None = None,
    any_path: bool = False,
    max_bytes: int | None = None,
) -> T:
    """Call a method and return what ``read`` makes of the value of its answer.

    Raises ``refused`` for any code but 1, for a fault and for an answer that is not a
    triple or that ``read`` cannot read, and what ``unreachable(method, error)`` makes of the
    error when there is no answer. These errors say all that there is to say, and have no
    causes: what a peer wrote is quoted in them. With ``bare`` an answer need not be a triple:
    roscpp answers ``getBusStats`` so. What follows the value is not looked at, and a value
    that is missing is 0, as for roscpp.
    """
    place = _place(method, uri)
    try:
        answer = await client.call(
            uri, method, *params, timeout=timeout, any_path=any_path, max_bytes=max_bytes
        )
    except XmlRpcFault as fault:
        what = f"{place}: {printable(fault.text)}"
        raise refused(fault.code, what, is_refusal=False, is_fault=True) from None
    except XmlRpcError as error:
        whose = "master" if refused is MasterError else "node"
        what = f"{error}; expected the answer of a ROS {whose}"
        raise refused(-1, what, is_refusal=False) from None
    except OSError as error:  # a TimeoutError is one
        raise unreachable(method, error) from None
    except ClosedError as error:  # the client is closed, and with it its node
        raise ClosedError(f"{place}: {error}") from None
    if isinstance(answer, list) and len(answer) >= 2 and isinstance(answer[0], (int, float)):
        code, status, value = (*answer, 0)[:3]
        if code != 1:
            raise refused(_whole(code), f"{place}: {printable(status)}")
    elif bare:
        value = answer
    else:
        what = f"{place}: expected [code, status, value], got {_shown(answer)}"
        raise refused(-1, what, is_refusal=False)
    try:
        return read(value)
    except (TypeError, ValueError, LookupError, AttributeError) as error:
        what = f"{place}: cannot read {_shown(value)}: {printable(error)}"
        raise refused(-1, what, is_refusal=False, is_answer=True) from None


def _shown(answer: Any) -> str:
    return printable(brief(answer), 200)
