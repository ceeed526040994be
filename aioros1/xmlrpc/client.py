"""An XML-RPC client for masters and nodes, with keep-alive connections.

The servers of ROS 1 need a Content-Length and no chunked body, and the path ``/RPC2`` if the
URI has none. Some of their answers are not XML-RPC.
"""

from __future__ import annotations

import math
from asyncio import _get_running_loop
from typing import Any

from aioros1.errors import ClosedError
from aioros1.net.http_client import HttpClient, server_at
from aioros1.net.loop_state import LoopState, loop_state
from aioros1.options import Limits, Timeouts
from aioros1.waiting import Deadlines
from aioros1.wire.http import HttpError
from aioros1.wire.xmlrpc import XmlRpcError, decode_response, encode_call

__all__ = ["XmlRpcClient"]


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
        if _get_running_loop() is not self._loop_state.loop:
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
