"""A log file for the loggers of a node, which roslaunch expects of each node."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterable, Iterator

from aioros1.log.loggers import SilentHandler, topmost

__all__ = ["log_to_file"]

_FORMAT = "[%(name)s][%(levelname)s] %(asctime)s: %(message)s"


@contextlib.contextmanager
def log_to_file(names: Iterable[str], path: str) -> Iterator[None]:
    """Append the records of the named loggers to a file while the block runs.

    Raises :class:`OSError` if the file cannot be opened.
    """
    handler = _LogFile(path, encoding="utf-8", errors="backslashreplace")
    handler.setFormatter(logging.Formatter(_FORMAT))
    loggers = topmost(names)
    for logger in loggers:
        logger.addHandler(handler)
    try:
        yield
    finally:
        for logger in loggers:
            logger.removeHandler(handler)
        handler.close()


class _LogFile(SilentHandler, logging.FileHandler):
    def emit(self, record: logging.LogRecord) -> None:
        self.print_if_nobody_does(record)
        super().emit(record)
