"""The short way of reading a document is the long one, wherever it is taken."""

from __future__ import annotations

import xmlrpc.client
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from aioros1.wire.xmlrpc import MAX_DEPTH, MAX_VALUES, decode_call, decode_response, encode_call
from aioros1.wire.xmlrpc_plain import read_plain
from aioros1.wire.xmlrpc_reader import UNSET, Document, reading_document

PROLOGS = [
    *("", "<?xml version='1.0'?>", '<?xml version="1.0"?>', "<?xml version='1.0\"?>"),
    *(" <?xml version='1.0'?>", "<?xml version='1.1'?>"),
]
ROOTS = ["methodCall", "methodResponse"]

PLAIN = ["", " ", "a b", "\n", "0", "1", "7", "-12", "+3", "1.5", "nan", "1e400"]
KINDS = st.sampled_from(["string", "int", "i4", "boolean", "double"])
GAPS = st.sampled_from(["", "", " ", "\n", "\r\n\t"])
ODD = [
    *("&", "&amp;", "&#13;", "]]>", "<!--x-->", "<![CDATA[y]]>", "<?pi?>", "<!DOCTYPE a>"),
    *("\r", "\r\n", "\0", "\x0b", "\x1f", "\x7f", "ü", "\u0663", "\ufffe", "_", ">", "<", "/"),
    *("<value>", "</value>", "<value/>", "<param>", "</param>", "<int>5</int>", "</i4>", "i4"),
    *("<array>", "<data>", "</data></array>", "<nil/>", "<i8>1</i8>", "<struct></struct>"),
    *("9999999999", "encoding='utf-16'", "methodCall", "methodResponse", "'", '"'),
]
TEXTS = st.sampled_from(PLAIN) | st.sampled_from(PLAIN + ODD)


@st.composite
def scalars(draw: st.DrawFn) -> str:
    text = draw(TEXTS)
    if draw(st.booleans()):
        return f"<value>{text}</value>"
    kind = draw(KINDS)
    return f"<value><{kind}>{text}</{kind}></value>"


@st.composite
def arrays(draw: st.DrawFn, inner: st.SearchStrategy[str]) -> str:
    gap = draw(GAPS)
    items = gap.join(draw(st.lists(inner, max_size=3)))
    return f"<value>{gap}<array>{gap}<data>{gap}{items}</data>{gap}</array>{gap}</value>"


VALUES = st.recursive(scalars(), arrays, max_leaves=5)


@st.composite
def documents(draw: st.DrawFn, root: str) -> bytes:
    """Documents that are right, but for an odd thing or two at some place."""
    gap = draw(GAPS)
    prolog = draw(st.sampled_from(PROLOGS))
    name = "<methodName>a.b_9</methodName>" if root == "methodCall" else ""
    values = draw(st.lists(VALUES, min_size=1, max_size=2))
    params = "".join(f"<param>{gap}{value}{gap}</param>{gap}" for value in values)
    end = draw(st.sampled_from([root] * 5 + ROOTS))
    text = f"{prolog}{gap}<{root}>{gap}{name}{gap}<params>{gap}{params}</params>{gap}</{end}>{gap}"
    for odd in draw(st.just([]) | st.lists(st.sampled_from(ODD) | st.text(max_size=1), max_size=2)):
        begin = draw(st.integers(0, len(text)))
        stop = begin + draw(st.integers(0, 6))
        text = text[:begin] + odd + text[stop:]
    return text.encode("utf-8", "replace")


def same_types(value: Any) -> Any:
    """With nan comparable, and what Python takes to be equal told apart."""
    if isinstance(value, list):
        return [same_types(item) for item in value]
    return type(value), repr(value)


def read_document(data: bytes, root: str) -> Document:
    steps = reading_document((data,), root, MAX_DEPTH, MAX_VALUES)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            document: Document = end.value
            return document


@settings(deadline=None)
@given(st.one_of([st.tuples(documents(root), st.sampled_from([root, *ROOTS])) for root in ROOTS]))
@example((b"<methodCall><params></params></methodCall>", "methodCall"))
@example((b"<methodResponse><methodName>m</methodName><params/></methodResponse>", ROOTS[1]))
def test_what_is_read_is_what_the_general_reader_reads(case: tuple[bytes, str]) -> None:
    plain = read_plain(*case, MAX_DEPTH, MAX_VALUES)
    if plain is None or (plain[0] is None) != (case[1] == "methodResponse"):
        return
    general = read_document(*case)
    assert plain[0] == general.method
    assert same_types(plain[1]) == same_types(general.params)
    assert general.fault is UNSET


WIRE = st.recursive(
    st.booleans()
    | st.integers(-(1 << 31), (1 << 31) - 1)
    | st.floats()
    | st.text("abc_/: ~.{}()[]\n\t\x7f0123456789", max_size=8),
    lambda inner: st.lists(inner, max_size=4),
    max_leaves=8,
)


def is_plain(value: Any, depth: int = 2) -> bool:
    if isinstance(value, list):
        return depth > 0 and all(is_plain(item, depth - 1) for item in value)
    return True


@settings(deadline=None)
@given(st.lists(WIRE, max_size=4))
def test_what_is_taken(values: list[Any]) -> None:
    """Scalars and two levels of lists, as we and as Python's own library write them."""
    for document in (
        encode_call("m", values),
        xmlrpc.client.dumps(tuple(values), "m").encode(),
    ):
        plain = read_plain(document, "methodCall", MAX_DEPTH, MAX_VALUES)
        assert (plain is not None) == all(map(is_plain, values))
        method, params = decode_call(document)
        assert (method, same_types(list(params))) == ("m", same_types(values))


@pytest.mark.parametrize(
    "document",
    [
        # roscpp: strings without a type, CR LF between elements
        (
            b'<?xml version="1.0"?>\r\n<methodResponse><params><param>\r\n\t<value><array><data>'
            b"<value><i4>1</i4></value><value>ok</value><value><array><data></data></array></value>"
            b"</data></array></value>\r\n</param></params></methodResponse>\r\n"
        ),
        # Python
        xmlrpc.client.dumps(([1, "ok", []],), methodresponse=True).encode(),
    ],
)
def test_answers_of_real_programs_are_taken(document: bytes) -> None:
    assert read_plain(document, "methodResponse", MAX_DEPTH, MAX_VALUES) == (None, [[1, "ok", []]])
    assert decode_response(document) == [1, "ok", []]


def test_what_is_left_to_the_general_reader() -> None:
    def response(value: str) -> bytes:
        text = f"<methodResponse><params><param>{value}</param></params></methodResponse>"
        return text.encode()

    plain = response("<value>x</value>")
    assert read_plain(plain, "methodResponse", 2, MAX_VALUES) == (None, ["x"])
    assert read_plain(plain, "methodResponse", 1, MAX_VALUES) is None
    assert read_plain(plain, "methodCall", 2, MAX_VALUES) is None
    for value in (
        "<value>ü</value>",
        "<value>&lt;</value>",
        "<value>\r</value>",
        "<value><int>5</i4></value>",
        "<value><int>five</int></value>",
        "<value>" + "x" * (64 << 10) + "</value>",
        "<value><struct></struct></value>",
        "<value/>",
    ):
        assert read_plain(response(value), "methodResponse", MAX_DEPTH, MAX_VALUES) is None, value
