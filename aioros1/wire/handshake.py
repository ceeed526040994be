"""The handshakes of TCPROS: the headers that all four sides exchange before messages.

A connection starts with the connecting side sending a header; the accepting side
answers with one, or with one that holds only ``error`` and closes. The classes here
take and give bytes and know nothing of sockets:

* :class:`TopicClient`: a subscriber, which connects to a publisher.
* :class:`ServiceClient`: a service caller, which connects to a provider.
* :class:`Server`: the accepting side of both, which learns from the header what is
  asked for and then accepts or refuses.

The fields sent are those that rospy and roscpp send, and no others: some programs close the
connection on a field that they do not expect. The fields required are those that rospy and
roscpp require.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

from aioros1.errors import HandshakeError
from aioros1.quoting import printable
from aioros1.wire.header import HeaderError, HeaderParser, encode_header

__all__ = ["Server", "ServiceClient", "ServiceOffer", "TopicClient", "TopicOffer"]


def _is_true(value: str | None) -> bool:
    return value is not None and value.strip().lower() in ("1", "true")


MAX_NAME = 1_024
"""Characters of the name of a node, a topic, a service or a type."""

_NAMES = ("callerid", "topic", "service", "type", "md5sum")


@dataclass(frozen=True, slots=True)
class TopicOffer:
    """What a node publishes on a topic, or wants to receive from it."""

    topic: str
    """The resolved name of the topic."""
    type: str
    """``pkg/Type``."""
    md5sum: str
    """The MD5 sum of the definition."""
    definition: str
    """The full text of the definition."""
    latching: bool = False
    """Whether new subscribers get the last message at once."""


@dataclass(frozen=True, slots=True)
class ServiceOffer:
    """A service that a node provides, or wants to call."""

    service: str
    """The resolved name of the service."""
    type: str
    """``pkg/Type``."""
    md5sum: str
    """The MD5 sum of the definition."""


class _Side(ABC):
    """Receives one header. ``peer`` names the other side in errors."""

    def __init__(self, peer: str, *, max_bytes: int, max_fields: int) -> None:
        self.peer = peer
        """What the other side is called in errors."""
        self._parser = HeaderParser(max_bytes=max_bytes, max_fields=max_fields)
        self.header: dict[str, str] = {}
        """The header of the other side, once it is complete."""

    def __repr__(self) -> str:
        state = "has its header" if self.header else "waits for its header"
        return f"<{type(self).__name__}: {self._wish()} {self.peer}, {state}>"

    @abstractmethod
    def _wish(self) -> str:
        """What is between the two sides, for the text of ``repr``."""

    @property
    def missing(self) -> int:
        """Bytes that can be read without taking any that follow the header."""
        try:
            return self._parser.missing()
        except HeaderError as error:
            raise HandshakeError(self.peer, str(error)) from None

    def receive_data(self, data: bytes) -> bool:
        """Take bytes, and return True once the header of the other side is complete.

        Empty ``data`` means that the other side closed the connection. Raises
        :class:`~aioros1.HandshakeError`.
        """
        if not data:
            raise HandshakeError(self.peer, "closed the connection instead of sending a header")
        try:
            header = self._parser.feed(data)
        except HeaderError as error:
            raise HandshakeError(self.peer, f"bad connection header: {error}") from None
        if header is None:
            return False
        for name in _NAMES:
            if len(header.get(name, "")) > MAX_NAME:
                raise self._fail(f"the {name} has more than {MAX_NAME} characters")
        self.header = header
        self._check(header)
        return True

    @abstractmethod
    def _check(self, header: dict[str, str]) -> None: ...

    def _fail(self, text: str) -> HandshakeError:
        return HandshakeError(self.peer, text)


class _Client(_Side):
    """The side that connects and speaks first."""

    def data_to_send(self) -> bytes:
        """The header to send, before anything is received."""
        return encode_header(self._request())

    @abstractmethod
    def _request(self) -> dict[str, str]: ...

    def _check_md5sum(self, ours: str, what: str) -> None:
        # rospy and roscpp do not look at the md5sum here, and decode the messages as a type
        # that they are not.
        theirs = self.header.get("md5sum")
        if theirs is not None and ours != theirs and "*" not in (ours, theirs):
            raise self._fail(
                f"{what} is {printable(self.header.get('type', '?'))} with md5sum "
                f"{printable(theirs)} there, "
                f"and has md5sum {ours} here"
            )


class TopicClient(_Client):
    """A subscriber's side. ``wanted.md5sum`` and ``wanted.type`` may be ``*``."""

    def __init__(
        self,
        peer: str,
        caller_id: str,
        wanted: TopicOffer,
        *,
        tcp_nodelay: bool = True,
        max_bytes: int = 1 << 20,
        max_fields: int = 256,
    ) -> None:
        super().__init__(peer, max_bytes=max_bytes, max_fields=max_fields)
        self.caller_id = caller_id
        """The name of our node."""
        self.wanted = wanted
        """The topic to ask for."""
        self.tcp_nodelay = tcp_nodelay
        """Whether to ask for small messages to be sent at once."""

    def _wish(self) -> str:
        return f"topic {self.wanted.topic} of"

    def _request(self) -> dict[str, str]:
        wanted = self.wanted
        fields = {
            "callerid": self.caller_id,
            "md5sum": wanted.md5sum,
            "tcp_nodelay": "1" if self.tcp_nodelay else "0",
            "topic": wanted.topic,
            "type": wanted.type,
        }
        # rospy sends an empty one, too, on which cROS and clients in Java give up. roscpp
        # sends none at all.
        if wanted.definition:
            fields["message_definition"] = wanted.definition
        return fields

    def _check(self, header: dict[str, str]) -> None:
        if "error" in header:
            raise self._fail(header["error"])
        for name in ("md5sum", "type"):
            if name not in header:
                raise self._fail(f"its header has no {name}; it has {printable(sorted(header))}")
        self._check_md5sum(self.wanted.md5sum, f"topic {self.wanted.topic}")

    @property
    def agreed(self) -> TopicOffer:
        """What the publisher announced."""
        header = self.header
        return TopicOffer(
            topic=self.wanted.topic,
            type=header["type"],
            md5sum=header["md5sum"],
            definition=header.get("message_definition", ""),
            latching=_is_true(header.get("latching")),
        )


class ServiceClient(_Client):
    """A service caller's side. ``probe`` only asks whether the service is there."""

    def __init__(
        self,
        peer: str,
        caller_id: str,
        wanted: ServiceOffer,
        *,
        persistent: bool = False,
        probe: bool = False,
        max_bytes: int = 1 << 20,
        max_fields: int = 256,
    ) -> None:
        super().__init__(peer, max_bytes=max_bytes, max_fields=max_fields)
        self.caller_id = caller_id
        """The name of our node."""
        self.wanted = wanted
        """The service to ask for."""
        self.persistent = persistent
        """Whether to ask for a connection that carries several calls."""
        self.probe = probe
        """Whether to ask only if the service is there."""

    def _wish(self) -> str:
        return f"service {self.wanted.service} of"

    def _request(self) -> dict[str, str]:
        # No type: rospy and roscpp send none, and cROS closes on a probe that has one.
        fields = {
            "callerid": self.caller_id,
            "md5sum": self.wanted.md5sum,
            "service": self.wanted.service,
        }
        if self.persistent:
            fields["persistent"] = "1"
        if self.probe:
            fields["probe"] = "1"
        return fields

    def _check(self, header: dict[str, str]) -> None:
        if "error" in header:
            raise self._fail(header["error"])
        self._check_md5sum(self.wanted.md5sum, f"service {self.wanted.service}")


class Server(_Side):
    """The accepting side, of topics and services on one port.

    Once :meth:`receive_data` has returned True, :attr:`topic` or :attr:`service` names what
    the client asks for. :meth:`accept_topic`, :meth:`accept_service` and :meth:`refuse`
    return the bytes to answer with.
    """

    def _wish(self) -> str:
        if not self.header:
            return "a connection of"
        topic, service = self.topic, self.service
        return f"topic {topic} to" if topic is not None else f"service {service} to"

    def _check(self, header: dict[str, str]) -> None:
        if "callerid" in header:
            self.peer = f"{printable(self.caller_id)} at {self.peer}"
        for name in ("callerid", "md5sum"):
            if name not in header:
                raise self._fail(f"the connection header has no {name}")
        if "topic" not in header and "service" not in header:
            raise self._fail("the connection header has neither topic nor service")

    @property
    def caller_id(self) -> str:
        """The name of the node that connects, which may be any text."""
        return self.header.get("callerid", "")

    @property
    def topic(self) -> str | None:
        """The topic asked for; None if it is a service."""
        return self.header.get("topic")

    @property
    def service(self) -> str | None:
        """The service asked for; None if it is a topic. A client that names both asks for the
        topic, as from rospy and roscpp."""
        return None if "topic" in self.header else self.header.get("service")

    @property
    def persistent(self) -> bool:
        """Whether the caller wants to call several times."""
        return _is_true(self.header.get("persistent"))

    @property
    def probe(self) -> bool:
        """Whether the caller only asks if the service is there."""
        return _is_true(self.header.get("probe"))

    def accept_topic(
        self, caller_id: str, offer: TopicOffer, extra: Mapping[str, str] | None = None
    ) -> bytes:
        """Accept a subscriber. ``extra`` fields never replace the standard ones.

        Raises :class:`~aioros1.HandshakeError` if it expects another definition. A type of
        another name with the same md5sum is accepted, as by rospy and roscpp, because
        renamed packages rely on it.
        """
        self._check_md5sum(f"topic {offer.topic}", offer.type, offer.md5sum)
        return encode_header(
            {
                **(extra or {}),
                "callerid": caller_id,
                "latching": "1" if offer.latching else "0",
                "md5sum": offer.md5sum,
                "message_definition": offer.definition,
                "topic": offer.topic,
                "type": offer.type,
            }
        )

    def accept_service(self, caller_id: str, offer: ServiceOffer) -> bytes:
        """Accept a service caller. Raises as :meth:`accept_topic` does."""
        self._check_md5sum(f"service {offer.service}", offer.type, offer.md5sum)
        if offer.md5sum == "*":
            # A provider of any type is of the type that the caller wants: some look.
            wanted = self.header.get("type", "*")
            offer = ServiceOffer(offer.service, wanted, self.header["md5sum"])
        # rospy sends `service`, roscpp the two type names; each understands both.
        return encode_header(
            {
                "callerid": caller_id,
                "md5sum": offer.md5sum,
                "request_type": f"{offer.type}Request",
                "response_type": f"{offer.type}Response",
                "service": offer.service,
                "type": offer.type,
            }
        )

    def refuse(self, text: str) -> bytes:
        """Refuse the client and say why; close the connection after sending this."""
        return encode_header({"error": text})

    def _check_md5sum(self, what: str, type: str, md5sum: str) -> None:
        theirs = self.header["md5sum"]
        if theirs != md5sum and "*" not in (theirs, md5sum):
            named = f"as {printable(self.header['type'])} " if "type" in self.header else ""
            raise self._fail(
                f"client {printable(self.caller_id)} wants {what} {named}with "
                f"md5sum {printable(theirs)}, but it is {type} with md5sum {md5sum} here"
            )
