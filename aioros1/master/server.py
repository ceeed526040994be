"""The master as an object: sockets, life and death."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import random
import uuid
import warnings
from collections.abc import Mapping
from types import TracebackType
from typing import Any, Self

from aioros1.master.api import MasterApi
from aioros1.master.notifier import Notifier
from aioros1.master.parameters import ParameterTree, ParamUpdate
from aioros1.master.registry import Answer, Registry
from aioros1.names import resolve_from
from aioros1.net.hosts import advertised_host, bind_address_for, uri_host
from aioros1.net.xmlrpc_client import XmlRpcClient
from aioros1.net.xmlrpc_server import Reply, XmlRpcServer
from aioros1.options import Limits, Timeouts
from aioros1.wire.xmlrpc import decode_response, encode_response

__all__ = ["DEFAULT_PORT", "Master"]

DEFAULT_PORT = 11311

_LOG = logging.getLogger("aioros1.master")

# What roscore sets, and roslaunch and roswtf look for; the values are the output of
# commands there, hence the line ends. The version is that of the master we answer like.
_ROSCORE_PARAMS = {"/rosdistro": "noetic\n", "/rosversion": "1.15.15\n"}


class Master:
    """A ROS master with its parameter server, in the running event loop.

    ::

        async with Master(port=0) as master:
            print(master.uri)

    ``host`` is what the master tells others to reach it by, and decides where it listens:
    with ``"localhost"`` or a numeric loopback address only there, else on every interface
    (IPv6 as well if it is a numeric IPv6 address). By default it is ``ROS_HOSTNAME``, then
    ``ROS_IP``, then this machine's address on the default route, then ``localhost``. There
    is no access control in ROS 1: on a network that is not trusted, use ``"localhost"``.

    ``port`` 0 takes a free one. ``params`` are parameters to begin with, beside ``/run_id``,
    ``/rosdistro`` and ``/rosversion``, which are set as roscore does; values that no
    parameter can have raise as :func:`.encode_call` says.

    ``rosout`` adds the node ``/rosout``, which relays what all nodes log to
    ``/rosout_agg``, as roscore does.

    A request to shut down, which anybody may send, is answered and then obeyed.
    """

    def __init__(
        self,
        host: str | None = None,
        port: int = DEFAULT_PORT,
        *,
        params: Mapping[str, Any] | None = None,
        rosout: bool = True,
        timeouts: Timeouts | None = None,
        limits: Limits | None = None,
    ) -> None:
        limits = limits if limits is not None else Limits()
        self._host = host
        self._port = port
        self._rosout = rosout
        self._uri = ""
        self._run_id = _new_run_id()
        self._registry = Registry()
        # One level of an answer is the triple around the value.
        self._parameters = ParameterTree(max_depth=limits.xmlrpc_depth - 1)
        given = {"/run_id": self._run_id, **_ROSCORE_PARAMS, **(params or {})}
        for key, value in given.items():
            # There and back: checked, copied, and of the types a node would have sent.
            self._parameters.set(resolve_from(key, "/"), decode_response(encode_response(value)))
        self._client = XmlRpcClient(timeouts=timeouts, limits=limits)
        self._notifier = Notifier(
            self._client,
            is_registered=self._registry.knows_api,
            on_unwanted=self._unwanted,
        )
        self._api = MasterApi(
            self._registry,
            self._parameters,
            notify=self._notifier.send,
            shutdown=self._answer_shutdown,
        )
        self._server = XmlRpcServer(self._api.methods(), limits=limits, log=_LOG)
        # What ends with the master, in reverse order; whatever else is to live as long as
        # it does, such as the aggregator of /rosout, is put on top in start().
        self._stack = contextlib.AsyncExitStack()
        self._started = False
        self._closing: asyncio.Task[None] | None = None
        self._reason = ""
        self._closed = asyncio.Event()

    @property
    def uri(self) -> str:
        """What to set ``ROS_MASTER_URI`` to; empty before the start."""
        return self._uri

    @property
    def port(self) -> int:
        """The TCP port; before the start, the one asked for."""
        return self._server.port or self._port

    @property
    def run_id(self) -> str:
        """The value of ``/run_id`` at the start: what tells one run of a master from
        another."""
        return self._run_id

    @property
    def is_open(self) -> bool:
        """Whether the master serves."""
        return bool(self._uri) and self._closing is None

    async def start(self) -> None:
        """Begin to serve. Raises :class:`OSError` when the port is taken."""
        if self._started:
            raise RuntimeError("a master is started once")
        self._started = True
        if self._host in ("0.0.0.0", "::"):  # where to listen, and nothing to tell others
            bind, advertised = self._host, advertised_host()
        else:
            advertised = self._host or advertised_host()
            bind = bind_address_for(advertised)
        await self._server.start(bind, self._port)
        self._stack.push_async_callback(self._client.close)
        self._stack.push_async_callback(self._notifier.close)
        self._stack.push_async_callback(self._server.close)
        self._uri = self._api.uri = f"http://{uri_host(advertised)}:{self._server.port}/"
        if self._rosout:
            # Imported here: it is a node, and those who only want a master have none.
            from aioros1.master.rosout_aggregator import RosoutAggregator

            aggregator = RosoutAggregator(self._uri, advertised)
            self._stack.push_async_callback(aggregator.close)
            await aggregator.start()
        _LOG.info("master at %s, run id %s", self._uri, self._run_id)

    async def close(self) -> None:
        """Stop serving and free everything; idempotent. The nodes are not told: they
        outlive their master, and register again with the next."""
        await asyncio.shield(self._begin_to_close("closed"))

    async def wait_closed(self) -> str:
        """Wait until the master has ended, be it by :meth:`close` or by a request from
        outside; returns the reason."""
        await self._closed.wait()
        return self._reason

    async def __aenter__(self) -> Self:
        await self.start()
        return self

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    def __del__(self) -> None:
        if getattr(self, "_uri", "") and self._closing is None:
            warnings.warn(
                f"unclosed master {self._uri}", ResourceWarning, source=self, stacklevel=2
            )

    def _answer_shutdown(self, reason: str, answer: Answer) -> Reply:
        return Reply(answer, after=lambda: self._begin_to_close(reason))

    def _begin_to_close(self, reason: str) -> asyncio.Task[None]:
        # A task of its own: a request to shut down must not wait for its own end, and
        # whoever closes may be cancelled meanwhile.
        if self._closing is None:
            self._reason = reason
            self._closing = asyncio.create_task(self._close(), name="aioros1-master-close")
        return self._closing

    async def _close(self) -> None:
        try:
            await self._stack.aclose()
        finally:
            _LOG.info("master at %s has ended: %s", self._uri, self._reason)
            self._closed.set()

    def _unwanted(self, update: ParamUpdate) -> None:
        """A node does not know the parameter it was told of.

        Only a subscription to that very key is ended: a rospy node answers so as well for
        a new key below one that it does follow.
        """
        self._registry.unregister_param_subscriber(update.caller_id, update.key, update.api)


def _new_run_id() -> str:
    # A time-based UUID, as roslaunch makes them, but of random bits where those have the
    # hardware address of the machine, which is nobody's business and slow to find out.
    node = random.getrandbits(48) | 1 << 40
    return str(uuid.uuid1(node=node, clock_seq=random.getrandbits(14)))
