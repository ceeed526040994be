"""XML-RPC documents: what is understood, what is refused, and what is sent."""

from __future__ import annotations

import encodings
import enum
import math
import xmlrpc.client
from datetime import datetime
from typing import Any, NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.wire.carriage_returns import CarriageReturns, with_references
from aioros1.wire.xmlrpc import (
    MAX_DEPTH,
    XmlRpcError,
    XmlRpcFault,
    decode_call,
    decode_response,
    encode_call,
    encode_fault,
    encode_response,
)


def value_of(inner: str, head: str = "<?xml version='1.0'?>") -> Any:
    """What a ``<value>`` with that inside is read as."""
    text = f"{head}<methodCall><methodName>m</methodName><params><param><value>{inner}</value>"
    method, params = decode_call((text + "</param></params></methodCall>").encode())
    assert method == "m"
    assert len(params) == 1
    return params[0]


def call_with(params: str) -> bytes:
    return f"<methodCall><methodName>m</methodName>{params}</methodCall>".encode()


def there_and_back(value: Any) -> Any:
    return decode_response(encode_response(value))


# ------------------------------------------------------------------------------- reading


@pytest.mark.parametrize(
    "document",
    [
        b"",
        b" ",
        b"no xml",
        b"<methodCall>",
        b"<methodCall></methodCall>",
        b"<methodResponse><params><param><value/></param></params></methodResponse>",
        b"<html/>",
        b"<?xml version='1.0' encoding='no-such'?><methodCall/>",
        b"\xff\xfe\x00",
        call_with("<params><value/></params>"),
        call_with("<params><param></param></params>"),
        call_with("<params><param><value/><value/></param></params>"),
        call_with("<params/><params/>"),
        call_with("") + b"x",
    ],
)
def test_malformed_documents_are_refused(document: bytes) -> None:
    with pytest.raises(XmlRpcError):
        decode_call(document)


def test_an_empty_answer_has_an_error_of_its_own() -> None:
    with pytest.raises(XmlRpcError, match="empty"):
        decode_response(b"")


def test_call_without_params() -> None:
    assert decode_call(call_with("")) == ("m", ())
    assert decode_call(call_with("<params/>")) == ("m", ())


@pytest.mark.parametrize(
    "doctype",
    [
        "<!DOCTYPE x>",
        '<!DOCTYPE x [<!ENTITY a "a">]>',
        '<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]>',
        '<!DOCTYPE x SYSTEM "file:///etc/passwd">',
        '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]>',
    ],
)
@pytest.mark.parametrize("decode", [decode_call, decode_response])
def test_document_types_are_refused(doctype: str, decode: Any) -> None:
    with pytest.raises(XmlRpcError, match="document type"):
        decode(f"<?xml version='1.0'?>{doctype}<methodCall/>".encode())


def test_undeclared_entities_are_refused() -> None:
    with pytest.raises(XmlRpcError):
        value_of("&nope;")


def test_untyped_values_are_strings() -> None:
    assert value_of(" some\ttext ") == " some\ttext "
    assert value_of("") == ""
    assert value_of("<![CDATA[<a&b>]]>c") == "<a&b>c"
    assert value_of("<string> x </string>") == " x "
    assert value_of("\n <string>x</string> \n") == "x"


def test_text_is_decoded_by_the_declared_encoding() -> None:
    head = "<?xml version='1.0' encoding='iso-8859-1'?>"
    document = f"{head}{call_with('<params><param><value>ü</value></param></params>').decode()}"
    assert decode_call(document.encode("latin-1")) == ("m", ("ü",))


@pytest.mark.parametrize(
    "encoding",
    [
        *("UTF-8", "utf-16", "iso-8859-1", "us-ascii"),
        *("utf8", "UTF_8", "latin1", "ascii", "cp1252", "windows-1252", "ISO-8859-15", "koi8-r"),
    ],
)
def test_encodings_that_are_accepted(encoding: str) -> None:
    document = f"<?xml version='1.0' encoding='{encoding}'?>{call_with('').decode()}"
    assert decode_call(document.encode(encoding)) == ("m", ())


@pytest.mark.parametrize("encoding", ["unicode_escape", "punycode", "idna", "no-such-encoding"])
def test_encodings_of_python_are_refused(encoding: str) -> None:
    known = dict(encodings._cache)  # type: ignore[attr-defined]
    document = f"<?xml version='1.0' encoding='{encoding}'?>{call_with('').decode()}"
    with pytest.raises(XmlRpcError, match="not an encoding"):
        decode_call(document.encode())
    # What Python was asked for, it remembers for good.
    assert encodings._cache == known  # type: ignore[attr-defined]


@pytest.mark.parametrize("text", ["&#0;", "&#1;", "&#xFFFE;", "&#xD800;", "\x01"])
def test_characters_that_xml_excludes_are_refused(text: str) -> None:
    with pytest.raises(XmlRpcError):
        value_of(text)


def test_bytes_that_are_not_utf8_are_refused() -> None:
    with pytest.raises(XmlRpcError):
        decode_call(
            call_with("<params><param><value>~</value></param></params>").replace(b"~", b"\xff")
        )


@pytest.mark.parametrize("char", ["\x00", "\x01", "\x0b", "\x1f", "\ud800", "\ufffe", "\uffff"])
def test_strings_that_xml_cannot_carry_are_refused_when_sent(char: str) -> None:
    with pytest.raises(ValueError, match=r"^params\[1\]\['k'\]: XML cannot carry"):
        encode_call("m", ("/c", {"k": f"a{char}b"}))
    with pytest.raises(ValueError, match="XML cannot carry"):
        encode_call("m", ({f"a{char}b": 1},))


def test_carriage_returns_are_kept() -> None:
    assert there_and_back("a\r\nb\rc") == "a\r\nb\rc"
    assert there_and_back({"a\r": ["\r", "\r\n", "<\r>"]}) == {"a\r": ["\r", "\r\n", "<\r>"]}
    assert value_of("a\r\nb") == value_of("<string>a&#13;&#10;b</string>") == "a\r\nb"


def test_carriage_returns_in_the_name_of_a_method() -> None:
    assert decode_call(encode_call("a\rb", ())) == ("a\rb", ())
    assert decode_call(encode_call("\r\na\r", ())) == ("a", ())


def test_carriage_returns_are_written_as_they_are() -> None:
    """roscpp knows no references by number."""
    document = encode_call("m", ({"k\r": ["a\r\nb"]},))
    assert b"<name>k\r</name>" in document
    assert b"<string>a\r\nb</string>" in document
    assert b"#" not in encode_response("a\r") + encode_fault(1, "a\rb")


def test_carriage_returns_between_elements_mean_nothing() -> None:
    params = (1, ["a\rb", {"c": "d\r\n"}], "")
    text = encode_call("m", params).decode()
    for end in ("\r", "\r\n"):
        spaced = text.replace("><", f">{end}<").replace(f"<string>{end}<", "<string><")
        assert decode_call(f"{spaced}{end}".encode()) == ("m", params)


def test_carriage_returns_in_pieces_of_a_document() -> None:
    """It is read in pieces, whose ends may be anywhere."""
    values = ["\r" * n + "\r\n" * 5000 + "\rü>" for n in range(30)]
    assert there_and_back(values) == values
    for length in (1, 2, 3, 7):
        returns = CarriageReturns()
        document = encode_response({"a\r": ["\r>\r", 1.5]}).replace(b"><", b">\r\n<")
        pieces = [document[begin : begin + length] for begin in range(0, len(document), length)]
        assert b"".join(map(returns.keep, pieces)) == CarriageReturns().keep(document)


def test_names_are_written_without_references_as_far_as_possible() -> None:
    """roscpp does not decode them."""
    assert b"<name>a>b'\"</name>" in encode_response({"a>b'\"": 1})
    for name in ("a]]>b", "<a>", "&amp;", "a>b"):
        assert there_and_back({name: 1}) == {name: 1}


@pytest.mark.parametrize(
    "inner",
    [
        "<int>2147483648</int>",
        "<i4>-2147483649</i4>",
        "<i8>2147483648</i8>",
        "<ex:biginteger>4294967296</ex:biginteger>",
        f"<int>{'9' * 5000}</int>",
    ],
)
def test_ints_beyond_32_bits_are_refused(inner: str) -> None:
    with pytest.raises(XmlRpcError, match=r"^params\[0\]: "):
        value_of(inner)


@pytest.mark.parametrize(
    "number", ["9223372036854775807", "-9223372036854775808", "18446744073709551615", "2147483648"]
)
@pytest.mark.parametrize("kind", ["int", "i4", "i8", "ex:i8"])
def test_an_answer_may_have_longer_ints(kind: str, number: str) -> None:
    value = f"<value><{kind}>{number}</{kind}></value>"
    row = f"<array><data>{value}</data></array>"
    for inner, expected in ((value, int(number)), (f"<value>{row}</value>", [int(number)])):
        body = f"<methodResponse><params><param>{inner}</param></params></methodResponse>"
        assert decode_response(body.encode()) == expected


@pytest.mark.parametrize(
    ("inner", "value"),
    [
        *((f"<{kind}>7</{kind}>", 7) for kind in ("i1", "i2", "i8", "ex:i1", "ex:i8")),
        *((f"<{kind}>0.5</{kind}>", 0.5) for kind in ("float", "ex:float", "ex:bigdecimal")),
        ("<ex:nil/>", None),
        ("<array/>", []),
        ("<array></array>", []),
        ("<ex:array><ex:data><ex:value><int>1</int></ex:value></ex:data></ex:array>", [1]),
        *(
            (f"<dateTime.iso8601>{text}</dateTime.iso8601>", datetime(1998, 7, 17, 14, 8, 55))
            for text in (
                *("19980717T14:08:55Z", "1998-07-17T14:08:55Z", "19980717T140855"),
                *("19980717T14:08:55.123", "1998-07-17T14:08:55.123456Z"),
                *("1998-07-17T16:08:55+02:00", "19980717T10:38:55-0330", "19980717T15:08:55+01"),
            )
        ),
        ("<ex:dateTime>1998-07-17T14:08:55.001Z</ex:dateTime>", datetime(1998, 7, 17, 14, 8, 55)),
    ],
)
def test_what_pythons_parser_takes_beyond_the_standard(inner: str, value: object) -> None:
    assert value_of(inner) == value


def test_an_answer_of_several_parameters_is_a_list() -> None:
    params = "".join(
        f"<param><value>{each}</value></param>" for each in ("<int>1</int>", "ok", "<int>5</int>")
    )
    body = f"<methodResponse><params>{params}</params></methodResponse>"
    assert decode_response(body.encode()) == [1, "ok", 5]


def test_a_struct_of_another_name_space() -> None:
    document = (
        "<x:methodCall xmlns:x='urn:x'><x:methodName>m</x:methodName><x:params><x:param><x:value>"
        "<x:struct><x:member><x:name>k</x:name><x:value><x:i4>1</x:i4></x:value></x:member>"
        "</x:struct></x:value></x:param></x:params></x:methodCall>"
    )
    assert decode_call(document.encode()) == ("m", ({"k": 1},))


@pytest.mark.parametrize("number", [1 << 31, -(1 << 31) - 1, 10**100])
def test_ints_beyond_32_bits_are_refused_when_sent(number: int) -> None:
    with pytest.raises(OverflowError, match=r"params\[1\]\[0\]: .* 32 bits"):
        encode_call("m", ("/c", [number]))


def test_nil_is_decoded_as_none() -> None:
    assert value_of("<nil/>") is None
    assert value_of("<array><data><value><nil/></value></data></array>") == [None]


def test_none_is_refused_when_sent() -> None:
    with pytest.raises(TypeError, match=r"^params\[2\]\['gains'\]\[0\]: .* None"):
        encode_call("m", ("/c", "/k", {"gains": [None]}))


@pytest.mark.parametrize(
    ("inner", "expected"),
    [("<int>+007</int>", 7), ("<i4> -3\n</i4>", -3), ("<int>-2147483648</int>", -(1 << 31))],
)
def test_ints_with_signs_zeros_and_spaces_are_decoded(inner: str, expected: int) -> None:
    assert value_of(inner) == expected


@pytest.mark.parametrize("text", ["", "abc", "1.0", "1_000", "0x10", "٣", "1 2"])
def test_malformed_ints_are_refused(text: str) -> None:
    with pytest.raises(XmlRpcError, match="not an int"):
        value_of(f"<int>{text}</int>")


@pytest.mark.parametrize("text", ["2", "true", "", "01"])
def test_malformed_booleans_are_refused(text: str) -> None:
    with pytest.raises(XmlRpcError, match="not a boolean"):
        value_of(f"<boolean>{text}</boolean>")


def test_booleans_are_decoded() -> None:
    assert value_of("<boolean>1</boolean>") is True
    assert value_of("<boolean>0</boolean>") is False


def test_nan_and_infinities_survive() -> None:
    assert math.isnan(there_and_back(math.nan))
    assert there_and_back([math.inf, -math.inf]) == [math.inf, -math.inf]
    assert value_of("<double>1e400</double>") == math.inf
    assert math.isnan(value_of("<double>nan</double>"))
    assert b"<double>-inf</double>" in encode_response(-math.inf)


@pytest.mark.parametrize("text", ["", "x", "1_0"])
def test_malformed_doubles_are_refused(text: str) -> None:
    with pytest.raises(XmlRpcError, match="not a double"):
        value_of(f"<double>{text}</double>")


@pytest.mark.parametrize("number", [0.1, 3.141592653589793, 5e-324, 1.7976931348623157e308, -0.0])
def test_doubles_keep_every_bit(number: float) -> None:
    assert there_and_back(number).hex() == number.hex()


def test_base64_and_datetime_survive() -> None:
    moment = datetime(1998, 7, 17, 14, 8, 55)
    assert there_and_back([b"\x00\xff", moment]) == [b"\x00\xff", moment]
    assert value_of("<base64>\n AA\n==\n</base64>") == b"\x00"
    assert value_of("<dateTime.iso8601>19980717T14:08:55</dateTime.iso8601>") == moment
    assert there_and_back(datetime(2020, 1, 1, 0, 0, 0, 999)) == datetime(2020, 1, 1)


@pytest.mark.parametrize(
    "text", ["nope", "", "19981317T14:08:55", "00000717T14:08:55", "00010101T00:00:00+01:00"]
)
def test_datetime_is_validated(text: str) -> None:
    with pytest.raises(XmlRpcError, match="not a dateTime"):
        value_of(f"<dateTime.iso8601>{text}</dateTime.iso8601>")


@pytest.mark.parametrize("text", ["a", "A===", "ü", "AA=A"])
def test_base64_is_validated(text: str) -> None:
    with pytest.raises(XmlRpcError, match="not base64"):
        value_of(f"<base64>{text}</base64>")


def test_struct_keys_are_kept_and_the_last_duplicate_wins() -> None:
    assert there_and_back({"x/y": 1, "": 2}) == {"x/y": 1, "": 2}
    members = "".join(
        f"<member><name>k</name><value><int>{n}</int></value></member>" for n in (1, 2)
    )
    assert value_of(f"<struct>{members}</struct>") == {"k": 2}
    assert value_of(
        "<struct><member><value><int>1</int></value><name>k</name></member></struct>"
    ) == {"k": 1}


@pytest.mark.parametrize(
    "inner",
    [
        "<struct><member><value/></member></struct>",
        "<struct><member><name>k</name></member></struct>",
        "<struct><member><name>k</name><name>k</name><value/></member></struct>",
        "<struct><member><name>k</name><value/><value/></member></struct>",
        "<struct><value/></struct>",
        "<array><data/><data/></array>",
        "<array><value/></array>",
        "<int>1</int><int>2</int>",
        "<int>1</int>text",
        "text<int>1</int>",
        "<int><int>1</int></int>",
        "<decimal>1</decimal>",
        "<nil>x</nil>",
        "</value></param><param><value><array><data><value>",
    ],
)
def test_misplaced_elements_are_refused(inner: str) -> None:
    with pytest.raises(XmlRpcError):
        value_of(inner)


def nested(depth: int) -> str:
    return "<array><data><value>" * depth + "</value></data></array>" * depth


def test_nesting_is_bounded() -> None:
    value_of(nested(MAX_DEPTH))
    with pytest.raises(XmlRpcError, match="inside one another"):
        value_of(nested(MAX_DEPTH + 1))
    with pytest.raises(XmlRpcError, match="inside one another"):
        value_of(nested(100_000))
    with pytest.raises(XmlRpcError):
        decode_call(encode_call("m", [[[1]]]), max_depth=1)


def test_nesting_is_bounded_when_sent() -> None:
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(ValueError, match="inside one another"):
        encode_response(endless)


def test_errors_name_the_place() -> None:
    inner = (
        "<struct><member><name>gains</name><value><array><data><value><int>1</int></value>"
        "<value><int>x</int></value></data></array></value></member></struct>"
    )
    with pytest.raises(XmlRpcError, match=r"^params\[0\]\['gains'\]\[1\]: not an int: 'x'"):
        value_of(inner)
    answer = encode_response([{"a": 1}]).replace(b"<int>1", b"<int>z")
    with pytest.raises(XmlRpcError, match=r"^result\[0\]\['a'\]: not an int"):
        decode_response(answer)


# ------------------------------------------------------------------------------- faults


def test_faults() -> None:
    with pytest.raises(XmlRpcFault) as caught:
        decode_response(encode_fault(-32700, "bad <xml> \x00"))
    assert caught.value.code == -32700
    assert caught.value.text == "bad <xml> ?"
    assert str(caught.value) == "bad <xml> ? (fault -32700)"


@pytest.mark.parametrize(
    ("inner", "code", "text"),
    [
        ("<struct/>", 0, ""),
        ("<struct><member><name>faultCode</name><value>x</value></member></struct>", 0, ""),
    ],
)
def test_faults_without_code(inner: str, code: int, text: str) -> None:
    with pytest.raises(XmlRpcFault) as caught:
        decode_response(
            f"<methodResponse><fault><value>{inner}</value></fault></methodResponse>".encode()
        )
    assert (caught.value.code, caught.value.text) == (code, text)


@pytest.mark.parametrize(
    "body",
    [
        "<fault><value>no struct</value></fault>",
        "<fault/>",
        "<fault><value><struct/></value><value><struct/></value></fault>",
        "<params/>",
        "",
    ],
)
def test_answers_that_are_neither_value_nor_fault(body: str) -> None:
    with pytest.raises(XmlRpcError):
        decode_response(f"<methodResponse>{body}</methodResponse>".encode())


# ------------------------------------------------------------------------------- writing


def test_subclasses_are_written_as_what_they_are() -> None:
    class Level(enum.IntEnum):
        WARN = 4

    class Name(str, enum.Enum):  # noqa: UP042 - the kind that is a str of another value
        A = "a"

    class Pair(NamedTuple):
        x: int
        y: float

    class Real(float):
        def __repr__(self) -> str:
            return "Real"

    assert there_and_back([Level.WARN, Name.A, Pair(1, 2.0), Real(0.5), bytearray(b"x")]) == [
        4,
        "a",
        [1, 2.0],
        0.5,
        b"x",
    ]


def test_bool_is_not_an_int() -> None:
    assert there_and_back([True, False, 1, 0]) == [True, False, 1, 0]
    assert b"<boolean>1</boolean>" in encode_response(True)


@pytest.mark.parametrize("value", [object(), {1, 2}, 1j, {"a": print}])
def test_other_types_are_refused(value: Any) -> None:
    with pytest.raises(TypeError, match="XML-RPC has no type"):
        encode_response(value)


def test_keys_that_are_not_strings_are_refused() -> None:
    with pytest.raises(TypeError, match=r"^params\[0\]\[1\]: the keys"):
        encode_call("m", ([0, {5: 1}],))


def test_time_zones_are_refused() -> None:
    with pytest.raises(ValueError, match="time zones"):
        encode_response(datetime.fromisoformat("2020-01-01T00:00:00+02:00"))


# ------------------------------------------------------------------------------- any value

XML_TEXT = st.text(
    st.characters(
        codec="utf-8",
        exclude_characters=[chr(n) for n in range(32) if n not in (9, 10, 13)]
        + ["\ufffe", "\uffff"],
    )
)
SCALARS = (
    st.booleans()
    | st.integers(-(1 << 31), (1 << 31) - 1)
    | st.floats(allow_nan=False)
    | XML_TEXT
    | st.binary()
    | st.datetimes().map(lambda moment: moment.replace(microsecond=0))
)
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner) | st.dictionaries(XML_TEXT, inner), max_leaves=20
)


@given(VALUES)
def test_any_value_comes_back(value: Any) -> None:
    assert there_and_back(value) == value
    assert decode_call(encode_call("some.method", (value, value))) == (
        "some.method",
        (value, value),
    )


@given(VALUES)
def test_the_standard_library_reads_what_we_write(value: Any) -> None:
    document = with_references(encode_call("m", (value,)))
    params, method = xmlrpc.client.loads(document, use_builtin_types=True)
    assert method == "m"
    assert params == (value,)


@given(VALUES)
def test_we_read_what_the_standard_library_writes(value: Any) -> None:
    text = xmlrpc.client.dumps((value,), methodresponse=True)
    assert decode_response(text.encode()) == value


def attempt(data: bytes) -> None:
    for decode in (decode_call, decode_response):
        try:
            value = decode(data)
        except (XmlRpcError, XmlRpcFault):
            continue
        if decode is decode_response:
            assert there_and_back(value) == value or value != value or "nan" in repr(value)


@given(st.binary())
def test_any_bytes_are_a_value_or_an_error(data: bytes) -> None:
    attempt(data)


_TAGS = (
    *("methodCall", "methodResponse", "params", "param", "value", "fault"),
    *("array", "data", "struct", "member"),
)
FRAGMENTS = st.sampled_from(
    [
        *(f"<{slash}{tag}>" for tag in _TAGS for slash in ("", "/")),
        *("<name>k</name>", "<name/>", "<value/>", "<int>1</int>", "<double>2</double>"),
        *("<boolean>1</boolean>", "<string>s</string>", "<base64>AA==</base64>", "<i8>1</i8>"),
        *("text", "&amp;", "&#65;", "<!--c-->", "<![CDATA[x]]>", "<?pi?>", "\xff", " "),
    ]
)


@given(st.lists(FRAGMENTS, max_size=30), st.sampled_from(["", "<?xml version='1.0'?>", "\ufeff"]))
def test_any_shuffled_document_is_a_value_or_an_error(fragments: list[str], head: str) -> None:
    inner = "".join(fragments)
    attempt(f"{head}{inner}".encode())
    attempt(
        f"{head}<methodResponse><params><param><value>{inner}</value></param></params></methodResponse>".encode()
    )
