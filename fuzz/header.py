"""Connection headers: the fields, the parser that is fed in pieces, and all four sides."""

from __future__ import annotations

from collections.abc import Iterator

from aioros1.errors import HandshakeError
from aioros1.wire.handshake import Server, ServiceClient, ServiceOffer, TopicClient, TopicOffer
from aioros1.wire.header import HeaderError, HeaderParser, decode_header, encode_header

__all__ = ["check", "seeds"]

TOKENS = [
    *(b"callerid=/a", b"md5sum=*", b"topic=/t", b"service=/s", b"type=p/T", b"error=no"),
    *(b"persistent=1", b"probe=1", b"latching=1", b"message_definition=", b"tcp_nodelay=1", b"="),
    *(b"\x0b\0\0\0callerid=/a", b"\x08\0\0\0md5sum=*", b"\x08\0\0\0topic=/t"),
]
MAX_LEN = 512
SHARE = 16

_LIMITS = {"max_bytes": 400, "max_fields": 8}
_TOPIC = TopicOffer("/t", "p/T", "abc", "int8 a")
_SERVICE = ServiceOffer("/s", "p/S", "abc")


def check(data: bytes) -> None:
    """The first octet is the size of the pieces that the others come in."""
    if not data:
        return
    piece, data = data[0] or 1 << 30, data[1:]
    _check_fields(data)
    fields, rest = _check_parser(data, piece)
    _check_sides(data, piece, fields, rest)


def _check_fields(data: bytes) -> None:
    try:
        fields = decode_header(data, max_fields=_LIMITS["max_fields"])
    except HeaderError as error:
        assert str(error), "an error without a word"
        return
    assert len(fields) <= _LIMITS["max_fields"]
    octets = encode_header(fields)
    assert decode_header(octets[4:]) == fields
    assert len(octets) <= 4 + len(data)


def _check_parser(data: bytes, piece: int) -> tuple[dict[str, str] | None, bytes]:
    """What the parser says, fed in pieces; the same as when fed at once."""
    results = []
    for size in (piece, len(data) or 1):
        parser = HeaderParser(**_LIMITS)
        fields, fed = None, 0
        try:
            while fields is None and fed < len(data):
                assert parser.missing() > 0
                fields = parser.feed(data[fed : fed + size])
                fed += size
        except HeaderError:
            results.append((None, b""))
            continue
        if fields is None:
            assert parser.rest == data
            results.append((None, b""))
        else:
            length = int.from_bytes(data[:4], "little")
            assert 0 < length <= _LIMITS["max_bytes"]
            assert fields == decode_header(data[4 : 4 + length])
            results.append((fields, parser.rest + data[fed:]))
            assert results[-1][1] == data[4 + length :]
    assert results[0] == results[1], "the pieces make a difference"
    return results[0]


def _check_sides(data: bytes, piece: int, fields: dict[str, str] | None, rest: bytes) -> None:
    server = Server("peer", **_LIMITS)
    topic = TopicClient("peer", "/me", _TOPIC, **_LIMITS)
    service = ServiceClient("peer", "/me", _SERVICE, **_LIMITS)
    for side in (server, topic, service):
        done, fed = False, 0
        try:
            while not done and fed < len(data):
                assert side.missing > 0
                done = side.receive_data(data[fed : fed + piece])
                fed += piece
        except HandshakeError as error:
            assert str(error).strip(), "an error without a word"
            assert len(str(error)) < 2000 + 8 * len(data)
            continue
        assert done is (fields is not None)
        if fields is None:
            continue
        assert side.header == fields
        if side is topic:
            assert topic.agreed.type == fields["type"]
        elif side is server:
            _check_answer(server)


def _check_answer(server: Server) -> None:
    """Asked for something it has, a server answers with a header, or refuses with one."""
    assert (server.topic is None) is (server.service is not None)
    assert isinstance(server.persistent and server.probe, bool)
    try:
        if server.topic is not None:
            answer = server.accept_topic("/me", _TOPIC)
        else:
            answer = server.accept_service("/me", _SERVICE)
    except HandshakeError as error:
        answer = server.refuse(str(error))
        assert "error" in decode_header(answer[4:])
        return
    assert decode_header(answer[4:])["callerid"] == "/me"


def seeds() -> Iterator[bytes]:
    topic = TopicClient("peer", "/me", _TOPIC).data_to_send()
    service = ServiceClient("peer", "/me", _SERVICE, persistent=True, probe=True).data_to_send()
    server = Server("peer", **_LIMITS)
    server.receive_data(topic)
    answer = server.accept_topic("/pub", _TOPIC)
    for octets in (topic, service, answer, server.refuse("no such topic")):
        for piece in (b"\0", b"\1", b"\7"):
            yield piece + octets
            yield piece + octets + b"\4\0\0\0abcd"
            yield piece + octets[:-3]
            yield piece + octets[4:]
