"""The context that every part of a node receives: all that it may use, and nothing else.

A node is composed of parts: its topics, services and parameters, its heartbeat, its slave
API. None of them knows the node. Each receives the node's context instead, so one place
says what a part needs and who may touch it.
"""

from __future__ import annotations

from asyncio import _get_running_loop
from collections.abc import Callable
from threading import get_ident
from typing import TYPE_CHECKING, Protocol, TypeVar

from aioros1 import names
from aioros1.core.connections import Connections
from aioros1.core.contact import Contact
from aioros1.core.dialling import Dialling
from aioros1.core.user_errors import described, is_end, leave_loop, reportable
from aioros1.errors import ClosedError
from aioros1.events import Broadcast, Event
from aioros1.log.library_log import LibraryLog
from aioros1.net.budget import Budget

if TYPE_CHECKING:
    from collections.abc import Mapping

    from aioros1.clock.clock import Clock
    from aioros1.core.address import Address
    from aioros1.core.registrations import Registrations
    from aioros1.core.supervisor import Supervisor
    from aioros1.core.user_errors import UserErrors
    from aioros1.core.user_tasks import UserTasks
    from aioros1.idl import MessageStore
    from aioros1.log.node_log import NodeLog
    from aioros1.net.loop_state import LoopState
    from aioros1.options import Limits, NodeOptions, Timeouts
    from aioros1.xmlrpc.client import XmlRpcClient
    from aioros1.xmlrpc.master_proxy import MasterProxy

__all__ = ["Context", "Member"]


class Member(Protocol):
    """Something that lives on a node and closes with it: a role, or a composite of several."""

    @property
    def is_open(self) -> bool: ...

    async def close(self) -> None: ...


M = TypeVar("M", bound=Member)


class Context:
    """A node as its parts see it."""

    def __init__(
        self,
        *,
        node: object,
        name: str,
        namespace: str,
        remappings: Mapping[str, str],
        options: NodeOptions,
        log: NodeLog,
        clock: Clock,
        store: MessageStore,
        peer_definitions: MessageStore,
        events: Broadcast[Event],
        address: Address,
        supervisor: Supervisor,
        user_errors: UserErrors,
        user_tasks: UserTasks,
        xmlrpc: XmlRpcClient,
        master: MasterProxy,
        registrar: MasterProxy,
        registrations: Registrations,
    ) -> None:
        self.node = node
        """The node itself, for users who ask a role for it. Parts do not use it."""
        self.name = name
        self.namespace = namespace
        self.options = options
        self.timeouts: Timeouts = options.timeouts
        self.limits: Limits = options.limits
        self.log = LibraryLog(log)
        """What the node says itself; ``node.log`` is for users."""
        self.loggers = log.names
        """The names of the loggers published on ``/rosout``; the first is the node's own."""
        self.clock = clock
        self.store = store
        """Resolves type names."""
        self.peer_definitions = peer_definitions
        """Definitions that publishers sent. They have their own store, so that looking up a type
        by name never finds what a peer sent."""
        self.address = address
        self.xmlrpc = xmlrpc
        self.master = master
        """Calls the master, with a timeout."""
        self.registrar = registrar
        """Calls the master without a timeout. Waiting for a registration has a timeout; the
        request itself has none."""
        self.registrations = registrations
        self.connections = Connections(events.publish, options.limits.kept_header_bytes)
        self.budget = Budget(options.limits.bytes_in_flight)
        """What arrives over TCPROS and is not complete, or waits to be read by others."""
        self.dialling = Dialling(options.limits.publishers)
        """The publishers that the node follows."""
        self.members: dict[Member, Callable[[], None]] = {}
        """Everything that is open, in opening order, with the function that drops it at once.
        A member removes itself when it closes."""
        self.emit: Callable[[Event], None] = events.publish
        """Send an event to everyone who iterates over the node's events."""
        self.spawn = supervisor.spawn
        """Run a function in a task that ends with the node; see :meth:`.Supervisor.spawn`."""
        self.spawn_user = user_tasks.spawn
        """The same for a function of the user's; see :meth:`.UserTasks.spawn`."""
        self.pause = supervisor.pause
        """Sleep until the node is closing; see :meth:`.Supervisor.pause`."""
        self.loop_state: LoopState
        """The library's state for the node's event loop; set when the node starts."""
        self.contact = Contact(options.without_master, master.uri, self.log, self.pause)
        """Says what happens while no master answers."""
        self._remappings = remappings
        self._supervisor = supervisor
        self._user_errors = user_errors

    # names

    def resolve_name(self, name: str) -> str:
        """The full name that ``name``, ``/name`` or ``~name`` means to this node.

        Raises :class:`~aioros1.InvalidNameError`.
        """
        return names.resolve_name(name, self.namespace, self.name, self._remappings)

    # lifecycle

    @property
    def is_open(self) -> bool:
        """Whether you can use the node."""
        return self._supervisor.state == "open"

    @property
    def close_reason(self) -> str | None:
        """Why the node is closed or closing; None while it is neither."""
        return self._supervisor.reason

    def check_open(self) -> None:
        """Raise :class:`~aioros1.ClosedError` unless the node is open, and
        :class:`RuntimeError` outside the node's thread and event loop."""
        supervisor = self._supervisor
        if supervisor.state != "open":
            reason = supervisor.reason
            why = f" ({reason})" if reason is not None else ""
            if supervisor.state == "new":
                why = ": start it first, with `async with` or with `await node.start()`"
            raise ClosedError(f"node {self.name} is {supervisor.state}, not open{why}")
        if get_ident() != self.loop_state.thread_id:
            self.check_loop()

    def check_loop(self) -> None:
        """Raise :class:`RuntimeError` outside the node's thread and event loop."""
        if self._supervisor.state != "new":
            self.loop_state.check_thread(f"node {self.name}")

    def check_iterator(self) -> None:
        """Raise :class:`RuntimeError` in an event loop other than the node's.

        A thread without an event loop may create iterators and pass them to the node's loop.
        """
        if _get_running_loop() is not None:
            self.check_loop()

    async def admit(self, member: M, abort: Callable[[], None]) -> M:
        """Return ``member``, which has just opened, unless the node closed meanwhile.

        The node closes it when it closes itself, and calls ``abort`` if time runs out.
        Raises :class:`~aioros1.ClosedError`.
        """
        self.members[member] = abort
        if not self.is_open:
            await member.close()
            self.check_open()
        return member

    # errors

    def report(self, error: BaseException, what: str) -> None:
        """Log an internal or unexpected error."""
        what_it_is = f"{type(error).__name__}: {described(error)}"
        self.log.error("%s failed: %s", what, what_it_is, exc_info=error)

    def user_error(self, error: BaseException, what: str) -> None:
        """Handle an exception from the user's code as the node's ``on_error`` says.

        Once the node was told to end, a closed node or role no longer counts as an error. The
        end of the program goes to the event loop. Raises ``error`` if it cancels the running
        task.
        """
        if self.loop_state.loop.is_closed():
            raise error  # Python drops the coroutine that it is raised in
        reported = reportable(error)
        if isinstance(error, (SystemExit, KeyboardInterrupt)):
            # Not raised here: some event loops drop what a callback of a transport raises.
            leave_loop(error)
        elif reported is None:
            raise error
        elif self.close_reason is None or not is_end(reported):
            self._user_errors.handle(reported, what)

    def handler_error(self, error: BaseException, what: str) -> BaseException:
        """Handle what a service handler raised although it is no :class:`Exception`, and return
        the error for the caller. Raises ``error`` if it cancels the running task."""
        if self.loop_state.loop.is_closed():
            raise error
        reported = reportable(error)
        if reported is not None:
            self._user_errors.handle_answered(reported, what)
            return reported
        if not isinstance(error, (SystemExit, KeyboardInterrupt)):
            raise error
        leave_loop(error)
        return error
