"""The loggers of a node, and the base class of its handlers on them."""

from __future__ import annotations

import logging
import weakref
from collections.abc import Callable, Iterable

__all__ = ["SilentHandler", "WeakHandler", "topmost"]


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


class WeakHandler(SilentHandler):
    """Passes records on to a method of an object that it does not keep alive.

    Loggers live as long as the process, and with them all that their handlers refer to: an
    object that was forgotten could not be collected.
    """

    def __init__(self, loggers: Iterable[logging.Logger], take: Callable[..., object]) -> None:
        super().__init__()
        self._loggers = list(loggers)
        self._take = weakref.WeakMethod(take, lambda _: self.detach())
        for logger in self._loggers:
            logger.addHandler(self)

    def detach(self) -> None:
        """Take no more records."""
        for logger in self._loggers:
            logger.removeHandler(self)
        self.close()

    def emit(self, record: logging.LogRecord) -> None:
        try:
            self.print_if_nobody_does(record)
            take = self._take()
            if take is not None:
                take(record)
        except Exception:  # a record that cannot be formatted, handled as in every handler
            self.handleError(record)


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
