"""Which loggers are a node's, and what its handlers on them have in common."""

from __future__ import annotations

import logging
from collections.abc import Iterable

__all__ = ["SilentHandler", "topmost"]


def topmost(names: Iterable[str]) -> list[logging.Logger]:
    """The loggers of these names, without any that hands its records on to another of them."""
    loggers = dict.fromkeys(map(logging.getLogger, names))
    return [each for each in loggers if not _reaches(each, loggers)]


class SilentHandler(logging.Handler):
    """A handler whose work nobody sees who looks at a terminal.

    logging prints warnings on standard error as long as there is no handler at all. To have
    a node, of which a program may know nothing, is no reason to be silent.
    """

    def print_if_nobody_does(self, record: logging.LogRecord) -> None:
        """As logging does, which takes us for somebody who shows it."""
        last_resort = logging.lastResort
        if last_resort is not None and record.levelno >= last_resort.level:
            handlers = _handlers(logging.getLogger(record.name))
            # Once, and not for each node that hears of it.
            if handlers[:1] == [self] and all(isinstance(each, SilentHandler) for each in handlers):
                last_resort.handle(record)


def _handlers(logger: logging.Logger) -> list[logging.Handler]:
    """All that the records of ``logger`` are given to, the nearest first."""
    handlers = list(logger.handlers)
    while logger.propagate and logger.parent is not None:
        logger = logger.parent
        handlers += logger.handlers
    return handlers


def _reaches(logger: logging.Logger, others: dict[logging.Logger, None]) -> bool:
    """Whether the records of ``logger`` are handed on to one of ``others``."""
    while logger.propagate and logger.parent is not None:
        logger = logger.parent
        if logger in others:
            return True
    return False
