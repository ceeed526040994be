"""Calling masters and nodes: an XML-RPC client, and the answers ``[code, status, value]``.

The servers of ROS 1 need a Content-Length and no chunked body, and the path ``/RPC2`` if the
URI has none. Some of their answers are not XML-RPC.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from threading import get_ident
from typing import Any, TypeVar

from aioros1.errors import ClosedError, MasterError, MasterUnreachable, PeerError, PeerUnreachable
from aioros1.net.http_client import HttpClient, server_at
from aioros1.net.loop_state import LoopState, loop_state
from aioros1.options import Limits, Timeouts
from aioros1.waiting import Deadlines
from aioros1.wire.http import HttpError
from aioros1.wire.xmlrpc import XmlRpcError, XmlRpcFault, decode_response, encode_call

__all__ = ["XmlRpcClient", "as_it_is", "call_triple"]

T = TypeVar("T")


class XmlRpcClient:
    """Calls methods of XML-RPC servers. You can create it outside an event loop."""

    def __init__(self, *, timeouts: Timeouts | None = None, limits: Limits | None = None) -> None:
        self._timeouts = timeouts if timeouts is not None else Timeouts()
        self._limits = limits if limits is not None else Limits()
        self._http = HttpClient(max_bytes=self._limits.xmlrpc_bytes)
        self._deadlines = Deadlines()  # of the calls in progress
        self._closed = False
        self._loop_state: LoopState | None = None  # of the loop of the first call

    async def call(self, uri: str, method: str, *params: Any, timeout: float | None = None) -> Any:
        """Call ``method(*params)`` at ``uri`` and return the answer, whatever it is.

        ``timeout`` limits the whole call, in seconds; the default is ``Timeouts.xmlrpc``,
        and ``math.inf`` means no limit. Raises

        - :class:`TimeoutError` after that time,
        - :class:`ConnectionError` if the server cannot be reached, and
          :class:`ConnectionResetError` if the connection is lost before the answer,
        - :class:`.XmlRpcFault` if the server answers with a fault,
        - :class:`.XmlRpcError` if the answer is not XML-RPC, or too large,
        - :class:`TypeError`, :class:`ValueError` or :class:`OverflowError` for parameters
          that cannot be sent (see :func:`.encode_call`), before anything is sent,
        - :class:`~aioros1.ClosedError` after :meth:`close`,
        - :class:`RuntimeError` in another thread than the first call.
        """
        body = encode_call(method, params, max_depth=self._limits.xmlrpc_depth)
        if self._closed:
            raise ClosedError("the XML-RPC client is closed")
        if self._loop_state is None:
            self._loop_state = loop_state()
        if get_ident() != self._loop_state.thread_id:
            self._loop_state.check_thread(method)
        try:
            server = server_at(uri)
        except ValueError:
            raise ConnectionError(
                f"{uri!r} is not the URI of a ROS node or master (http://host:port/)"
            ) from None
        seconds = self._timeouts.xmlrpc if timeout is None else timeout
        try:
            async with self._deadlines.limit(None if seconds == math.inf else seconds, "no answer"):
                answer = await self._http.post(server, body)
            if answer.status != 200:
                raise XmlRpcError(f"HTTP status {answer.status} {answer.reason}")
            limits = self._limits
            return decode_response(
                answer.body, max_depth=limits.xmlrpc_depth, max_values=limits.xmlrpc_values
            )
        except TimeoutError as error:
            if self._closed:
                raise ConnectionAbortedError(f"{method} at {uri}: the client was closed") from None
            raise TimeoutError(f"{method} at {uri}: {error}") from None
        except ConnectionResetError as error:
            raise ConnectionResetError(f"{method} at {uri}: {error}") from error
        except ConnectionError as error:
            raise ConnectionError(f"{method} at {uri}: {error}") from error
        except (HttpError, XmlRpcError) as error:
            raise XmlRpcError(f"{method} at {uri}: {error}") from None

    def close_idle(self) -> None:
        """Close the connections that are idle now, because they may all be dead."""
        self._http.close_idle()

    async def close(self) -> None:
        """Close every connection. Calls in progress fail with :class:`ConnectionError`."""
        self._closed = True
        self._deadlines.expire()
        await self._deadlines.wait_ended()
        await self._http.close()


def _whole(code: float) -> int:
    """A code as an int. Python compares it with 1, and so takes bools and doubles."""
    return int(code) if math.isfinite(code) else -1


def as_it_is(value: Any) -> Any:
    """What reads an answer that nothing is to be made of."""
    return value


async def call_triple(
    client: XmlRpcClient,
    uri: str,
    method: str,
    params: tuple[Any, ...],
    refused: type[MasterError] | type[PeerError],
    unreachable: type[MasterUnreachable] | type[PeerUnreachable],
    *,
    bare: bool = False,
    read: Callable[[Any], T] = as_it_is,
    timeout: float | None = None,
) -> T:
    """Call a method and return what ``read`` makes of the value of its answer.

    Raises ``refused`` for any code but 1, for a fault and for an answer that is not a
    triple or that ``read`` cannot read; ``unreachable`` when there is no answer. With
    ``bare`` an answer need not be a triple: roscpp answers ``getBusStats`` so. What follows
    the value is not looked at, and a value that is missing is 0, as for roscpp.
    """
    try:
        answer = await client.call(uri, method, *params, timeout=timeout)
    except XmlRpcFault as fault:
        what = f"{method} at {uri}: {fault.text}"
        raise refused(fault.code, what, is_refusal=False) from fault
    except XmlRpcError as error:
        whose = "master" if refused is MasterError else "node"
        what = f"{error}; expected the answer of a ROS {whose}"
        raise refused(-1, what, is_refusal=False) from error
    except (OSError, TimeoutError) as error:
        raise unreachable(str(error)) from error
    except ClosedError as error:  # the client is closed, and with it its node
        raise ClosedError(f"{method} at {uri}: {error}") from error
    if isinstance(answer, list) and len(answer) >= 2 and isinstance(answer[0], (int, float)):
        code, status, value = (*answer, 0)[:3]
        if code != 1:
            raise refused(_whole(code), f"{method} at {uri}: {status}")
    elif bare:
        value = answer
    else:
        what = f"{method} at {uri}: expected [code, status, value], got {answer!r:.200}"
        raise refused(-1, what, is_refusal=False)
    try:
        return read(value)
    except (TypeError, ValueError, LookupError, AttributeError) as error:
        what = f"{method} at {uri}: cannot read {value!r:.200}: {error}"
        raise refused(-1, what, is_refusal=False) from error
