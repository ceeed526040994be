"""Every exception class that this library defines.

::

    RosError
    ├── InvalidNameError (ValueError)
    ├── MessageError
    │   ├── MessageNotFoundError (LookupError)
    │   ├── MessageSpecError
    │   ├── SerializationError
    │   ├── DeserializationError
    │   └── Md5MismatchError
    ├── MasterError
    │   └── MasterUnreachable (ConnectionError)
    ├── PeerError
    │   └── PeerUnreachable (ConnectionError)
    ├── HandshakeError
    ├── ServiceError
    │   ├── ServiceNotFound
    │   └── ServiceUnavailable (ConnectionError)
    └── ClosedError

Waiting too long raises the builtin :class:`TimeoutError`, reading an empty queue
:class:`asyncio.QueueEmpty`, and writing to a full one :class:`asyncio.QueueFull`.
"""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import Self

from aioros1._public import public

__all__ = [
    "ClosedError",
    "DeserializationError",
    "HandshakeError",
    "InvalidNameError",
    "MasterError",
    "MasterUnreachable",
    "Md5MismatchError",
    "MessageError",
    "MessageNotFoundError",
    "MessageSpecError",
    "PeerError",
    "PeerUnreachable",
    "RosError",
    "SerializationError",
    "ServiceError",
    "ServiceNotFound",
    "ServiceUnavailable",
]


@public
class RosError(Exception):
    """The base of all errors of this library."""


@public
class InvalidNameError(RosError, ValueError):
    """A graph resource name or a ``pkg/Type`` that ROS does not allow."""


@public
class MessageError(RosError):
    """Something is wrong with a message, a service or their definition."""


@public
class MessageNotFoundError(MessageError, LookupError):
    """No definition of that type was found in any of the places searched.

    ``places`` are the directories, in search order; None when the definition should have
    been elsewhere. ``suggestions`` are types with similar names, the likest first.
    """

    def __init__(
        self, text: str, places: Sequence[str] | None = None, suggestions: Sequence[str] = ()
    ) -> None:
        super().__init__(text, places, suggestions)
        self.text = text
        """What was not found, without the places."""
        self.places = places
        self.suggestions = suggestions

    def __str__(self) -> str:
        text = self.text
        if self.places is not None:
            text += f"; searched: {', '.join(self.places) or 'no directory'}"
        if self.suggestions:
            text += f"; did you mean {' or '.join(self.suggestions)}?"
        return text


@public
class MessageSpecError(MessageError):
    """A definition cannot be read.

    ``path`` is the file (or the type name, for text that is not from a file). ``line`` is
    the number of the offending line, counted from 1 (0 when no single line is at fault).
    """

    def __init__(self, text: str, *, path: str | PathLike[str] = "", line: int = 0) -> None:
        self.text = text
        """What is wrong, without the place."""
        self.path = str(path)
        self.line = line
        place = f"{self.path}:{line}" if line else self.path
        super().__init__(f"{place}: {text}" if place else text)


@public
class SerializationError(MessageError):
    """A value does not fit its field; the text begins with the field's path."""


@public
class DeserializationError(MessageError):
    """The bytes are not a message of this type."""


@public
class Md5MismatchError(MessageError):
    """Two peers, or two roles of one node, have different definitions of the same type."""


@public
class MasterError(RosError):
    """The master refused a request.

    ``code`` is 0 or -1 from the reply, or the code of an XML-RPC fault. ``status`` describes the
    request and its recipient, and contains the master's own text. ``is_refusal`` is False when
    the master did not judge the request: there was a fault, or no valid answer of a master.
    """

    def __init__(self, code: int, status: str, *, is_refusal: bool = True) -> None:
        super().__init__(code, status)
        self.code = code
        self.status = status
        self.is_refusal = is_refusal

    def __str__(self) -> str:
        return f"{self.status} (code {self.code})"


@public
class MasterUnreachable(MasterError, ConnectionError):
    """No master answers at the master's URI."""

    def __init__(self, status: str) -> None:
        super().__init__(-1, status, is_refusal=False)

    def __reduce__(self) -> tuple[type[Self], tuple[str]]:
        return type(self), (self.status,)

    def __str__(self) -> str:
        return self.status


@public
class PeerError(RosError):
    """Another node refused a request of the slave API; like :class:`MasterError`."""

    def __init__(self, code: int, status: str, *, is_refusal: bool = True) -> None:
        super().__init__(code, status)
        self.code = code
        """0 or -1 from the answer, or the code of an XML-RPC fault."""
        self.status = status
        """The request and its recipient, and the other node's own text."""
        self.is_refusal = is_refusal
        """False when the node did not judge the request: there was a fault, or no valid answer
        of a node."""

    def __str__(self) -> str:
        return f"{self.status} (code {self.code})"


@public
class PeerUnreachable(PeerError, ConnectionError):
    """No node answers at the node's URI."""

    def __init__(self, status: str) -> None:
        super().__init__(-1, status, is_refusal=False)

    def __reduce__(self) -> tuple[type[Self], tuple[str]]:
        return type(self), (self.status,)

    def __str__(self) -> str:
        return self.status


@public
class HandshakeError(RosError):
    """The handshake of a TCPROS connection failed.

    ``peer`` names the other side. ``text`` is its ``error=`` text, or what is wrong with what
    it sent.
    """

    def __init__(self, peer: str, text: str) -> None:
        super().__init__(peer, text)
        self.peer = peer
        self.text = text

    def __str__(self) -> str:
        return f"{self.peer}: {self.text}"


@public
class ServiceError(RosError):
    """A service call failed; ``text`` is what the server said."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.text = text


@public
class ServiceNotFound(ServiceError):
    """The master knows no provider of that service."""


@public
class ServiceUnavailable(ServiceError, ConnectionError):
    """The provider cannot be reached, or the connection was lost before it answered."""


@public
class ClosedError(RosError):
    """The node or role was closed before or during the operation."""
