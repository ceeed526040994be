"""The master as an object: sockets, life and death."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import random
import uuid
import warnings
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Self

from aioros1._public import public
from aioros1.master.api import MasterApi
from aioros1.master.notifier import Notifier
from aioros1.master.parameters import ParameterTree, ParamUpdate
from aioros1.master.registry import Answer, Registry
from aioros1.names import resolve_from
from aioros1.net.allow import AllowList, parse_address
from aioros1.net.hosts import (
    advertised_host,
    bind_address_for,
    every_interface,
    is_wildcard,
    local_address_facing,
    resolve,
    uri_host,
)
from aioros1.net.loop_state import LoopState, loop_state
from aioros1.options import Limits, Timeouts
from aioros1.wire.xmlrpc import decode_response, encode_response
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.server import Reply, XmlRpcServer

__all__ = ["DEFAULT_PORT", "Master", "MasterStats"]

DEFAULT_PORT = 11311

_LOG = logging.getLogger("aioros1.master")

# What roscore sets, and roslaunch and roswtf look for; the values are the output of
# commands there, hence the line ends. The version is that of the master we answer like.
_ROSCORE_PARAMS = {"/rosdistro": "noetic\n", "/rosversion": "1.15.15\n"}


@public
@dataclass(frozen=True, slots=True)
class MasterStats:
    """What the port of a master has counted."""

    connections: int
    """Connections that are open."""
    connections_refused: int
    """Connections closed at once because there were too many: ``xmlrpc_connections`` and
    ``connections_per_host`` of ``limits``."""
    connections_forbidden: int
    """Connections closed at once because their address is not in ``allow``."""
    requests_delayed: int
    """Requests that had to wait for ``limits.requests_per_second``."""


@public
class Master:
    """A ROS master with its parameter server, in the running event loop.

    ::

        async with Master(port=0) as master:
            print(master.uri)

    ``host`` is what the master tells others to reach it by, and decides where it listens:
    with ``"localhost"`` or a numeric loopback address only there, else on every interface
    (IPv6 as well if it is a numeric IPv6 address). By default it is ``ROS_HOSTNAME``, then
    ``ROS_IP``, then ``bind``, then this machine's address on the default route, then
    ``localhost``. ``bind`` is a numeric address to listen on, if that is to be another one.

    ``allow`` names the networks from which connections are taken (``["127.0.0.0/8",
    "10.0.0.5"]``), of all others none. All nodes have to be in one of them, and so has
    this machine, since the node ``/rosout`` is a node like others. There is no other access
    control in ROS 1: on a network that is not trusted, use ``"localhost"``.

    ``port`` 0 takes a free one. ``params`` are parameters to begin with, beside ``/run_id``,
    ``/rosdistro`` and ``/rosversion``, which are set as roscore does; values that no
    parameter can have raise as :func:`.encode_call` says.

    ``rosout`` adds the node ``/rosout``, which relays what all nodes log to
    ``/rosout_agg``, as roscore does.

    A request to shut down, which anybody may send, is answered and then obeyed.

    Raises :class:`ValueError` for networks in ``allow`` that are none.
    """

    def __init__(
        self,
        host: str | None = None,
        port: int = DEFAULT_PORT,
        *,
        bind: str | None = None,
        allow: Collection[str] | None = None,
        params: Mapping[str, Any] | None = None,
        rosout: bool = True,
        timeouts: Timeouts | None = None,
        limits: Limits | None = None,
    ) -> None:
        self._limits = limits = limits if limits is not None else Limits()
        self._allow = AllowList(allow)
        self._bind = bind
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
            document = encode_response(value, what=f"parameter {key}")
            value = decode_response(document, max_values=limits.xmlrpc_values)
            self._parameters.set(resolve_from(key, "/"), value)
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
        self._server = XmlRpcServer(self._api.methods(), limits=limits, allow=self._allow, log=_LOG)
        # What ends with the master, in reverse order; whatever else is to live as long as
        # it does, such as the aggregator of /rosout, is put on top in start().
        self._stack = contextlib.AsyncExitStack()
        self._started = False
        self._loop_state: LoopState | None = None  # of the loop that it is started in
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

    @property
    def stats(self) -> MasterStats:
        """Who was let in since the start, and who was not."""
        door = self._server.admission
        return MasterStats(door.open, door.refused, door.forbidden, self._server.delayed)

    async def start(self) -> None:
        """Begin to serve.

        Raises :class:`OSError` when the address or the port is not to be had, and
        :class:`ValueError` when ``bind`` is no address, or ``allow`` leaves out this machine
        while the node ``/rosout`` is wanted.
        """
        if self._started:
            raise RuntimeError("a master is started once")
        self._started = True
        self._loop_state = loop_state()
        try:
            await self._start()
        except BaseException:
            await self.close()
            raise

    async def _start(self) -> None:
        host, bind = self._host, self._bind
        if host is not None and is_wildcard(host):  # where to listen, and nothing to tell others
            host, bind = None, bind or host
        told = bind if bind and not is_wildcard(bind) else None
        host = host or advertised_host(bound=told)
        # A network without a gateway, of a robot perhaps, has nothing to tell. Those who know
        # the way to this machine find the master all the same, and need not be told.
        advertised = host or "localhost"
        bind = bind or (bind_address_for(host) if host else every_interface(advertised))
        if self._rosout:
            await self._check_that_rosout_is_allowed(advertised)
        self._stack.push_async_callback(self._client.close)
        self._stack.push_async_callback(self._notifier.close)
        self._stack.push_async_callback(self._server.close)
        await self._server.start(bind, self._port)
        self._uri = self._api.uri = f"http://{uri_host(advertised)}:{self._server.port}/"
        if self._rosout:
            # Imported here: it is a node, and those who only want a master have none.
            from aioros1.master.rosout_aggregator import RosoutAggregator

            aggregator = RosoutAggregator(
                *(self._uri, advertised),
                bind=bind,
                allow=self._allow.networks,
                limits=self._limits,
            )
            self._stack.push_async_callback(aggregator.close)
            await aggregator.start()
        _LOG.info("master at %s, run id %s", self._uri, self._run_id)

    async def _check_that_rosout_is_allowed(self, host: str) -> None:
        """It is at ``host``, as the master is, and each of them calls the other."""
        if self._allow.networks is None:
            return
        try:
            _, address = (await resolve(host))[0]
            own = parse_address(local_address_facing(address))
        except OSError:
            return  # the start itself will say so
        if own not in self._allow:
            raise ValueError(
                f"allow: the node /rosout of this master connects from {own}, "
                f"which is not in {', '.join(self._allow.networks) or 'the empty list'}: "
                "add it, or do without the node (rosout=False)"
            )

    async def close(self) -> None:
        """Stop serving and free everything; idempotent. The nodes are not told: they
        outlive their master, and register again with the next.

        Raises :class:`RuntimeError` in another thread or event loop than the master's.
        """
        if self._loop_state is not None:
            self._loop_state.check_thread("Master.close()")
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

    def __repr__(self) -> str:
        state = "open" if self.is_open else "closed" if self._closing is not None else "new"
        return f"<Master at {self._uri or f'port {self._port}'}, {state}>"

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
