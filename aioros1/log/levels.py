"""Log levels of ROS and of :mod:`logging`, and level changes that a node undoes."""

from __future__ import annotations

import logging
import threading
from dataclasses import dataclass, field

__all__ = ["LEVELS", "LevelChanges", "level_name", "ros_level"]

LEVELS = {
    "debug": (logging.DEBUG, 1),
    "info": (logging.INFO, 2),
    "warn": (logging.WARNING, 4),
    "error": (logging.ERROR, 8),
    "fatal": (logging.CRITICAL, 16),
}
"""ROS's name for a level, Python's number and the number in ``rosgraph_msgs/Log``."""


def ros_level(number: int) -> int:
    """The ROS level for a Python level, which may lie between two of them."""
    for python, ros in reversed(LEVELS.values()):
        if number >= python:
            return ros
    return 1


@dataclass(slots=True)
class _Change:
    """A change to the level of one logger."""

    before: int
    after: int
    wanted_by: set[LevelChanges] = field(default_factory=set)


# Global to the process, as loggers are: two nodes may share some.
_changes: dict[logging.Logger, _Change] = {}
_lock = threading.RLock()


class LevelChanges:
    """The levels that one node has set, for ``/rosout`` or on request."""

    def set(self, logger: logging.Logger, level: int) -> None:
        """Change a level until :meth:`restore`."""
        with _lock:
            change = _changes.setdefault(logger, _Change(logger.level, level))
            change.wanted_by.add(self)
            change.after = level
            logger.setLevel(level)

    def set_default(self, logger: logging.Logger, level: int) -> None:
        """Change a level like :meth:`set`, but only of a logger without one. A level that
        another node has set stays."""
        with _lock:
            if logger in _changes:
                _changes[logger].wanted_by.add(self)
            elif logger.level == logging.NOTSET:
                self.set(logger, level)

    def restore(self) -> None:
        """Undo the changes that no other node wants, except where the application has changed
        the level meanwhile."""
        with _lock:
            for logger, change in list(_changes.items()):
                change.wanted_by.discard(self)
                if not change.wanted_by:
                    del _changes[logger]
                    if logger.level == change.after:
                        logger.setLevel(change.before)


def level_name(number: int) -> str:
    """ROS's name for a Python level."""
    level = ros_level(number)
    return next(name for name, (_, ros) in LEVELS.items() if ros == level)
