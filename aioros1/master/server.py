"""The master itself: its sockets, start and end."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import random
import uuid
import warnings
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from types import TracebackType
from typing import Any, Self

from aioros1._public import public
from aioros1.hints import explained
from aioros1.master.api import MasterApi
from aioros1.master.notifier import Notifier
from aioros1.master.parameters import ParameterTree, ParamUpdate
from aioros1.master.process_id import process_id
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
from aioros1.quoting import printable
from aioros1.wire.xmlrpc import decode_response, encode_response
from aioros1.xmlrpc.client import SHORT_ANSWER, XmlRpcClient
from aioros1.xmlrpc.server import Reply, XmlRpcServer

__all__ = ["DEFAULT_PORT", "Master", "MasterStats"]

DEFAULT_PORT = 11311

_LOG = logging.getLogger("aioros1.master")

# roscore sets these, and roslaunch and roswtf read them. There the values are the output of
# commands, hence the newlines. The version is that of the master whose answers we follow.
_ROSCORE_PARAMS = {"/rosdistro": "noetic\n", "/rosversion": "1.15.15\n"}


@public
@dataclass(frozen=True, slots=True)
class MasterStats:
    """Counters of a master's port."""

    connections: int
    """Open connections."""
    connections_refused: int
    """Connections closed at once because there were too many: ``xmlrpc_connections`` and
    ``connections_per_host`` of ``limits``."""
    connections_forbidden: int
    """Connections closed at once because their address is not in ``allow``."""
    requests_delayed: int
    """Requests that had to wait for ``limits.requests_per_second``."""
    bytes_in_flight: int = 0
    """Bytes of requests that are arriving and answers that wait to be read, which count for
    ``limits.bytes_in_flight``."""
    connections_cut: int = 0
    """Connections closed because all together held more than ``limits.bytes_in_flight``."""


@public
class Master:
    """A ROS master with its parameter server, in the running event loop.

    ::

        async with Master(port=0) as master:
            print(master.uri)

    ``host`` is the address that the master announces, and decides where it listens: only
    there for ``"localhost"`` or a numeric loopback address, else on every interface (IPv6 as
    well if it is a numeric IPv6 address). The default is ``ROS_HOSTNAME``, then ``ROS_IP``,
    then ``bind``, then this machine's address on the default route, then ``localhost``.
    ``bind`` is a numeric address to listen on instead.

    ``allow`` lists the only networks from which the master accepts connections
    (``["127.0.0.0/8", "10.0.0.5"]``). All nodes have to be in one of them, and so does this
    machine, because ``/rosout`` is a node like any other. ROS 1 has no other access control:
    on an untrusted network, use ``"localhost"``.

    ``port`` 0 takes a free one. ``params`` are initial parameters, in addition to ``/run_id``,
    ``/rosdistro`` and ``/rosversion``, which are set as roscore does; values that no
    parameter can have raise as :func:`.encode_call` says.

    ``rosout`` adds the node ``/rosout``, which relays what all nodes log to
    ``/rosout_agg``, as roscore does.

    The master answers a request to shut down, which anybody may send, and then obeys it.

    Raises :class:`ValueError` for invalid networks in ``allow``.
    """

    @explained
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
        # The triple around the value takes one level of an answer.
        self._parameters = ParameterTree(
            max_depth=limits.xmlrpc_depth - 1,
            max_bytes=limits.parameter_bytes,
            max_values=limits.parameter_values,
            max_names=limits.xmlrpc_bytes,
        )
        given = {"/run_id": self._run_id, **_ROSCORE_PARAMS, **(params or {})}
        for key, value in given.items():
            # Encode and decode: this checks and copies it, with the types a node would send.
            document = encode_response(value, what=f"parameter {key}")
            value = decode_response(document, max_values=limits.xmlrpc_values)
            self._parameters.set(resolve_from(key, "/"), value)
        # It sends notifications only, the answers to which have a few words.
        answers = replace(limits, xmlrpc_bytes=min(limits.xmlrpc_bytes, SHORT_ANSWER))
        self._client = XmlRpcClient(timeouts=timeouts, limits=answers)
        self._notifier = Notifier(
            self._client,
            is_wanted=self._registry.is_wanted,
            on_unwanted=self._unwanted,
        )
        self._api = MasterApi(
            self._registry,
            self._parameters,
            notify=self._notifier.send,
            shutdown=self._answer_shutdown,
            max_registrations=limits.registrations,
        )
        self._server = XmlRpcServer(self._api.methods(), limits=limits, allow=self._allow, log=_LOG)
        # Everything that ends with the master, in reverse order. start() adds the rest, such
        # as the aggregator of /rosout, on top.
        self._stack = contextlib.AsyncExitStack()
        self._started = False
        self._loop_state: LoopState | None = None  # of the loop in which it was started
        self._closing: asyncio.Task[None] | None = None
        self._reason = ""
        self._closed = asyncio.Event()

    @property
    def uri(self) -> str:
        """The value for ``ROS_MASTER_URI``; empty before the start."""
        return self._uri

    @property
    def port(self) -> int:
        """The TCP port; before the start, the requested one."""
        return self._server.port or self._port

    @property
    def run_id(self) -> str:
        """The value of ``/run_id`` at the start, which tells one run of a master from
        another."""
        return self._run_id

    @property
    def is_open(self) -> bool:
        """Whether the master serves."""
        return bool(self._uri) and self._closing is None

    @property
    def stats(self) -> MasterStats:
        """Counters of accepted and refused connections since the start."""
        door = self._server.admission
        budget = self._server.budget
        return MasterStats(
            connections=door.open,
            connections_refused=door.refused,
            connections_forbidden=door.forbidden,
            requests_delayed=self._server.delayed,
            bytes_in_flight=budget.used,
            connections_cut=budget.cut,
        )

    async def start(self) -> Self:
        """Start to serve; returns the master.

        Raises :class:`OSError` when the address or the port is not available, and
        :class:`ValueError` when ``bind`` is not an address, or when ``allow`` excludes this
        machine although ``rosout`` is set.
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
        return self

    async def _start(self) -> None:
        host, bind = self._host, self._bind
        if host is not None and is_wildcard(host):  # an address to listen on, not to announce
            host, bind = None, bind or host
        told = bind if bind and not is_wildcard(bind) else None
        host = host or advertised_host(bound=told)
        # A network without a gateway, perhaps on a robot, gives no address to announce. Nodes
        # that know how to reach this machine find the master all the same.
        advertised = host or "localhost"
        bind = bind or (bind_address_for(host) if host else every_interface(advertised))
        if self._rosout:
            await self._check_that_rosout_is_allowed(advertised)
        self._stack.push_async_callback(self._client.close)
        self._stack.push_async_callback(self._notifier.close)
        self._stack.push_async_callback(self._server.close)
        await self._server.start(bind, self._port)
        self._api.pid = process_id(self.port, is_free=not self._port)
        self._uri = self._api.uri = f"http://{uri_host(advertised)}:{self._server.port}/"
        if self._rosout:
            # Imported here because it is a node, which a master alone does not need.
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
        """Raise if ``allow`` excludes the node ``/rosout``, which is at ``host`` as well."""
        if self._allow.networks is None:
            return
        try:
            _, address = (await resolve(host))[0]
            own = parse_address(local_address_facing(address))
        except OSError:
            return  # the start itself will report it
        if own not in self._allow:
            raise ValueError(
                f"allow: the node /rosout of this master connects from {own}, "
                f"which is not in {', '.join(self._allow.networks) or 'the empty list'}: "
                "add it, or do without the node (rosout=False)"
            )

    async def close(self) -> None:
        """Stop serving and free everything; idempotent. The nodes are not told: they
        outlive their master, and register again with the next one.

        Raises :class:`RuntimeError` in a thread or event loop other than the master's.
        """
        if self._loop_state is not None:
            self._loop_state.check_thread("Master.close()")
        await asyncio.shield(self._begin_to_close("closed"))

    async def wait_closed(self) -> str:
        """Wait until the master has ended, by :meth:`close` or by a request from outside;
        returns the reason."""
        await self._closed.wait()
        return self._reason

    async def __aenter__(self) -> Self:
        return await self.start()

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
        # A task of its own: a request to shut down must not wait for its own end, and the
        # caller of close() may be cancelled meanwhile.
        if self._closing is None:
            self._reason = printable(reason)
            self._closing = asyncio.create_task(self._close(), name="aioros1-master-close")
        return self._closing

    async def _close(self) -> None:
        try:
            await self._stack.aclose()
        finally:
            _LOG.info("master at %s has ended: %s", self._uri, self._reason)
            self._closed.set()

    def _unwanted(self, update: ParamUpdate) -> None:
        """End the subscription of a node that does not know the parameter it was told of.

        This ends only a subscription to exactly that key: a rospy node gives the same answer
        for a new key below one that it follows.
        """
        self._registry.unregister_param_subscriber(update.caller_id, update.key, update.api)


def _new_run_id() -> str:
    # A time-based UUID, as roslaunch makes them, but with random bits in place of the
    # machine's hardware address, which is private and slow to find out.
    node = random.getrandbits(48) | 1 << 40
    return str(uuid.uuid1(node=node, clock_seq=random.getrandbits(14)))
