"""Reads any XML-RPC document with expat, and says what is wrong with bad ones.

Document type declarations are refused, nesting is bounded and read without recursion, and
the number of values is bounded.
"""

from __future__ import annotations

import re
from collections.abc import Generator, Iterator, Sequence
from typing import Any, NoReturn
from xml.parsers import expat

from aioros1.wire.carriage_returns import CarriageReturns
from aioros1.wire.xmlrpc_scalars import (
    BLANK,
    SCALARS,
    WIDE_SCALARS,
    XmlRpcError,
    brief,
    to_bytes_so_far,
)

__all__ = ["PIECE", "UNSET", "Document", "reading_document"]

UNSET: Any = object()
"""No fault."""

_PENDING: Any = object()


def reading_document(
    chunks: Sequence[bytes], root: str, max_depth: int, max_values: int, *, wide: bool = False
) -> Generator[None, None, Document]:
    """Read what is in ``<root>``, in steps of :data:`PIECE` bytes, and return it.

    Ints may have any size if ``wide``. Raises :class:`XmlRpcError`.
    """
    decoder = Document(root, max_depth, max_values, wide)
    parser = expat.ParserCreate(_encoding(chunks))
    parser.buffer_text = True
    parser.StartElementHandler = decoder.start
    parser.EndElementHandler = decoder.end
    parser.CharacterDataHandler = decoder.text_append
    parser.StartDoctypeDeclHandler = _refuse_doctype
    parser.XmlDeclHandler = _check_encoding
    try:
        for _ in _feed(parser, chunks):
            decoder.convert_some()
            yield
    except XmlRpcError:
        raise
    except (expat.ExpatError, ValueError) as error:
        raise XmlRpcError(f"not XML: {error}") from None
    return decoder


# expat reads a tag as a whole, and its attributes take 25 times their size in memory, so a
# longer tag is refused. (expat looks for the end of a tag each time the data has doubled.)
_LONGEST_TAG = 256 << 10

PIECE = 16 << 10
"""Bytes read in one step. If they are nothing but values, that takes some 15 ms."""


def _feed(parser: expat.XMLParserType, chunks: Sequence[bytes]) -> Iterator[None]:
    returns = None
    if any(b"\r" in chunk for chunk in chunks) and not any(b"\0" in chunk for chunk in chunks):
        returns = CarriageReturns()  # not in UTF-16
    size = 0
    for chunk in chunks:
        view = memoryview(chunk)
        for begin in range(0, len(view), PIECE):
            if size:
                if size - parser.CurrentByteIndex > _LONGEST_TAG:
                    raise XmlRpcError(f"a tag or a comment of more than {_LONGEST_TAG} bytes")
                yield
            piece: bytes | memoryview = view[begin : begin + PIECE]
            if returns is not None:
                piece = returns.keep(bytes(piece))  # up to five times as long
            parser.Parse(piece, False)
            size += len(piece)
    if not size:
        raise XmlRpcError("the document is empty")
    parser.Parse(b"", True)


def _refuse_doctype(*_: object) -> NoReturn:
    raise XmlRpcError("document type declarations are refused")


# The encodings built into expat, and those that Python has a table of 256 characters for,
# which it gives to expat. For others Python would import a module of that name, and remember
# each name forever, including those that a peer invented.
_ENCODINGS = frozenset(
    (
        *("utf-8", "utf-16", "utf-16be", "utf-16le", "us-ascii", "koi8-r", "koi8-u"),
        *(f"iso-8859-{number}" for number in (*range(1, 12), *range(13, 17))),
        *(f"windows-{number}" for number in range(1250, 1259)),
    )
)
_ALIASES = {
    "utf8": "utf-8",
    "ascii": "us-ascii",
    "latin1": "iso-8859-1",
    "latin-1": "iso-8859-1",
} | {f"cp{number}": f"windows-{number}" for number in range(1250, 1259)}
_DECLARED = re.compile(
    rb"""(?:\xef\xbb\xbf)?<\?xml[^>]{0,200}?\sencoding\s*=\s*["']([^"'<>]*)["']"""
)


_DECLARATION = 300
"""Bytes of a document in which its encoding is declared."""


def _encoding(chunks: Sequence[bytes]) -> str | None:
    """The encoding that the document declares; None if expat has to find it out."""
    declared = _DECLARED.match(b"".join(chunk[:_DECLARATION] for chunk in chunks[:8]))
    return None if declared is None else _known_encoding(declared[1].decode("latin-1"))


def _known_encoding(name: str) -> str:
    known = name.strip().lower().replace("_", "-")
    known = _ALIASES.get(known, known)
    if known not in _ENCODINGS:
        raise XmlRpcError(f"not an encoding for XML-RPC: {brief(name)}")
    return known


def _check_encoding(version: str, encoding: str | None, standalone: int) -> None:
    """Also what is declared in UTF-16, which :func:`_encoding` cannot read."""
    if encoding is not None:
        _known_encoding(encoding)


# Which elements may be in which.
_CHILDREN: dict[str, frozenset[str]] = {
    "methodCall": frozenset({"methodName", "params"}),
    "methodResponse": frozenset({"params", "fault"}),
    "params": frozenset({"param"}),
    "param": frozenset({"value"}),
    "fault": frozenset({"value"}),
    "value": frozenset({*SCALARS, "array", "struct"}),
    "array": frozenset({"data"}),
    "data": frozenset({"value"}),
    "struct": frozenset({"member"}),
    "member": frozenset({"name", "value"}),
}
_NOTHING: frozenset[str] = frozenset()


class Document:
    """Builds values from expat's events. Stacks, and no recursion, follow the nesting."""

    def __init__(self, root: str, max_depth: int, max_values: int, wide: bool) -> None:
        self.method: str | None = None
        self.params: list[Any] = []
        self.fault: Any = UNSET
        self._root = root
        self._scalars = WIDE_SCALARS if wide else SCALARS
        self._max_depth = max_depth
        self._max_values = max_values
        self._values_left = max_values
        self._tags: list[str] = []
        self._sections: set[str] = set()
        self._closed_params = 0
        self._text: list[str] = []
        self.text_append = self._text.append
        self._bytes = bytearray()  # what was converted already of a base64 text
        # One entry for each open <value>: what it holds so far.
        self._values: list[Any] = []
        # One for each open <data> or <struct>: the list or dict it fills.
        self._containers: list[Any] = []
        # One [name, value] for each open <member>.
        self._members: list[list[Any]] = []

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        tags = self._tags
        if ":" in tag:  # in a name space, as the extensions of Apache's are
            tag = tag.rpartition(":")[2]
        if attributes:  # there are none in XML-RPC, but some programs declare name spaces
            self._count(len(attributes))
        if not tags:
            if tag != self._root:
                raise XmlRpcError(f"expected a {self._root}, got a <{tag[:40]}>")
        else:
            parent = tags[-1]
            if tag not in _CHILDREN.get(parent, _NOTHING):
                self._fail(f"<{tag[:40]}> inside <{parent}>")
            if tag == "value":
                self._count(1)
                self._values.append(UNSET)
            elif parent == "value":
                if self._values[-1] is not UNSET or "".join(self._text).strip(BLANK):
                    self._fail(f"<{tag}> beside another value")
                if tag == "array":
                    self._values[-1] = _PENDING
                elif tag == "struct":
                    self._open({})
            elif tag == "member":
                self._members.append([UNSET, UNSET])
            elif tag == "data":
                if self._values[-1] is not _PENDING:
                    self._fail("an array with two data elements")
                self._open([])
            elif parent == self._root:
                if tag in self._sections:
                    self._fail(f"two {tag} elements")
                self._sections.add(tag)
        tags.append(tag)
        self._text.clear()

    def convert_some(self) -> None:
        """Convert what has come of a long base64 text, which takes too long in one step."""
        if self._tags and self._tags[-1] == "base64":
            try:
                done, rest = to_bytes_so_far("".join(self._text))
            except ValueError as error:
                self._fail(str(error))
            if done:
                self._bytes += done
                self._text[:] = [rest]

    def end(self, _: str) -> None:
        tag = self._tags.pop()
        if tag == "value":
            value = self._values.pop()
            if value is UNSET:
                value = "".join(self._text)
            elif self._text and "".join(self._text).strip(BLANK):
                self._fail("text beside a value")
            self._put(value)
        elif (convert := self._scalars.get(tag)) is not None:
            try:
                self._values[-1] = convert("".join(self._text))
            except ValueError as error:
                self._fail(str(error))
            if self._bytes and tag == "base64":
                rest: Any = self._values[-1]
                self._values[-1] = b"".join((self._bytes, rest))
                self._bytes.clear()
        elif tag == "name":
            if self._members[-1][0] is not UNSET:
                self._fail("a member with two names")
            self._members[-1][0] = "".join(self._text)
        elif tag == "member":
            name, value = self._members[-1]
            if name is UNSET or value is UNSET:
                self._fail("a member without a " + ("name" if name is UNSET else "value"))
            self._members.pop()
            self._containers[-1][name] = value
        elif tag in ("data", "struct"):
            self._containers.pop()
        elif tag == "array":
            if self._values[-1] is _PENDING:  # <array/>, as Python's parser takes it
                self._values[-1] = []
        elif tag == "param":
            self._closed_params += 1
            if len(self.params) != self._closed_params:
                raise XmlRpcError(f"params[{self._closed_params - 1}]: a param has one value")
        elif tag == "methodName":
            self.method = "".join(self._text).strip(BLANK)
        self._text.clear()

    def _open(self, container: list[Any] | dict[str, Any]) -> None:
        if len(self._containers) >= self._max_depth:
            self._fail(f"more than {self._max_depth} arrays and structs inside one another")
        self._values[-1] = container
        self._containers.append(container)

    def _count(self, values: int) -> None:
        self._values_left -= values
        if self._values_left < 0:
            self._fail(f"more than {self._max_values} values or attributes in one document")

    def _put(self, value: Any) -> None:
        parent = self._tags[-1]
        if parent == "data":
            self._containers[-1].append(value)
        elif parent == "member":
            if self._members[-1][1] is not UNSET:
                self._fail("a member with two values")
            self._members[-1][1] = value
        elif parent == "param":
            self.params.append(value)
        elif self.fault is UNSET:
            self.fault = value
        else:
            raise XmlRpcError("a fault with two values")

    def _fail(self, text: str) -> NoReturn:
        raise XmlRpcError(f"{self._place()}: {text}")

    def _place(self) -> str:
        if len(self._tags) < 3:
            return self._root
        if self._tags[1] == "fault":
            place = "fault"
        else:
            place = f"params[{self._closed_params}]" if self._root == "methodCall" else "result"
        members = iter(self._members)
        for container in self._containers:
            if isinstance(container, list):
                place += f"[{len(container)}]"
            elif (member := next(members, None)) is not None and member[0] is not UNSET:
                place += f"[{brief(member[0])}]"
        return place
