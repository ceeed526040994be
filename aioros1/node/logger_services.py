"""The services ``~get_loggers`` and ``~set_logger_level``, which rqt_logger_level calls."""

from __future__ import annotations

import contextlib
import logging
from typing import Any

from aioros1.core.context import Context
from aioros1.errors import MasterError, ServiceError
from aioros1.log.levels import LEVELS, LevelChanges, level_name
from aioros1.services.provider import ServiceProviderOptions
from aioros1.services.services import Services

__all__ = ["LoggerServices"]

_RETRY = 1.0

_MOST_CREATED = 1_000
_LONGEST_NAME = 256


class LoggerServices:
    """Reports and sets the levels of a node's loggers.

    These are its own logger, those that the option ``rosout`` names, and all below them.
    """

    def __init__(self, context: Context, services: Services, levels: LevelChanges) -> None:
        self._context = context
        self._services = services
        self._levels = levels
        self._created = 0  # loggers that did not exist when their level was set

    async def run(self) -> None:
        """Provide both services as soon as the master accepts them."""
        offered = [
            ("~get_loggers", "roscpp/GetLoggers", self._get_loggers),
            ("~set_logger_level", "roscpp/SetLoggerLevel", self._set_logger_level),
        ]
        for name, srv, handler in offered:
            while True:
                with contextlib.suppress(MasterError):
                    await self._services.advertise(name, srv, handler, ServiceProviderOptions())
                    break
                await self._context.pause(_RETRY)

    def _is_ours(self, name: str) -> bool:
        return any(name == top or name.startswith(f"{top}.") for top in self._context.loggers)

    def _get_loggers(self, request: Any) -> dict[str, Any]:
        tops = [logging.getLogger(name) for name in self._context.loggers]
        # logging keeps placeholders for names that only occur as parents of others.
        others = [
            logger
            for name, logger in sorted(logging.Logger.manager.loggerDict.copy().items())
            if isinstance(logger, logging.Logger) and self._is_ours(name)
        ]
        return {
            "loggers": [
                {"name": logger.name, "level": level_name(logger.getEffectiveLevel())}
                for logger in dict.fromkeys([*tops, *others])
            ]
        }

    def _set_logger_level(self, request: Any) -> None:
        level = request.level.lower()
        if level not in LEVELS:
            raise ServiceError(
                f"unknown level {request.level!r}, expected one of {', '.join(LEVELS)}"
            )
        # Create a logger that does not exist yet, as rospy and roscpp do: it may be used later.
        if not self._is_ours(request.logger):
            names = ", ".join(self._context.loggers)
            raise ServiceError(
                f"unknown logger {request.logger!r}, expected one of {names}, or one below"
            )
        if request.logger not in logging.Logger.manager.loggerDict:
            # Loggers stay until the process ends, with one for each dot in the name.
            if len(request.logger) > _LONGEST_NAME or self._created >= _MOST_CREATED:
                raise ServiceError(
                    f"logger {request.logger[:60]!r} does not exist, and is not created: at most "
                    f"{_MOST_CREATED} are, with names of at most {_LONGEST_NAME} characters"
                )
            self._created += 1
        self._levels.set(logging.getLogger(request.logger), LEVELS[level][0])
