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
    │   ├── MasterUnreachable (ConnectionError)
    │   └── NodeNotFound (LookupError)
    ├── PeerError
    │   └── PeerUnreachable (ConnectionError)
    ├── HandshakeError
    ├── ServiceError
    │   ├── ServiceNotFound
    │   └── ServiceUnavailable (ConnectionError)
    └── ClosedError

Waiting too long raises the builtin :class:`TimeoutError`, reading an empty queue
:class:`asyncio.QueueEmpty`, and writing to a full one :class:`asyncio.QueueFull`.

What a peer said becomes part of an error only as :func:`~aioros1.quoting.printable` shows it,
so the text of an error is one line of bounded length, whoever wrote it.
"""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import Self

from aioros1._public import public
from aioros1.quoting import printable

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
    "NodeNotFound",
    "PeerError",
    "PeerUnreachable",
    "RosError",
    "SerializationError",
    "ServiceError",
    "ServiceNotFound",
    "ServiceUnavailable",
]


_LONGEST = 2000
"""Characters of the whole text of an error, which may quote several things."""


@public
class RosError(Exception):
    """The base of all errors of this library.

    Its text is one line. Line ends and other invisible characters in it are escaped, since
    parts of it may come from a peer, and it is cut after 2,000 characters.
    """

    def __init__(self, *args: object) -> None:
        super().__init__(*(printable(a, _LONGEST) if isinstance(a, str) else a for a in args))


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
        self.text = printable(text, _LONGEST)
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
    """A value does not fit its field; the text begins with the field's path.

    It ends with the type of the message and, if the message was to be sent, with the topic or
    service, in parentheses.
    """

    def locate(self, type: str, place: str = "") -> Self:
        """Say which type, and where it was to be sent; return the error itself."""
        text = str(self.args[0]).removesuffix(f" ({type})")
        self.args = (f"{text} ({type} {place})" if place else f"{text} ({type})",)
        return self


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
    ``is_fault`` is True for a fault, and ``is_answer`` if [code, status, value] came, whatever
    it says: a fault may come from any server, and this only from a master.
    """

    def __init__(
        self,
        code: int,
        status: str,
        *,
        is_refusal: bool = True,
        is_fault: bool = False,
        is_answer: bool = False,
    ) -> None:
        super().__init__(code, status)
        status = printable(status, _LONGEST)
        self.code = code
        self.status = status
        self.is_refusal = is_refusal
        self.is_fault = is_fault
        self.is_answer = is_answer or is_refusal

    def __str__(self) -> str:
        return self.in_short

    @property
    def in_short(self) -> str:
        """What went wrong, without advice."""
        return f"{self.status} (code {self.code})"


@public
class MasterUnreachable(MasterError, ConnectionError):
    """No master answers at the master's URI.

    ``status`` says what was tried and what came of it, and ``advice`` what you can do.
    ``was_sent`` is False if the request certainly never reached a master.
    """

    def __init__(self, status: str, *, advice: str = "", was_sent: bool = True) -> None:
        super().__init__(-1, status, is_refusal=False)
        self.advice = advice
        self.was_sent = was_sent

    def __reduce__(self) -> tuple[type[Self], tuple[str], dict[str, object]]:
        return type(self), (self.status,), vars(self)

    def __str__(self) -> str:
        return f"{self.status}; {self.advice}" if self.advice else self.status

    @property
    def in_short(self) -> str:
        return self.status


@public
class NodeNotFound(MasterError, LookupError):
    """The master knows no node of that name."""

    @property
    def in_short(self) -> str:
        return self.status


@public
class PeerError(RosError):
    """Another node refused a request of the slave API; like :class:`MasterError`."""

    def __init__(
        self,
        code: int,
        status: str,
        *,
        is_refusal: bool = True,
        is_fault: bool = False,
        is_answer: bool = False,
    ) -> None:
        super().__init__(code, status)
        status = printable(status, _LONGEST)
        self.code = code
        """0 or -1 from the answer, or the code of an XML-RPC fault."""
        self.status = status
        """The request and its recipient, and the other node's own text."""
        self.is_refusal = is_refusal
        """False when the node did not judge the request: there was a fault, or no valid answer
        of a node."""
        self.is_fault = is_fault
        """Whether there was a fault."""
        self.is_answer = is_answer or is_refusal
        """Whether the node has answered [code, status, value], whatever it says."""

    def __str__(self) -> str:
        return f"{self.status} (code {self.code})"


@public
class PeerUnreachable(PeerError, ConnectionError):
    """No node answers at the node's URI.

    ``was_lost`` is True if the connection was lost before the answer came. The node may have
    done what it was asked for.
    """

    def __init__(self, status: str, *, was_lost: bool = False) -> None:
        super().__init__(-1, status, is_refusal=False)
        self.was_lost = was_lost

    def __reduce__(self) -> tuple[type[Self], tuple[str], dict[str, object]]:
        return type(self), (self.status,), vars(self)

    def __str__(self) -> str:
        return self.status


@public
class HandshakeError(RosError):
    """The handshake of a TCPROS connection failed.

    ``peer`` names the other side. ``text`` is its ``error=`` text, as it said it, or what is
    wrong with what it sent.
    """

    def __reduce__(self) -> tuple[type[Self], tuple[str, str]]:
        return type(self), (self.peer, self.text)

    def __init__(self, peer: str, text: str) -> None:
        super().__init__(peer, text)
        self.peer = printable(peer)
        self.text = text

    def __str__(self) -> str:
        return f"{self.peer}: {printable(self.text, _LONGEST)}"


@public
class ServiceError(RosError):
    """A service call failed; ``text`` is what the server said, as it said it.

    The text of the error itself is safe to log, as that of every :class:`RosError`.
    """

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.text = text

    def __reduce__(self) -> tuple[type[Self], tuple[str]]:
        return type(self), (self.text,)


@public
class ServiceNotFound(ServiceError):
    """The master knows no provider of that service."""


@public
class ServiceUnavailable(ServiceError, ConnectionError):
    """The provider cannot be reached, or the connection was lost before it answered."""


@public
class ClosedError(RosError):
    """The node or role was closed before or during the operation."""
