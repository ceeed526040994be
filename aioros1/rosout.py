"""A node's log records on ``/rosout``, and the two services that set its log levels."""

from __future__ import annotations

import contextlib
import logging
from collections import deque
from typing import TYPE_CHECKING, Any

from aioros1.errors import ClosedError, MasterError, RosError
from aioros1.time import Time

if TYPE_CHECKING:
    from aioros1.node import Node
    from aioros1.publisher import Publisher

__all__ = ["LEVELS", "Rosout", "logger_name", "serve_logger_levels"]

LEVELS = {
    "debug": (logging.DEBUG, 1),
    "info": (logging.INFO, 2),
    "warn": (logging.WARNING, 4),
    "error": (logging.ERROR, 8),
    "fatal": (logging.CRITICAL, 16),
}
"""ROS's name of a level, Python's number and the number in ``rosgraph_msgs/Log``."""

_RETRY = 1.0


def logger_name(node_name: str) -> str:
    """The name of a node's logger: ``ros.arm.driver`` for ``/arm/driver``."""
    return "ros" + node_name.replace("/", ".")


class Rosout(logging.Handler):
    """Publishes what a node's logger is given.

    Records wait, the newest hundred of them, until the topic is advertised; a node does
    not wait for that with its start.
    """

    def __init__(self, node: Node) -> None:
        super().__init__()
        self._node = node
        self._early: deque[logging.LogRecord] = deque(maxlen=100)
        self._publisher: Publisher[Any] | None = None
        logger = node.log.logger
        self._level = logger.level
        if logger.level == logging.NOTSET:
            # As rosout has it; what else the application shows is up to its handlers.
            logger.setLevel(logging.INFO)
        logger.addHandler(self)

    def detach(self) -> None:
        """Leave the logger as it was."""
        logger = self._node.log.logger
        if self in logger.handlers:
            logger.removeHandler(self)
            logger.setLevel(self._level)

    async def run(self) -> None:
        """Advertise ``/rosout`` as soon as the master lets us."""
        while self._publisher is None:
            try:
                self._publisher = await self._node.advertise(
                    "/rosout", "rosgraph_msgs/Log", latch=True, queue_size=100
                )
            except MasterError:
                await self._node._pause(_RETRY)
        while self._early:
            self.emit(self._early.popleft())

    def emit(self, record: logging.LogRecord) -> None:
        publisher = self._publisher
        if publisher is None:
            self._early.append(record)
            return
        try:
            publisher.publish(
                header={"stamp": Time.from_nsec(self._node._clock.nanoseconds())},
                level=_level(record.levelno),
                name=self._node.name,
                msg=self.format(record),
                file=record.pathname,
                function=record.funcName or "",
                line=record.lineno,
                topics=sorted(self._node._roles.publications),
            )
        except ClosedError:
            pass  # the last words of a node that is closing go elsewhere
        except Exception:  # a record that cannot be formatted, as every handler does
            self.handleError(record)


async def serve_logger_levels(node: Node) -> None:
    """Provide ``~get_loggers`` and ``~set_logger_level`` as soon as the master lets us."""

    def get_loggers(request: Any) -> dict[str, Any]:
        level = _level(node.log.logger.getEffectiveLevel())
        names = [name for name, (_, number) in LEVELS.items() if number == level]
        return {"loggers": [{"name": node.log.logger.name, "level": names[0]}]}

    def set_logger_level(request: Any) -> None:
        level = request.level.lower()
        if level not in LEVELS:
            raise RosError(f"unknown level {request.level!r}, expected one of {', '.join(LEVELS)}")
        logging.getLogger(request.logger).setLevel(LEVELS[level][0])

    services = [
        ("~get_loggers", "roscpp/GetLoggers", get_loggers),
        ("~set_logger_level", "roscpp/SetLoggerLevel", set_logger_level),
    ]
    for name, srv, handler in services:
        while True:
            with contextlib.suppress(MasterError):
                await node.advertise_service(name, srv, handler)
                break
            await node._pause(_RETRY)


def _level(number: int) -> int:
    """The level of ROS for one of Python's, which may lie in between."""
    for python, ros in reversed(LEVELS.values()):
        if number >= python:
            return ros
    return 1
