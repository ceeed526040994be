"""Looks up host names in threads of our own.

``loop.getaddrinfo()`` uses the threads of the loop's default executor, which the program's
own ``asyncio.to_thread()`` uses as well. A few names without an answer, at ten seconds or more
each, would take all of them: healthy peers would be connected half a minute late, and the
program's own threads would be late, too. (uvloop has four such threads for the whole process.)
"""

from __future__ import annotations

import asyncio
import socket
from _thread import start_new_thread
from typing import TypeVar

__all__ = ["Lookups"]

V = TypeVar("V")

_Address = tuple[socket.AddressFamily, str]

THREADS = 128
"""The most names that are looked up at a time. A thread that waits takes some 50 kB."""

RESERVED = 16
"""Further threads, for names that could be looked up before: peers that are in order must not
wait for a flood of names that nobody answers."""

SHORTEST_MEMORY, LONGEST_MEMORY = 1.0, 5.0
"""Seconds for which a failure is remembered: as long as it took, within these bounds."""

_REMEMBERED = 256
"""The most names that are remembered, of those that failed and of those that did not."""

_LONGEST_NAME = 253
"""Characters of a host name (RFC 1035). What is longer needs no thread to be refused."""


class Lookups:
    """The look-ups of one event loop.

    A name is looked up once at a time, for all who wait for it; whoever stops waiting
    disturbs no other. Nobody waits for the threads: neither the end of the loop nor that of
    the interpreter is held up by one that gets no answer.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._lookups: dict[str, _Lookup] = {}  # in a thread, or waiting for one
        self._waiting: dict[_Lookup, None] = {}  # in this order
        self._threads = 0
        self._failures: dict[str, tuple[float, OSError]] = {}
        self._known: dict[str, None] = {}  # names that could be looked up, the last one behind

    def __repr__(self) -> str:
        return f"<Lookups: {self._threads} running, {len(self._waiting)} waiting>"

    async def addresses(self, host: str) -> list[_Address]:
        """Return the numeric addresses of a name, in the order of the system.

        Raises :class:`OSError` (``socket.gaierror``) if the name is unknown.
        """
        host = host.lower()
        if len(host) > _LONGEST_NAME or "\0" in host:
            raise _no_name(host, f"expected at most {_LONGEST_NAME} characters, none of them null")
        failure = self._failures.get(host)
        if failure is not None:
            until, error = failure
            if self._loop.time() < until:
                raise _copy(error)
            del self._failures[host]
        lookup = self._lookups.get(host)
        if lookup is None:
            lookup = self._lookups[host] = _Lookup(host)
            if not self._begin(lookup):
                self._waiting[lookup] = None
        return await self._outcome(lookup)

    async def _outcome(self, lookup: _Lookup) -> list[_Address]:
        waiter: asyncio.Future[None] = self._loop.create_future()
        lookup.waiters.add(waiter)
        try:
            if lookup.outcome is None:
                await waiter
        finally:
            lookup.waiters.discard(waiter)
            if not lookup.waiters and lookup in self._waiting:  # nobody needs it any more
                del self._waiting[lookup]
                del self._lookups[lookup.host]
        assert lookup.outcome is not None
        if isinstance(lookup.outcome, OSError):
            raise _copy(lookup.outcome)
        return list(lookup.outcome)

    def _begin(self, lookup: _Lookup) -> bool:
        """Start a thread for a look-up; whether there was one for it."""
        if self._threads >= THREADS + (RESERVED if lookup.host in self._known else 0):
            return False
        lookup.begin = self._loop.time()
        try:
            # Not threading.Thread, whose start() blocks until the thread runs, and whose
            # threads are waited for at exit unless they are daemons.
            start_new_thread(self._run, (lookup,))
        except RuntimeError as error:  # the system has no more threads
            if self._threads:
                return False  # there will be one again
            self._end(lookup, OSError(f"cannot look up {lookup.host!r}: {error}"))
        else:
            self._threads += 1
        return True

    def _run(self, lookup: _Lookup) -> None:
        """Look up a name, in its thread."""
        outcome = _look_up(lookup.host)
        try:
            self._loop.call_soon_threadsafe(self._returned, lookup, outcome)
        except RuntimeError:
            pass  # the loop is closed, so nobody waits

    def _returned(self, lookup: _Lookup, outcome: list[_Address] | OSError) -> None:
        self._threads -= 1
        self._end(lookup, outcome)
        while self._waiting and self._begin(following := next(iter(self._waiting))):
            self._waiting.pop(following, None)

    def _end(self, lookup: _Lookup, outcome: list[_Address] | OSError) -> None:
        """Give the outcome to those who wait, and remember it."""
        host = lookup.host
        del self._lookups[host]
        lookup.outcome = outcome
        self._known.pop(host, None)
        if isinstance(outcome, OSError):
            now = self._loop.time()
            span = min(max(now - lookup.begin, SHORTEST_MEMORY), LONGEST_MEMORY)
            _remember(self._failures, host, (now + span, outcome))
        else:
            _remember(self._known, host, None)
        for waiter in lookup.waiters:
            if not waiter.done():
                waiter.set_result(None)


class _Lookup:
    """The look-up of one name, for all who wait for it."""

    __slots__ = ("begin", "host", "outcome", "waiters")

    def __init__(self, host: str) -> None:
        self.host = host
        self.begin = 0.0
        self.waiters: set[asyncio.Future[None]] = set()
        self.outcome: list[_Address] | OSError | None = None


def _look_up(host: str) -> list[_Address] | OSError:
    try:
        rows = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
    except OSError as error:
        return error.with_traceback(None)
    except ValueError as error:  # a label that is empty, or longer than 63 characters
        return _no_name(host, str(error))
    except Exception as error:  # whatever it is, somebody waits for the outcome
        return OSError(f"cannot look up {host!r}: {error!r}")
    found: dict[_Address, None] = {}
    for family, _, _, _, address in rows:
        if family == socket.AF_INET:
            found[family, str(address[0])] = None
        elif family == socket.AF_INET6:
            numeric, zone = str(address[0]), address[3] if len(address) > 3 else 0
            # A link-local address is one of an interface, and means nothing without it.
            found[family, f"{numeric}%{zone}" if zone and "%" not in numeric else numeric] = None
    return list(found)


def _no_name(host: str, why: str) -> socket.gaierror:
    text = repr(host if len(host) <= 60 else host[:57] + "...")
    return socket.gaierror(socket.EAI_NONAME, f"{text} is not a host name: {why}")


def _copy(error: OSError) -> OSError:
    """An error of its own for each who waits, since raising one writes into it."""
    return type(error)(*error.args)


def _remember(names: dict[str, V], name: str, value: V) -> None:
    names[name] = value
    if len(names) > _REMEMBERED:
        del names[next(iter(names))]
