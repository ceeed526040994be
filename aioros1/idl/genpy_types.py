"""What checkers can tell genpy's classes by: protocols, for annotations only."""

from __future__ import annotations

from typing import Any, Protocol

from aioros1._public import public

__all__ = ["GenpyMessage", "GenpyService"]


@public
class GenpyMessage(Protocol):
    """A message of genpy's.

    ``_check_types`` is what our messages do not have: those must not be taken for any
    message whatever where only one type of them will do.
    """

    def _check_types(self, exc: Any = None) -> Any: ...
    def serialize(self, buff: Any) -> Any:
        """Write the bytes to a file-like object, as genpy's messages do."""


@public
class GenpyService(Protocol):
    """A service type of genpy's."""

    _type: Any
    _md5sum: Any
    _request_class: Any
    _response_class: Any
