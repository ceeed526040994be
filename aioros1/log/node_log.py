"""The logger adapter of a node, with variants that log less often."""

from __future__ import annotations

import contextlib
import logging
import os
import sys
import threading
from collections import OrderedDict
from collections.abc import Callable, Collection, Hashable, MutableMapping
from types import FrameType
from typing import Any

from aioros1._public import public
from aioros1.log.file import log_to_file
from aioros1.time import Duration

__all__ = ["NodeLog", "SparseLog", "logger_name"]

# logging tells its own frames from those of its users the same way.
_LOGGING = os.path.normcase(logging.addLevelName.__code__.co_filename)

_SITES = 1000
"""Places in the code to remember. A program has fewer, unless it generates code."""


def logger_name(node_name: str) -> str:
    """The name of a node's logger: ``ros.arm.driver`` for ``/arm/driver``."""
    return "ros" + node_name.replace("/", ".")


@public
class NodeLog(logging.LoggerAdapter[logging.Logger]):
    """``node.log``: the logger of a node, with variants that log less often.

    ::

        node.log.info("ready")
        node.log.once.warning("no calibration, using the default")
        node.log.throttle(5.0).info("at %s", position)

    Its records have an attribute ``ros_node``, the name of the node, which formatters can use.
    """

    def __init__(
        self, node_name: str, now: Callable[[], int], others: Collection[str] = ()
    ) -> None:
        self._fields = {"ros_node": node_name}
        own = logger_name(node_name)
        super().__init__(logging.getLogger(own), self._fields)
        self.names = (own, *others)
        """The names of the loggers published on ``/rosout``: the node's own, and those that the
        option ``rosout`` names."""
        self._now = now
        """Returns nanoseconds of some clock."""
        self._once = _Sites()
        self._throttled = _Sites()

    def process(
        self, msg: Any, kwargs: MutableMapping[str, Any]
    ) -> tuple[Any, MutableMapping[str, Any]]:
        """Add the name of the node to the record's ``extra``."""
        kwargs["extra"] = {**self._fields, **(kwargs.get("extra") or {})}
        return msg, kwargs

    def to_file(self, path: str) -> contextlib.AbstractContextManager[None]:
        """Append what goes to ``/rosout`` to a file as well, while the block runs.

        Raises :class:`OSError` if the file cannot be opened.
        """
        return log_to_file(self.names, path)

    def __repr__(self) -> str:
        return f"<NodeLog of {self._fields['ros_node']}, logger {self.logger.name}>"

    @property
    def once(self) -> SparseLog:
        """An adapter with which each place in the code logs only the first time."""
        return SparseLog(self, lambda site, text: self._once.is_new(site))

    def throttle(self, period: float | Duration, *, identical: bool = False) -> SparseLog:
        """An adapter with which each place in the code logs at most once every ``period`` seconds.

        The period follows the time of the node; when that jumps back, the next call logs.
        With ``identical``, only messages with the same text as the last one are held back;
        a different text is logged at once. Raises :class:`ValueError` for a negative period.
        """
        seconds = period.to_sec() if isinstance(period, Duration) else period
        if not seconds >= 0:
            raise ValueError(f"the period of a throttle must not be negative, got {period!r}")

        def is_due(site: Hashable, text: Callable[[], str]) -> bool:
            said = hash(text()) if identical else None
            return self._throttled.is_due(site, self._now(), seconds * 1e9, said)

        return SparseLog(self, is_due)


@public
class SparseLog(logging.LoggerAdapter[NodeLog]):
    """Logs only what is due, separately for each place in the code; made by :class:`NodeLog`.

    A place is a call in a line of a file, as in rospy. The thousand most recently used places
    are remembered.
    """

    def __init__(self, log: NodeLog, is_due: Callable[[Hashable, Callable[[], str]], bool]) -> None:
        super().__init__(log, {})
        self._is_due = is_due

    def process(
        self, msg: Any, kwargs: MutableMapping[str, Any]
    ) -> tuple[Any, MutableMapping[str, Any]]:
        """Add nothing: the underlying adapter does."""
        return msg, kwargs

    def log(self, level: int, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log the message if it is due. The other methods call this one."""
        stacklevel = kwargs.get("stacklevel", 1)
        if self.isEnabledFor(level) and self._is_due(_site(stacklevel), lambda: _text(msg, args)):
            kwargs["stacklevel"] = stacklevel + 1  # past this function
            super().log(level, msg, *args, **kwargs)


class _Sites:
    """State kept for places in the code. Usable from any thread and from signal handlers."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._sites: OrderedDict[Hashable, tuple[int, int | None]] = OrderedDict()

    def is_new(self, site: Hashable) -> bool:
        with self._lock:
            is_new = site not in self._sites
            self._remember(site, 0, None)
        return is_new

    def is_due(self, site: Hashable, now: int, period: float, said: int | None) -> bool:
        with self._lock:
            last, before = self._sites.get(site, (None, None))
            is_due = last is None or not 0 <= now - last < period or said != before
            if is_due:
                self._remember(site, now, said)
        return is_due

    def _remember(self, site: Hashable, now: int, said: int | None) -> None:
        self._sites[site] = now, said
        self._sites.move_to_end(site)
        if len(self._sites) > _SITES:
            self._sites.popitem(last=False)


def _site(stacklevel: int) -> Hashable:
    """The call that logs, found the way logging finds it."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None and frame.f_back is not None and stacklevel:
        frame = frame.f_back
        if frame.f_code.co_filename != _LOGGING:
            stacklevel -= 1
    assert frame is not None
    return frame.f_code.co_filename, frame.f_lineno, frame.f_lasti


def _text(msg: object, args: tuple[Any, ...]) -> str:
    try:
        return logging.LogRecord("", 0, "", 0, msg, args, None).getMessage()
    except Exception:  # the handlers will report it
        return repr(msg)
