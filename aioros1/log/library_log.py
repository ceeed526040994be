"""What the library itself logs about a node."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Hashable, MutableMapping
from typing import Any

from aioros1.log.node_log import NodeLog
from aioros1.log.repeats import Repeats
from aioros1.quoting import printable

__all__ = ["ROSOUT", "LibraryLog"]

ROSOUT = "/rosout"
"""The topic of all log records. Every node publishes it from its start to its end, so whoever
receives it meets nodes that are not ready yet or have just gone. That is no news to anybody."""

_LONGEST = 1000
"""Characters of one value in a record."""


class LibraryLog(logging.LoggerAdapter[Any]):
    """Logs to ``log``, for example where ``node.log`` does.

    Every part of a node uses one, and none uses ``node.log`` itself.

    Much of what the library logs was said by peers. Each value is therefore shown on one line
    of bounded length: no peer can forge a line, here or on ``/rosout``, whichever part forgets
    that. What may come again and again is logged by :meth:`complain`.
    """

    def __init__(self, log: logging.Logger | NodeLog, repeats: Repeats | None = None) -> None:
        super().__init__(log, {})
        self._repeats = repeats if repeats is not None else Repeats()
        self._timer: asyncio.TimerHandle | None = None
        self._is_closed = False

    def process(
        self, msg: Any, kwargs: MutableMapping[str, Any]
    ) -> tuple[Any, MutableMapping[str, Any]]:
        """Add nothing: the underlying adapter does."""
        return msg, kwargs

    def log(self, level: int, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log with safe arguments. The other methods call this one."""
        if self.isEnabledFor(level):
            kwargs["stacklevel"] = kwargs.get("stacklevel", 1) + 1  # past this function
            super().log(level, msg, *map(_shown, args), **kwargs)

    def complain(
        self,
        text: str,
        *args: object,
        about: Hashable = None,
        error: BaseException | None = None,
    ) -> None:
        """Log a warning, or ``error`` with its traceback, the first time; count it after that.

        The count is logged later; see :class:`.Repeats`. ``text`` is the kind of complaint, a
        format with nothing but ``%s`` in it. ``about`` tells complaints of one kind apart. By
        default ``args`` do; give it if these hold the port of the peer, or the like.
        """
        shown = tuple(map(_shown, args))
        about = shown if about is None else printable(about, _LONGEST)
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:  # it is closed already
            return
        if self._repeats.is_new(text, about, shown, loop.time()):
            level = logging.WARNING if error is None else logging.ERROR
            self.log(level, text, *shown, exc_info=error, stacklevel=2)
        if self._timer is None and not self._is_closed:
            self._timer = loop.call_later(self._repeats.period, self._tell, loop)

    def close(self) -> None:
        """Count no longer."""
        self._is_closed = True
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _tell(self, loop: asyncio.AbstractEventLoop) -> None:
        self._timer = None
        for text, args, count in self._repeats.due(loop.time()):
            self.warning(f"{text} (%s)", *args, count)
        if self._repeats and not self._is_closed:
            self._timer = loop.call_later(self._repeats.period, self._tell, loop)


def _shown(value: object) -> object:
    return value if isinstance(value, int | float) else printable(value, _LONGEST)
