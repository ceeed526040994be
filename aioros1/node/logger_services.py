"""The levels of ROS and of :mod:`logging`, and the services that tell and set them."""

from __future__ import annotations

import contextlib
import logging
import threading
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from aioros1.errors import MasterError, RosError
from aioros1.log.loggers import logger_names

if TYPE_CHECKING:
    from aioros1.node import Node

__all__ = ["LEVELS", "LoggerLevels", "ros_level"]

LEVELS = {
    "debug": (logging.DEBUG, 1),
    "info": (logging.INFO, 2),
    "warn": (logging.WARNING, 4),
    "error": (logging.ERROR, 8),
    "fatal": (logging.CRITICAL, 16),
}
"""ROS's name of a level, Python's number and the number in ``rosgraph_msgs/Log``."""

_RETRY = 1.0


def ros_level(number: int) -> int:
    """The level of ROS for one of Python's, which may lie in between."""
    for python, ros in reversed(LEVELS.values()):
        if number >= python:
            return ros
    return 1


@dataclass(slots=True)
class _Change:
    """What has become of the level of one logger."""

    before: int
    after: int
    wanted_by: set[LoggerLevels] = field(default_factory=set)


# Of the process, as the loggers are: two of its nodes may have some in common.
_changes: dict[logging.Logger, _Change] = {}
_lock = threading.RLock()


class LoggerLevels:
    """The levels of the loggers that are a node's business: its own, those in ``rosout``
    of its options, and all below these.

    Who sets a level here, from far away or for ``/rosout``, does so while the node is open.
    """

    def __init__(self, node: Node) -> None:
        self._node = node

    def set(self, logger: logging.Logger, level: int) -> None:
        """Change a level until :meth:`restore`."""
        with _lock:
            change = _changes.setdefault(logger, _Change(logger.level, level))
            change.wanted_by.add(self)
            change.after = level
            logger.setLevel(level)

    def set_default(self, logger: logging.Logger, level: int) -> None:
        """Do that for a logger without a level; one that another node has set keeps it."""
        with _lock:
            if logger in _changes:
                _changes[logger].wanted_by.add(self)
            elif logger.level == logging.NOTSET:
                self.set(logger, level)

    def restore(self) -> None:
        """Undo the changes that no other node wants, but for what the application has
        changed meanwhile."""
        with _lock:
            for logger, change in list(_changes.items()):
                change.wanted_by.discard(self)
                if not change.wanted_by:
                    del _changes[logger]
                    if logger.level == change.after:
                        logger.setLevel(change.before)

    async def serve(self) -> None:
        """Provide ``~get_loggers`` and ``~set_logger_level`` as soon as the master lets us."""
        services = [
            ("~get_loggers", "roscpp/GetLoggers", self._get_loggers),
            ("~set_logger_level", "roscpp/SetLoggerLevel", self._set_logger_level),
        ]
        for name, srv, handler in services:
            while True:
                with contextlib.suppress(MasterError):
                    await self._node.advertise_service(name, srv, handler)
                    break
                await self._node._pause(_RETRY)

    def _is_ours(self, name: str) -> bool:
        return any(name == top or name.startswith(f"{top}.") for top in logger_names(self._node))

    def _get_loggers(self, request: Any) -> dict[str, Any]:
        tops = [logging.getLogger(name) for name in logger_names(self._node)]
        # Logging keeps placeholders for names that stand only within longer ones.
        others = [
            logger
            for name, logger in sorted(logging.Logger.manager.loggerDict.copy().items())
            if isinstance(logger, logging.Logger) and self._is_ours(name)
        ]
        return {
            "loggers": [
                {"name": logger.name, "level": _level_name(logger.getEffectiveLevel())}
                for logger in dict.fromkeys([*tops, *others])
            ]
        }

    def _set_logger_level(self, request: Any) -> None:
        level = request.level.lower()
        if level not in LEVELS:
            raise RosError(f"unknown level {request.level!r}, expected one of {', '.join(LEVELS)}")
        # One that does not exist yet is made, as by rospy and roscpp: its user may come later.
        if not self._is_ours(request.logger):
            names = ", ".join(logger_names(self._node))
            raise RosError(
                f"unknown logger {request.logger!r}, expected one of {names}, or one below"
            )
        self.set(logging.getLogger(request.logger), LEVELS[level][0])


def _level_name(number: int) -> str:
    level = ros_level(number)
    return next(name for name, (_, ros) in LEVELS.items() if ros == level)
