"""The node, which represents a program in a ROS graph, and the parts it is made of."""

from __future__ import annotations

import asyncio
import math
import os
from collections.abc import Callable, Collection, Coroutine, Mapping, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self, TypeVar

from aioros1._public import public
from aioros1.clock.clock import Clock
from aioros1.connection import ConnectionInfo
from aioros1.core.address import Address
from aioros1.core.awaited import awaits_caller
from aioros1.core.context import Context
from aioros1.core.obstacles import similar_node
from aioros1.core.registration import Terms
from aioros1.core.registrations import Registrations
from aioros1.core.role import Role
from aioros1.core.stats import NodeStats
from aioros1.core.supervisor import Supervisor
from aioros1.core.user_errors import UserErrors
from aioros1.core.user_tasks import Stage, UserTasks
from aioros1.errors import ClosedError, NodeNotFound
from aioros1.events import Broadcast, ClockJumped, Event, EventStream
from aioros1.graph import Graph
from aioros1.hints import NODE_HABITS, check_coroutine, explained, explained_attributes
from aioros1.idl import MessageStore, default_store
from aioros1.log.levels import LevelChanges
from aioros1.log.node_log import NodeLog
from aioros1.net.allow import AllowList
from aioros1.net.loop_state import loop_state
from aioros1.node.acceptor import Acceptor
from aioros1.node.closing import close_members
from aioros1.node.heartbeat import Heartbeat
from aioros1.node.identity import Identity
from aioros1.node.introduction import Introduction
from aioros1.node.logger_services import LoggerServices
from aioros1.node.own_address import OwnAddress
from aioros1.node.param_methods import ParamMethods
from aioros1.node.rosout import Rosout
from aioros1.node.service_methods import ServiceMethods
from aioros1.node.sim_time import SimTime
from aioros1.node.slave_api import SlaveApi
from aioros1.node.time_methods import TimeMethods
from aioros1.node.topic_methods import TopicMethods
from aioros1.node.winding_down import WindingDown
from aioros1.options import (
    LOCAL_TRANSPORTS,
    Limits,
    LocalTransport,
    NodeOptions,
    OnError,
    Timeouts,
    WithoutMaster,
)
from aioros1.params.params import Params
from aioros1.services.services import Services
from aioros1.time import Time
from aioros1.topics.topics import Topics
from aioros1.waiting import deadline
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.master_proxy import MasterProxy
from aioros1.xmlrpc.node_proxy import NodeProxy
from aioros1.xmlrpc.server import XmlRpcServer

__all__ = ["Node"]

C = TypeVar("C", bound=Callable[[], object])


@public
class Node(TopicMethods, ServiceMethods, ParamMethods, TimeMethods):
    """A node of a ROS graph. It runs in the event loop that starts it.

    ::

        async with aioros1.Node("demo") as node:
            pub = await node.advertise("chatter", String)

    ``name`` is a base name without slashes; ``anonymous`` makes it unique.
    ``namespace``, ``master_uri`` and ``host`` default to ``ROS_NAMESPACE``,
    ``ROS_MASTER_URI`` and ``ROS_HOSTNAME`` or ``ROS_IP``. ``host`` is what the node tells
    others to connect to; by default it is the address of this machine that faces the master.
    ``bind`` is the address to listen on. It defaults to loopback if ``host`` is loopback, and
    to all addresses otherwise. Without ``host``, the node also announces ``bind``, unless it
    stands for all addresses. ``allow`` names the networks from which the node accepts
    connections (``["127.0.0.0/8", "10.0.0.5", "fd00::/8"]``); it refuses all others. The
    master calls the node, so it has to be in one of them. ``argv`` gives the words of a
    command line (``__name:=``, ``__ns:=``, ``a:=b``, ``_param:=value``). They override the
    environment; arguments override them. ``remap`` maps names as ``a:=b`` does.

    ``store`` resolves type names. ``rosout`` publishes ``node.log`` on ``/rosout``. Logger
    names (``rosout=["myapp"]``) publish these loggers too, with all below them, at their
    current levels. ``logger_services`` provides ``~get_loggers`` and ``~set_logger_level``.
    With ``use_sim_time`` None, the node follows the parameter ``/use_sim_time``, which it reads
    at the start and with each heartbeat. ``heartbeat`` is how often, in seconds, the node
    checks the master; None means never. ``without_master`` says what opening a role does while
    no master answers: ``"raise"`` raises :class:`~aioros1.MasterUnreachable`, ``"wait"`` waits
    for one, and says so once in the log, and ``"later"`` returns an open role, which is
    registered when a master comes. With ``"wait"``, parameter methods, calls and look-ups wait
    too; with ``"later"`` they raise, since they need an answer. ``on_error`` says what happens
    to an exception in your callbacks: ``"raise"`` closes the node and raises it where you use
    the node, ``"log"`` logs it, and a function is called with it. ``local_transports`` may name
    ``"intraprocess"`` and ``"unix"``: topics then bypass TCP between nodes of this library in
    one event loop, or on one Linux host, if both sides name the transport.

    A node belongs to its event loop: use it and its roles only there. Other threads must pass
    their calls to that loop, as :class:`~aioros1.contrib.threads.NodeThread` does for you.
    Calls from anywhere else raise :class:`RuntimeError`.

    The constructor does no I/O. It raises :class:`~aioros1.InvalidNameError`,
    :class:`ValueError` and :class:`TypeError`, which name the option.
    """

    if not TYPE_CHECKING:
        __getattr__ = explained_attributes(NODE_HABITS)

    @explained
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
        without_master: WithoutMaster = "raise",
        timeouts: Timeouts = Timeouts(),  # noqa: B008 - frozen
        limits: Limits = Limits(),  # noqa: B008 - frozen
        on_error: OnError = "raise",
        local_transports: Collection[LocalTransport] = LOCAL_TRANSPORTS,
    ) -> None:
        allowed = AllowList(allow)
        self.options = NodeOptions(
            namespace=namespace,
            master_uri=master_uri,
            host=host,
            bind=bind,
            allow=allowed.networks,
            xmlrpc_port=xmlrpc_port,
            tcpros_port=tcpros_port,
            argv=None if argv is None else tuple(argv),
            remap=remap,
            anonymous=anonymous,
            rosout=rosout,
            logger_services=logger_services,
            use_sim_time=use_sim_time,
            heartbeat=heartbeat,
            without_master=without_master,
            timeouts=timeouts,
            limits=limits,
            on_error=on_error,
            local_transports=local_transports,
        )
        """The options the node was created with."""
        if not isinstance(store, MessageStore | None):
            raise TypeError(f"store must be a MessageStore or None, got {store!r}")
        identity = Identity.of(name, argv or (), namespace, master_uri, host, remap, anonymous)
        self.name = identity.name
        """The full name of the node."""
        self.base_name = identity.base_name
        """The name without the namespace."""
        self.namespace = identity.namespace
        """The namespace, without a slash at the end unless it is ``/``."""
        self.master_uri = identity.master_uri
        """The URI of the master."""
        self.log_file = identity.log_file
        """The file that ``__log:=`` in ``argv`` names; None without that word."""

        # What every part receives.
        supervisor = Supervisor(f"node {self.name}", _Life(self), self._report)
        events: Broadcast[Event] = Broadcast()
        clock = Clock(lambda before, now: events.publish(_jump(before, now)))
        self.log = NodeLog(self.name, clock.steady, () if isinstance(rosout, bool) else rosout)
        """A :class:`logging.LoggerAdapter`, whose records go to ``/rosout``."""
        self.store = store if store is not None else default_store()
        """Resolves type names."""
        xmlrpc = XmlRpcClient(timeouts=timeouts, limits=limits)
        self.master = MasterProxy(xmlrpc, self.master_uri, self.name)
        """The proxy for calls to the master."""
        own_address = OwnAddress(identity.host, bind, self.master_uri, words=identity.host_words)
        self._supervisor = supervisor
        self._events = events
        self._user_errors = UserErrors(on_error, self.log, self._end)
        self._user_tasks = UserTasks(f"node {self.name}", supervisor.guard, self)
        self._context = context = Context(
            node=self,
            name=self.name,
            namespace=self.namespace,
            remappings=identity.remappings,
            options=self.options,
            log=self.log,
            clock=clock,
            store=self.store,
            peer_definitions=MessageStore(parent=self.store),
            events=events,
            address=Address(self.name, own_address.given),
            supervisor=supervisor,
            user_errors=self._user_errors,
            user_tasks=self._user_tasks,
            xmlrpc=xmlrpc,
            master=self.master,
            registrar=MasterProxy(xmlrpc, self.master_uri, self.name, timeout=math.inf),
            registrations=Registrations(
                Terms(
                    node_name=self.name,
                    master_uri=self.master_uri,
                    patience=timeouts.xmlrpc,
                    supervisor=supervisor,
                    emit=events.publish,
                    warn=lambda text: context.log.complain("%s", text),
                    on_silence=xmlrpc.close_idle,
                )
            ),
        )

        self._contact = context.contact

        # The parts.
        self._acceptor = Acceptor(context, allowed)
        self._topics = Topics(context, self._acceptor.local)
        self._services = Services(context)
        self._params = Params(context)
        self.graph = Graph(context)
        """The ROS graph: its nodes, topics and services."""
        sim_time = SimTime(context, self._topics, self._params)
        self._heartbeat = Heartbeat(context, own_address, sim_time.ask)
        self._introduction = Introduction(
            context, self._topics, self._params, sim_time, identity.private_params, events
        )
        slave_api = SlaveApi(
            *(context, self._topics, self._services, self._params),
            *(self._acceptor.local, self._shut_down),
        )
        self._server = XmlRpcServer(slave_api.methods, limits=limits, allow=allowed)
        self._own_address = own_address
        self._levels = LevelChanges()
        self._rosout: Rosout | None = None
        self._close_timeout = timeouts.close
        self._winding_down = WindingDown(
            context, self._user_tasks, self._user_errors, self._services.end_calls
        )

    # lifecycle

    async def start(self) -> Self:
        """Listen, and contact the master if it is there. ``async with node`` does this.

        The master need not be there: see :meth:`wait_for_master`. Raises
        :class:`OSError` when an address or port is not available, and
        :class:`RuntimeError` when the node was started before.
        """
        if self._supervisor.state != "new":
            raise RuntimeError(f"node {self.name} was started before; make a new Node")
        self._supervisor.state = "starting"
        self._context.loop_state = loop_state()
        await self._supervisor.start()
        return self

    async def close(self, timeout: float | None = None, *, grace: float | None = None) -> None:
        """Close all roles, tell the master, and free everything.

        You may call it any number of times, also concurrently. The node waits at most
        ``timeout`` seconds (``timeouts.close`` by default) for others, then drops whatever
        is left. It holds no resources afterwards, whatever others do.

        First your own code ends, while the roles of the node still work. The node cancels its
        timers and the tasks of :meth:`create_task`, then calls the callbacks of
        :meth:`on_shutdown`, then lets handlers that answer a service call return. Each of these
        steps takes at most ``grace`` seconds (by default ``timeout``). Another call with a
        ``grace`` changes that, the running step included.

        Where the node waits for the code that calls this (a service handler, a callback of
        :meth:`on_shutdown`, a task that cleans up), the call returns at once, and the node
        closes afterwards.
        """
        supervisor = self._supervisor
        if supervisor.state == "new":
            supervisor.state = "closed"
            return
        self._context.check_loop()
        if timeout is not None:
            self._close_timeout = timeout
        if grace is not None:
            self._winding_down.limit(grace)
        is_awaited = awaits_caller(self)
        if supervisor.reason is None:
            self._user_tasks.exempt_caller()
        self._user_errors.closing()
        self._end("closed")
        if not is_awaited:
            await supervisor.wait()

    def on_shutdown(self, callback: C) -> C:
        """Call a function or coroutine function when the node is told to end, and return it.

        It does not matter who ends the node: you, a signal to :func:`aioros1.run`, another node
        or an error. All roles still work then. Use it to stop what has to be stopped::

            node.on_shutdown(lambda: pub.publish(Twist()))

        Callbacks have no arguments. They are called one after the other, the last one first,
        after timers and the tasks of the node have ended. All together have ``timeouts.close``
        seconds; those whose time is over are cancelled, and the others called all the same.
        Exceptions are handled as ``on_error`` says. Raises :class:`TypeError` for what is not
        a function, and :class:`~aioros1.ClosedError` once the callbacks are called.
        """
        self._context.check_loop()
        if self._supervisor.state in ("closing", "closed"):
            self._context.check_open()
        self._winding_down.add(callback)
        return callback

    def abort(self) -> None:
        """Drop everything at once, without telling the master or peers."""
        self._context.check_loop()
        self._close_timeout = 0
        self._supervisor.end("aborted")
        self._winding_down.limit(0)
        self._drop()

    async def wait_closed(self) -> str:
        """Wait until the node is closed, and return why.

        Raises the exception that closed it, if one did (``on_error="raise"``).
        """
        self._context.check_loop()
        await self._supervisor.wait()
        if self._user_errors.failure is not None:
            raise self._user_errors.failure
        return self.close_reason or ""

    async def __aenter__(self) -> Self:
        await self.start()
        self._user_errors.enter_block()
        return self

    async def __aexit__(
        self,
        exc_type: type[BaseException] | None,
        exc: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        was_cancelled_by_us = self._user_errors.leave_block()
        try:
            await self.close()
        except asyncio.CancelledError:
            if not was_cancelled_by_us:
                raise
            await self.close()  # the cancellation was not delivered yet
        failure = self._user_errors.failure
        if failure is not None and (exc is None or was_cancelled_by_us):
            raise failure

    # properties

    @property
    def state(self) -> str:
        """``new``, ``starting``, ``open``, ``closing`` or ``closed``."""
        return self._supervisor.state

    @property
    def is_open(self) -> bool:
        """Whether you can use the node."""
        return self._context.is_open

    @property
    def close_reason(self) -> str | None:
        """Why the node is closed or closing; None while it is neither."""
        return self._supervisor.reason

    @property
    def timeouts(self) -> Timeouts:
        """How long the node waits for others."""
        return self.options.timeouts

    @property
    def limits(self) -> Limits:
        """How much the node accepts from others."""
        return self.options.limits

    @property
    def host(self) -> str:
        """The host the node announces to others.

        Raises :class:`RuntimeError` before the node is started, unless the host is given.
        """
        return self._context.address.host

    @property
    def uri(self) -> str:
        """The URI of the slave API. Raises :class:`RuntimeError` before the node is started."""
        return self._context.address.uri

    @property
    def tcpros_address(self) -> tuple[str, int]:
        """The host and port for topics and services; raises as :attr:`uri` does."""
        return self._context.address.tcpros

    @property
    def tcpros_uri(self) -> str:
        """The URI the node registers its services with; raises as :attr:`uri` does."""
        return self._context.address.tcpros_uri

    @property
    def pid(self) -> int:
        """The process id, which ``getPid`` returns."""
        return os.getpid()

    @property
    def run_id(self) -> str | None:
        """The master's ``/run_id``; None until the master was reached."""
        return self._heartbeat.run_id

    @property
    def connections(self) -> tuple[ConnectionInfo, ...]:
        """All connections of topics, services and service callers."""
        return self._context.connections.infos

    @property
    def roles(self) -> tuple[Role, ...]:
        """All open roles, in the order they were opened."""
        members = self._context.members
        return tuple(each for each in members if isinstance(each, Role) and each.is_open)

    @property
    def stats(self) -> NodeStats:
        """Counters summed over the open roles."""
        members = self._context.members
        stats = [role.stats for role in members if isinstance(role, Role)]
        doors = (self._acceptor.admission, self._server.admission)
        budgets = (self._context.budget, self._server.budget)
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
            bytes_in_flight=sum(budget.used for budget in budgets),
            connections_cut=sum(budget.cut for budget in budgets),
            publishers_followed=self._context.dialling.followed,
        )

    def resolve_name(self, name: str) -> str:
        """The full name that ``name``, ``/name`` or ``~name`` means to this node.

        Remappings are applied. Raises :class:`~aioros1.InvalidNameError`.
        """
        return self._context.resolve_name(name)

    def events(self) -> EventStream[Event]:
        """Iterate over the node's events from now on; the iteration ends with the node."""
        self._context.check_iterator()
        return self._events.subscribe()

    # tasks

    def create_task(
        self, coro: Coroutine[Any, Any, object], *, name: str | None = None
    ) -> asyncio.Task[None]:
        """Run a coroutine in a task of the node, which is cancelled when the node is told to
        end, while its roles still work.

        An exception in the coroutine is handled as ``on_error`` says. The task itself does
        not raise it; its result is None. Raises :class:`~aioros1.ClosedError`.
        """
        return self._create_task(coro, name, "told")

    def _create_task(
        self, coro: Coroutine[Any, Any, object], name: str | None, until: Stage
    ) -> asyncio.Task[None]:
        check_coroutine(coro, "create_task()")
        what = name if name is not None else f"task of node {self.name}"
        try:
            self._context.check_open()
            spawn = self._context.spawn_user
            task = spawn(self._run_for_user, coro, what, name=what, until=until)
        except BaseException:
            coro.close()  # Python warns if it is never awaited
            raise
        task.add_done_callback(lambda _: coro.close())  # if cancelled before its first step
        return task

    async def _run_for_user(self, coro: Coroutine[Any, Any, object], what: str) -> None:
        try:
            await coro
        except BaseException as error:
            self._context.user_error(error, what)

    def handle_error(self, error: Exception, what: str) -> None:
        """Handle an exception that ``what`` raised as ``on_error`` says.

        This is for code that calls callbacks where nobody awaits them.
        """
        self._context.check_loop()
        self._context.user_error(error, what)

    # the graph

    async def peer(self, name: str) -> NodeProxy:
        """Look up another node by name.

        Raises :class:`~aioros1.NodeNotFound` if there is none, and
        :class:`~aioros1.MasterError`.
        """
        context = self._context
        name = context.resolve_name(name)
        try:
            uri = await context.contact.reach(lambda: self.master.lookup_node(name))
        except NodeNotFound as error:
            similar = await similar_node(context, name)
            raise NodeNotFound(error.code, f"{error.status}{similar}") from None
        return NodeProxy(context.xmlrpc, uri, self.name, name)

    async def wait_for_master(self, *, timeout: float | None = None) -> None:
        """Wait until the master answers.

        Raises :class:`TimeoutError` after ``timeout`` seconds.
        """
        async with deadline(timeout, f"no master at {self.master_uri}") as limit:
            while not await self._heartbeat.greet():
                if self._heartbeat.refusal is not None:
                    limit.why = self._heartbeat.refusal.in_short
                await self._context.pause(0.1)

    def __repr__(self) -> str:
        return f"<Node {self.name} at {self.master_uri}, {self.state}>"

    # inside

    def _report(self, error: BaseException, what: str) -> None:
        self._context.report(error, what)

    def _shut_down(self, reason: str) -> None:
        """Close the node because the master, or anybody else, asked for it."""
        self.log.info("shutdown requested: %s", reason)
        self._end(reason)

    def _end(self, reason: str) -> None:
        """Start to end the node."""
        self._supervisor.end(reason)
        if self._supervisor.state == "open":
            self._winding_down.begin()

    async def _wind_down(self) -> None:
        if self._supervisor.state == "open":
            await self._winding_down.run(self._close_timeout)

    async def _begin(self) -> None:
        context, options = self._context, self.options
        address = context.address
        address.known_host, listen = await self._own_address.find()
        address.tcpros_port = await self._acceptor.start(
            listen, options.tcpros_port, topics=self._topics.serve, services=self._services.serve
        )
        await self._server.start(listen, options.xmlrpc_port)
        address.xmlrpc_port = self._server.port
        master_is_there = await self._heartbeat.greet()
        self._supervisor.state = "open"
        if options.use_sim_time:
            context.clock.simulate()
        if not (master_is_there and await self._introduction.make()):
            context.spawn(self._introduce_later, name=f"{self.name} introduction")
        if self._own_address.can_be_doubted:
            context.spawn(self._check_address, name=f"{self.name} address")
        if options.rosout is not False:
            self._rosout = Rosout(context, self._topics, self._params, self._levels)
            context.spawn(self._rosout.run, name=f"{self.name} rosout")
        if options.logger_services:
            services = LoggerServices(context, self._services, self._levels)
            context.spawn(services.run, name=f"{self.name} logger services")
        if options.heartbeat is not None:
            context.spawn(self._heartbeat.run, options.heartbeat, name=f"{self.name} heartbeat")

    async def _check_address(self) -> None:
        """Warn if others can probably not use the address. Nothing waits for the lookup."""
        if (doubt := await self._own_address.doubt()) is not None:
            self.log.warning("%s", doubt)

    async def _introduce_later(self) -> None:
        await self.wait_for_master()
        while not await self._introduction.make():
            await self.wait_for_master()

    async def _finish(self) -> None:
        loop = asyncio.get_running_loop()
        begin = loop.time()
        if self._rosout is not None:
            await self._rosout.settle(self._close_timeout)
        self._supervisor.state = "closing"
        self._heartbeat.stop()
        self._end_time()
        left = max(0, self._close_timeout - (loop.time() - begin))
        await close_members(self._context, self._rosout, left)

    async def _free(self) -> None:
        self._supervisor.state = "closing"
        self._acceptor.close()
        await self._acceptor.wait_closed()
        await self._server.close()
        await self._context.xmlrpc.close()
        for name in await self._user_tasks.end():
            self.log.error("%s goes on although it was cancelled: it is left behind", name)

    def _drop(self) -> None:
        self._supervisor.state = "closed"
        if self._rosout is not None:
            self._rosout.detach()
        self._levels.restore()
        self._context.log.close()
        if self._context.loop_state.loop.is_closed():
            return  # Python drops the rest: nothing can be scheduled any more
        self._user_tasks.cancel_all()
        self._acceptor.close()
        self._topics.abort()
        self._services.abort()
        members = self._context.members
        for abort in tuple(members.values()):
            try:
                abort()
            except BaseException as error:  # in a composite: still drop the others
                self._context.report(error, "dropping what was open")
        members.clear()
        self._end_time()
        self._events.close()

    def _end_time(self) -> None:
        """Stop the clock, which wakes up everyone who waits for it."""
        why = ClosedError(f"node {self.name} is closed ({self.close_reason})")
        self._context.clock.fail(why)


class _Life:
    """The steps of a node's life, which its supervisor runs."""

    def __init__(self, node: Node) -> None:
        self.begin = node._begin
        self.wind_down = node._wind_down
        self.finish = node._finish
        self.free = node._free
        self.drop = node._drop


def _jump(before: int, now: int) -> ClockJumped:
    return ClockJumped(Time.from_nsec(before), Time.from_nsec(now))
