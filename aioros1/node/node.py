"""The node: what a program is in a ROS graph, and where all its roles come from."""

from __future__ import annotations

import asyncio
import math
import os
from collections.abc import Awaitable, Callable, Collection, Mapping, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from aioros1 import names
from aioros1.clock.clock import Clock
from aioros1.clock.rate import Rate, period_of
from aioros1.clock.timer import Timer
from aioros1.core.role import NodeStats, Role
from aioros1.core.supervisor import Supervisor
from aioros1.errors import ClosedError, MasterUnreachable
from aioros1.events import Broadcast, Event, EventStream
from aioros1.graph import Graph
from aioros1.idl import MessageStore, default_store
from aioros1.log.node_log import NodeLog
from aioros1.net.allow import AllowList
from aioros1.net.hosts import uri_host
from aioros1.node.acceptor import Acceptor
from aioros1.node.heartbeat import Heartbeat
from aioros1.node.identity import Identity
from aioros1.node.logger_services import LoggerLevels
from aioros1.node.node_roles import Roles
from aioros1.node.own_address import OwnAddress
from aioros1.node.param_methods import ParamCalls
from aioros1.node.rosout import Rosout
from aioros1.node.service_methods import ServiceCalls
from aioros1.node.sim_time import SimTime
from aioros1.node.slave_api import SlaveApi
from aioros1.node.topic_methods import TopicCalls
from aioros1.options import (
    LOCAL_TRANSPORTS,
    Limits,
    LocalTransport,
    NodeOptions,
    OnError,
    Timeouts,
)
from aioros1.time import Duration, Time
from aioros1.waiting import deadline
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.master_proxy import MasterProxy
from aioros1.xmlrpc.node_proxy import NodeProxy
from aioros1.xmlrpc.server import XmlRpcServer

if TYPE_CHECKING:
    from aioros1.connection import ConnectionInfo
    from aioros1.node.statistics import Statistics

__all__ = ["Node"]


class Node(TopicCalls, ServiceCalls, ParamCalls):
    """A node of a ROS graph, in the event loop it is started in.

    ::

        async with aioros1.Node("demo") as node:
            pub = await node.advertise("chatter", String)

    ``name`` is a base name without slashes; with ``anonymous`` it is made unique.
    ``namespace``, ``master_uri`` and ``host`` default to ``ROS_NAMESPACE``,
    ``ROS_MASTER_URI`` and ``ROS_HOSTNAME`` or ``ROS_IP``. ``host`` is what others are
    told to connect to; without any of these it is the address of this machine that
    faces the master. ``bind`` is the address to listen on: by default loopback if
    ``host`` is that, else all; without ``host``, it is also what others are told, unless it
    stands for all addresses. ``allow`` names the networks from which connections are taken
    (``["127.0.0.0/8", "10.0.0.5", "fd00::/8"]``), of all others none; the master, which
    calls the node, has to be in one of them. ``argv`` gives the words of a command line,
    which then count more than the environment and less than arguments (``__name:=``,
    ``__ns:=``, ``a:=b``, ``_param:=value``). ``remap`` maps names as ``a:=b`` does.

    ``store`` resolves type names. ``rosout`` publishes ``node.log`` on ``/rosout``; names of
    loggers (``rosout=["myapp"]``) are published in addition, with all below them, at the
    levels they have. ``logger_services`` provides ``~get_loggers`` and ``~set_logger_level``.
    ``use_sim_time`` None does what the parameter ``/use_sim_time`` says, at the start and with
    each heartbeat. ``heartbeat`` is how often, in seconds, the master is looked after, None for
    never. ``on_error``
    says what becomes of an exception in a timer's callback: ``"raise"`` closes the node
    and raises it where the node is used, ``"log"`` logs it, a function is called with it.
    ``local_transports`` may name ``"intraprocess"`` and ``"unix"``: topics then go past TCP
    between nodes of this library that are in one event loop, or on one Linux host, if both
    sides name it.

    The constructor does no I/O. Raises :class:`~aioros1.InvalidNameError`,
    :class:`ValueError` and :class:`TypeError`, which name the option.
    """

    def __init__(
        self,
        name: str,
        *,
        namespace: str | None = None,
        master_uri: str | None = None,
        host: str | None = None,
        bind: str | None = None,
        allow: Collection[str] | None = None,
        xmlrpc_port: int = 0,
        tcpros_port: int = 0,
        argv: Sequence[str] | None = None,
        remap: Mapping[str, str] | None = None,
        anonymous: bool = False,
        store: MessageStore | None = None,
        rosout: bool | Collection[str] = True,
        logger_services: bool = True,
        use_sim_time: bool | None = None,
        heartbeat: float | None = 1.0,
        timeouts: Timeouts = Timeouts(),  # noqa: B008 - frozen
        limits: Limits = Limits(),  # noqa: B008 - frozen
        on_error: OnError = "raise",
        local_transports: Collection[LocalTransport] = LOCAL_TRANSPORTS,
    ) -> None:
        super().__init__()
        self._allow = AllowList(allow)
        self.options = NodeOptions(
            namespace=namespace,
            master_uri=master_uri,
            host=host,
            bind=bind,
            allow=self._allow.networks,
            xmlrpc_port=xmlrpc_port,
            tcpros_port=tcpros_port,
            argv=None if argv is None else tuple(argv),
            remap=remap,
            anonymous=anonymous,
            rosout=rosout,
            logger_services=logger_services,
            use_sim_time=use_sim_time,
            heartbeat=heartbeat,
            timeouts=timeouts,
            limits=limits,
            on_error=on_error,
            local_transports=local_transports,
        )
        self.timeouts = timeouts
        self.limits = limits
        if not isinstance(store, MessageStore | None):
            raise TypeError(f"store must be a MessageStore or None, got {store!r}")
        self.store = store if store is not None else default_store()
        self.peer_definitions = MessageStore(parent=self.store)
        """Definitions that publishers sent: a store of their own, so that what a peer
        says is never found by who asks for a type by name."""
        identity = Identity.of(name, argv or (), namespace, master_uri, host, remap, anonymous)
        self.base_name = identity.base_name
        self.namespace = identity.namespace
        self.name = identity.name
        self.master_uri = identity.master_uri
        self._address = OwnAddress(
            identity.host, bind, identity.master_uri, words=identity.host_words
        )
        self._remappings = identity.remappings
        self._private_params = identity.private_params
        self._clock = Clock()
        self.log = NodeLog(self.name, self._clock.steady)
        self._logger_levels = LoggerLevels(self)
        self.graph = Graph(self)

        self._xmlrpc = XmlRpcClient(timeouts=timeouts, limits=limits)
        self.master = MasterProxy(self._xmlrpc, self.master_uri, self.name)
        # Who waits for a registration has a limit of time; the request has none.
        self._registrar = MasterProxy(self._xmlrpc, self.master_uri, self.name, timeout=math.inf)
        self._server = XmlRpcServer(SlaveApi(self).methods, limits=limits, allow=self._allow)
        self._acceptor = Acceptor(self)
        self._heartbeat = Heartbeat(self)
        self._events: Broadcast[Event] = Broadcast()
        self._supervisor = Supervisor(
            f"node {self.name}",
            *(self._begin, self._finish, self._free, self._drop),
            self._report,
        )
        self._state = "new"
        self._close_timeout = timeouts.close
        self._failure: Exception | None = None
        self._user: asyncio.Task[Any] | None = None
        self._user_cancelled = False
        self._rosout: Rosout | None = None
        self._statistics: Statistics | None = None  # once it is published

        self._roles = Roles(self)
        self._sim_time = SimTime(self)

    # life

    async def start(self) -> Self:
        """Listen, and greet the master if it is there. ``async with node`` does this.

        The master need not be there: see :meth:`wait_for_master`. Raises
        :class:`OSError` when an address or port is not to be had, :class:`RuntimeError`
        when the node was started before.
        """
        if self._state != "new":
            raise RuntimeError(f"node {self.name} was started before; make a new Node")
        self._state = "starting"
        await self._supervisor.start()
        return self

    async def close(self, timeout: float | None = None) -> None:
        """Close all roles, tell the master, free everything.

        May be called any number of times, also at the same time. Others are given
        ``timeout`` seconds (``timeouts.close`` by default) for all of it; then what is
        left is dropped, so that nothing is held afterwards whatever they do.
        """
        if self._state == "new":
            self._state = "closed"
            return
        if timeout is not None:
            self._close_timeout = timeout
        self._supervisor.end("closed")
        await self._supervisor.wait()

    def abort(self) -> None:
        """Drop everything at once, without a word to the master or to peers."""
        self._close_timeout = 0
        self._supervisor.end("aborted")
        self._drop()

    async def wait_closed(self) -> str:
        """Wait until the node is closed, and return why.

        Raises the exception that closed it, if one did (``on_error="raise"``).
        """
        await self._supervisor.wait()
        if self._failure is not None:
            raise self._failure
        return self.close_reason or ""

    async def __aenter__(self) -> Self:
        await self.start()
        self._user = asyncio.current_task()
        return self

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        user, self._user = self._user, None
        # As asyncio.timeout does: the cancellation was ours and ends here, unless
        # somebody else has cancelled too.
        ours = self._user_cancelled and user is not None and user.uncancel() <= 0
        try:
            await self.close()
        except asyncio.CancelledError:
            if not ours:
                raise
            await self.close()  # the cancellation had not been delivered yet
        if self._failure is not None and (exc is None or ours):
            raise self._failure

    # what it is

    @property
    def state(self) -> str:
        """``new``, ``starting``, ``open``, ``closing`` or ``closed``."""
        return self._state

    @property
    def is_open(self) -> bool:
        """Whether the node can be used."""
        return self._state == "open"

    @property
    def close_reason(self) -> str | None:
        """Why the node was closed or is closing; None while it is not."""
        return self._supervisor.reason

    @property
    def host(self) -> str:
        """What others are told to connect to."""
        if self._address.host is None:
            raise RuntimeError(f"node {self.name} has no address before it is started")
        return self._address.host

    @property
    def uri(self) -> str:
        """The URI of the slave API."""
        return f"http://{uri_host(self.host)}:{self._server.port}/"

    @property
    def tcpros_address(self) -> tuple[str, int]:
        """Host and port for topics and services."""
        return self.host, self._acceptor.port

    @property
    def tcpros_uri(self) -> str:
        """The same for services, as the master is told."""
        return f"rosrpc://{uri_host(self.host)}:{self._acceptor.port}"

    @property
    def pid(self) -> int:
        """The process id, which ``getPid`` answers."""
        return os.getpid()

    @property
    def run_id(self) -> str | None:
        """What the master calls this run of the graph; None while it was not reached."""
        return self._heartbeat.run_id

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """All connections, of topics, services and callers."""
        return self._roles.connections

    @property
    def roles(self) -> tuple[Role, ...]:
        """All open roles, in the order they were opened."""
        return tuple(role for role in self._roles.open if role.is_open)

    @property
    def stats(self) -> NodeStats:
        """Sums of what the open roles have counted."""
        stats = [role.stats for role in self._roles.open]
        doors = (self._acceptor.admission, self._server.admission)
        return NodeStats(
            messages=sum(each.messages for each in stats),
            bytes=sum(each.bytes for each in stats),
            dropped=sum(each.dropped for each in stats),
            errors=sum(each.errors for each in stats),
            roles=len(stats),
            connections=len(self.connections),
            connections_refused=sum(door.refused for door in doors),
            connections_forbidden=sum(door.forbidden for door in doors),
            requests_delayed=self._server.delayed,
        )

    def resolve_name(self, name: str) -> str:
        """The full name that ``name``, ``/name`` or ``~name`` means to this node.

        Remappings are applied. Raises :class:`~aioros1.InvalidNameError`.
        """
        return names.resolve_name(name, self.namespace, self.name, self._remappings)

    def events(self) -> EventStream[Event]:
        """Iterate over what happens to the node from now on; ends with the node."""
        return self._events.subscribe()

    # the graph

    async def peer(self, name: str) -> NodeProxy:
        """Another node, by name. Raises :class:`~aioros1.MasterError` if there is none."""
        name = self.resolve_name(name)
        return NodeProxy(self._xmlrpc, await self.master.lookup_node(name), self.name, name)

    async def wait_for_master(self, *, timeout: float | None = None) -> None:
        """Wait until the master answers.

        Raises :class:`TimeoutError` after ``timeout`` seconds.
        """
        async with deadline(timeout, f"no master at {self.master_uri}") as limit:
            while not await self._heartbeat.greet():
                limit.why = self._heartbeat.refusal
                await self._pause(0.1)

    # time

    def now(self) -> Time:
        """The time: of ``/clock`` if that is followed, else the wall clock's."""
        return Time.from_nsec(self._clock.nanoseconds())

    async def sleep(self, duration: float | Duration) -> None:
        """Wait for seconds of this node's time. Raises :class:`~aioros1.ClosedError`."""
        await self._clock.sleep(duration)

    def rate(self, hz: float) -> Rate:
        """Iterate ``hz`` times a second of this node's time; ends with the node.

        Raises :class:`ValueError` for a rate that is not positive.
        """
        return Rate(self._clock, period_of(hz))

    def timer(
        self,
        period: float | Duration,
        callback: Callable[[Time], Any] | Callable[[Time], Awaitable[Any]],
        *,
        oneshot: bool = False,
    ) -> Timer:
        """Call a function, or a coroutine function, every ``period`` seconds with the time.

        It ends with the node, or by :meth:`Timer.cancel`.
        """
        self._check_open()
        return Timer(self, period, callback, oneshot=oneshot)

    def __repr__(self) -> str:
        return f"<Node {self.name} at {self.master_uri}, {self._state}>"

    # inside

    def _check_open(self) -> None:
        if self._state != "open":
            why = f" ({self.close_reason})" if self.close_reason is not None else ""
            raise ClosedError(f"node {self.name} is {self._state}, not open{why}")

    def _spawn(
        self, function: Callable[..., Awaitable[Any]], *args: Any, name: str
    ) -> asyncio.Task[None]:
        return self._supervisor.spawn(function, *args, name=name)

    async def _pause(self, seconds: float) -> None:
        await self._supervisor.pause(seconds)

    def _emit(self, event: Event) -> None:
        self._events.publish(event)

    def _report(self, error: BaseException, what: str) -> None:
        """An error of our own, or one that nobody foresaw."""
        self.log.error("%s failed: %r", what, error, exc_info=error)

    def _user_error(self, error: Exception, what: str) -> None:
        """An exception of the user's code, where there is nobody to raise it to."""
        policy = self.options.on_error
        if callable(policy):
            policy(error)
        elif policy == "log":
            self.log.error("%s failed", what, exc_info=error)
        elif self._failure is None:
            self._failure = error
            self._supervisor.end(f"{what} failed: {error!r}")
            if self._user is not None:
                self._user_cancelled = True
                self._user.cancel()

    def _shut_down(self, reason: str) -> None:
        """The master, or anybody else, wants the node to end."""
        self.log.info("shutdown requested: %s", reason)
        self._supervisor.end(reason)

    async def _begin(self) -> None:
        address = await self._address.find()
        await self._acceptor.start(address, self.options.tcpros_port)
        await self._acceptor.local.start()
        await self._server.start(address, self.options.xmlrpc_port)
        master_is_there = await self._heartbeat.greet()
        self._state = "open"
        if self.options.use_sim_time:
            self._clock.simulate()
        if not (master_is_there and await self._introduced()):
            self._spawn(self._introduce_later, name=f"{self.name} introduction")
        if self._address.is_given:
            self._spawn(self._check_address, name=f"{self.name} address")
        if self.options.rosout is not False:
            self._rosout = Rosout(self)
            self._spawn(self._rosout.run, name=f"{self.name} rosout")
        if self.options.logger_services:
            self._spawn(self._logger_levels.serve, name=f"{self.name} logger services")
        if self.options.heartbeat is not None:
            self._spawn(self._heartbeat.run, self.options.heartbeat, name=f"{self.name} heartbeat")

    async def _check_address(self) -> None:
        """Warn of an address that others can hardly use. Nobody waits for the look-up."""
        if (doubt := await self._address.doubt()) is not None:
            self.log.warning("%s", doubt)

    async def _introduce(self) -> None:
        """Say, and ask, what can only be once there is a master."""
        for key, value in self._private_params.items():
            await self.set_param(f"~{key}", value)
        has_statistics = await self.get_param("/enable_statistics", False) is True
        await self._sim_time.ask()
        # All that may fail, and is then done again, is behind us.
        if has_statistics:
            from aioros1.node import statistics  # here, as hardly anybody wants it

            self._spawn(statistics.Statistics(self).run, name=f"{self.name} statistics")

    async def _introduced(self) -> bool:
        """Whether the master was there long enough for that."""
        try:
            await self._introduce()
        except MasterUnreachable:
            return False
        return True

    async def _introduce_later(self) -> None:
        await self.wait_for_master()
        while not await self._introduced():
            await self.wait_for_master()

    async def _finish(self) -> None:
        loop = asyncio.get_running_loop()
        begin = loop.time()
        if self._rosout is not None:
            await self._rosout.settle(self._close_timeout)
        self._state = "closing"
        self._heartbeat.stop()
        self._clock.fail(ClosedError(f"node {self.name} is closed ({self.close_reason})"))
        await self._roles.close(max(0, self._close_timeout - (loop.time() - begin)))

    async def _free(self) -> None:
        """Let go of all that is shared with others, whatever has become of it."""
        self._state = "closing"
        self._acceptor.close()
        await self._server.close()
        await self._xmlrpc.close()

    def _drop(self) -> None:
        """Let go of the rest, without waiting for anybody."""
        self._state = "closed"
        if self._rosout is not None:
            self._rosout.detach()
        self._logger_levels.restore()
        self._acceptor.close()
        self._roles.abort()
        self._clock.fail(ClosedError(f"node {self.name} is closed ({self.close_reason})"))
        self._events.close()
