"""The loggers of a node, and the base class of its handlers on them."""

from __future__ import annotations

import logging
from collections.abc import Iterable

__all__ = ["SilentHandler", "topmost"]


def topmost(names: Iterable[str]) -> list[logging.Logger]:
    """The loggers of these names, without any whose records propagate to another of them."""
    loggers = dict.fromkeys(map(logging.getLogger, names))
    return [each for each in loggers if not _reaches(each, loggers)]


class SilentHandler(logging.Handler):
    """A handler whose output does not appear in the terminal.

    logging prints warnings to standard error as long as there are no handlers. This handler
    keeps it that way, since a program may not even know that it has a node.
    """

    def print_if_nobody_does(self, record: logging.LogRecord) -> None:
        """Print the record as logging would without us, unless another handler gets it."""
        last_resort = logging.lastResort
        if last_resort is not None and record.levelno >= last_resort.level:
            handlers = _handlers(logging.getLogger(record.name))
            # Once, not for each node that gets the record.
            if handlers[:1] == [self] and all(isinstance(each, SilentHandler) for each in handlers):
                last_resort.handle(record)


def _handlers(logger: logging.Logger) -> list[logging.Handler]:
    """The handlers that get the records of ``logger``, nearest first."""
    handlers = list(logger.handlers)
    while logger.propagate and logger.parent is not None:
        logger = logger.parent
        handlers += logger.handlers
    return handlers


def _reaches(logger: logging.Logger, others: dict[logging.Logger, None]) -> bool:
    """Whether the records of ``logger`` propagate to one of ``others``."""
    while logger.propagate and logger.parent is not None:
        logger = logger.parent
        if logger in others:
            return True
    return False
