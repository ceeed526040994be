"""The file that ``__log:=`` names, as roslaunch does for each node that it starts."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from typing import TYPE_CHECKING

from aioros1.log.loggers import Unseen, loggers_of
from aioros1.names import parse_args

if TYPE_CHECKING:
    from aioros1.node import Node

__all__ = ["log_file"]

_FORMAT = "[%(name)s][%(levelname)s] %(asctime)s: %(message)s"


@contextlib.contextmanager
def log_file(node: Node) -> Iterator[None]:
    """What goes to ``/rosout`` is appended to the file as well, if a word of the command
    line names one; if it cannot be opened, a warning says so."""
    path = parse_args(node.options.argv or ()).special.get("__log")
    if not path:
        yield
        return
    try:
        handler = _LogFile(path, encoding="utf-8", errors="backslashreplace")
    except OSError as error:
        node.log.warning("__log:=%s: no log is written there: %s", path, error)
        yield
        return
    handler.setFormatter(logging.Formatter(_FORMAT))
    loggers = loggers_of(node)
    for logger in loggers:
        logger.addHandler(handler)
    try:
        yield
    finally:
        for logger in loggers:
            logger.removeHandler(handler)
        handler.close()


class _LogFile(Unseen, logging.FileHandler):
    def emit(self, record: logging.LogRecord) -> None:
        self.print_if_nobody_does(record)
        super().emit(record)
