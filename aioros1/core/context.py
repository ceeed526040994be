"""What every part of a node is given: all that it may use, and nothing else.

A node is composed of parts: its topics, services and parameters, its heartbeat, its slave
API. None of them knows the node. Each is given the node's context, and so it says in one
place what a part needs and who may touch it.
"""

from __future__ import annotations

from asyncio import _get_running_loop
from collections.abc import Callable
from threading import get_ident
from typing import TYPE_CHECKING, Protocol, TypeVar

from aioros1 import names
from aioros1.core.connections import Connections
from aioros1.core.user_errors import is_end
from aioros1.errors import ClosedError
from aioros1.events import Broadcast, Event

if TYPE_CHECKING:
    from collections.abc import Mapping

    from aioros1.clock.clock import Clock
    from aioros1.core.address import Address
    from aioros1.core.registrations import Registrations
    from aioros1.core.supervisor import Supervisor
    from aioros1.core.user_errors import UserErrors
    from aioros1.idl import MessageStore
    from aioros1.log.node_log import NodeLog
    from aioros1.net.loop_state import LoopState
    from aioros1.options import Limits, NodeOptions, Timeouts
    from aioros1.xmlrpc.client import XmlRpcClient
    from aioros1.xmlrpc.master_proxy import MasterProxy

__all__ = ["Context", "Member"]


class Member(Protocol):
    """What lives on a node, and is closed with it: a role, or a composite of several."""

    @property
    def is_open(self) -> bool: ...

    async def close(self) -> None: ...


M = TypeVar("M", bound=Member)


class Context:
    """One node, as its parts see it."""

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
        xmlrpc: XmlRpcClient,
        master: MasterProxy,
        registrar: MasterProxy,
        registrations: Registrations,
    ) -> None:
        self.node = node
        """The node itself, for users who ask a role for it. Parts do not look at it."""
        self.name = name
        self.namespace = namespace
        self.options = options
        self.timeouts: Timeouts = options.timeouts
        self.limits: Limits = options.limits
        self.log = log
        self.clock = clock
        self.store = store
        """Resolves the names of types."""
        self.peer_definitions = peer_definitions
        """Definitions that publishers sent: a store of their own, so that what a peer says
        is never found by who asks for a type by name."""
        self.address = address
        self.xmlrpc = xmlrpc
        self.master = master
        """The master, asked with a limit of time."""
        self.registrar = registrar
        """The same without one: whoever waits for a registration has a limit of time, the
        request has none."""
        self.registrations = registrations
        self.connections = Connections(events.publish)
        self.members: dict[Member, Callable[[], None]] = {}
        """All that is open, in the order in which it was opened, and what drops it at once.
        A member takes itself out when it is closed."""
        self.emit: Callable[[Event], None] = events.publish
        """Tell those who follow the events of the node."""
        self.spawn = supervisor.spawn
        """Run a function in a task that ends with the node; see :meth:`.Supervisor.spawn`."""
        self.pause = supervisor.pause
        """Sleep until the node begins to close; see :meth:`.Supervisor.pause`."""
        self.loop_state: LoopState
        """What the library keeps for the event loop that the node lives in, from its start."""
        self._remappings = remappings
        self._supervisor = supervisor
        self._user_errors = user_errors

    # names

    def resolve_name(self, name: str) -> str:
        """The full name that ``name``, ``/name`` or ``~name`` means to this node.

        Raises :class:`~aioros1.InvalidNameError`.
        """
        return names.resolve_name(name, self.namespace, self.name, self._remappings)

    # life

    @property
    def is_open(self) -> bool:
        """Whether the node can be used."""
        return self._supervisor.state == "open"

    @property
    def close_reason(self) -> str | None:
        """Why the node is closed, or is closing; None while it is not."""
        return self._supervisor.reason

    def check_open(self) -> None:
        """Raise :class:`~aioros1.ClosedError` unless the node can be used, and
        :class:`RuntimeError` in another thread or event loop than the node's."""
        supervisor = self._supervisor
        if supervisor.state != "open":
            reason = supervisor.reason
            why = f" ({reason})" if reason is not None else ""
            raise ClosedError(f"node {self.name} is {supervisor.state}, not open{why}")
        if get_ident() != self.loop_state.thread_id:
            self.check_loop()

    def check_loop(self) -> None:
        """Raise :class:`RuntimeError` in another thread or event loop than the node's."""
        if self._supervisor.state != "new":
            self.loop_state.check_thread(f"node {self.name}")

    def check_iterator(self) -> None:
        """Raise :class:`RuntimeError` in another event loop than the node's.

        A thread without one may make iterators and hand them over to the node's loop.
        """
        if _get_running_loop() is not None:
            self.check_loop()

    async def admit(self, member: M, abort: Callable[[], None]) -> M:
        """Hand out what was opened, unless the node was closed meanwhile.

        The node closes it in the end, and calls ``abort`` if there is no time for that.
        Raises :class:`~aioros1.ClosedError`.
        """
        self.members[member] = abort
        if not self.is_open:
            await member.close()
            self.check_open()
        return member

    # errors

    def report(self, error: BaseException, what: str) -> None:
        """Log an error of our own, or one that nobody foresaw."""
        self.log.error("%s failed: %r", what, error, exc_info=error)

    def user_error(self, error: Exception, what: str) -> None:
        """Treat an exception of the user's code as ``on_error`` of the node says.

        That a node or a role is closed is no error any more once the node closes.
        """
        if self.is_open or not is_end(error):
            self._user_errors.handle(error, what)
