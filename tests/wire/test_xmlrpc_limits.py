"""How much may be in an XML-RPC document: at each limit, and one above."""

from __future__ import annotations

from typing import Any

import pytest

from aioros1.wire.xmlrpc import (
    MAX_VALUES,
    XmlRpcError,
    decode_call,
    decode_response,
    encode_call,
    encode_response,
)


def response(value: str, attributes: str = "") -> bytes:
    return (
        f"<methodResponse{attributes}><params><param>{value}</param></params></methodResponse>"
    ).encode()


@pytest.mark.parametrize(
    ("value", "count"),
    [
        (1, 1),
        ([], 1),
        ([1, 2, 3], 4),
        ([[1], [2]], 5),
        ({"a": 1, "b": {"c": "ü"}}, 4),
        ("x" * 1_000_000, 1),
    ],
)
def test_the_number_of_values(value: Any, count: int) -> None:
    answer, request = encode_response(value), encode_call("m", (value,))
    assert decode_response(answer, max_values=count) == value
    assert decode_call(request, max_values=count) == ("m", (value,))
    if count > 1:
        for decode, document in ((decode_response, answer), (decode_call, request)):
            with pytest.raises(XmlRpcError, match=f"more than {count - 1} values or attributes"):
                decode(document, max_values=count - 1)


def test_the_values_of_all_parameters_count_together() -> None:
    document = encode_call("m", (1, [2], "three"))
    assert decode_call(document, max_values=4) == ("m", (1, [2], "three"))
    with pytest.raises(XmlRpcError, match=r"params\[2\]: more than 3 values"):
        decode_call(document, max_values=3)


def test_the_number_of_values_without_another_word() -> None:
    values = [0] * (MAX_VALUES - 1)
    assert decode_response(encode_response(values)) == values
    with pytest.raises(XmlRpcError, match=rf"result\[{MAX_VALUES - 1}\]: more than {MAX_VALUES}"):
        decode_response(encode_response([*values, 0]))


def test_attributes_are_allowed_and_count() -> None:
    # as Apache's library, and so rosjava, writes them
    named = response("<value>x</value>", ' xmlns:ex="http://ws.apache.org/xmlrpc"')
    assert decode_response(named) == "x"
    assert decode_response(named, max_values=2) == "x"
    with pytest.raises(XmlRpcError, match="more than 1 values or attributes"):
        decode_response(named, max_values=1)


@pytest.mark.parametrize("where", ["methodResponse", "value"])
def test_a_tag_full_of_attributes_is_not_read_to_its_end(where: str) -> None:
    attributes = " " + " ".join(f"a{number}=''" for number in range(200_000))
    document = (
        response("<value/>", attributes)
        if where == "methodResponse"
        else response(f"<value{attributes}/>")
    )
    with pytest.raises(XmlRpcError, match="a tag or a comment of more than"):
        decode_response(document, max_values=1_000_000_000)


def test_a_comment_without_an_end() -> None:
    with pytest.raises(XmlRpcError, match="a tag or a comment of more than"):
        decode_response(response("<value>x</value><!--" + "-x" * 500_000 + "-->"))
    document = response("<value>x</value><!--" + "-x" * 30_000 + "-->" + "<!--x-->" * 100_000)
    assert decode_response(document) == "x"


@pytest.mark.parametrize("length", [65_535, 65_536, 65_537, 131_072, 3_000_000])
@pytest.mark.parametrize("character", ["x", "ü", "€", "&amp;", "\n"])
def test_long_texts_are_read_wherever_they_are_cut(length: int, character: str) -> None:
    text = character * (length // len(character.encode()))
    read = decode_response(response(f"<value><string>{text}</string></value>"))
    assert read == text.replace("&amp;", "&")


def test_a_long_section_of_character_data() -> None:
    text = "<robot>" + "<link/>" * 100_000
    document = response(f"<value><string><![CDATA[{text}]]></string></value>")
    assert decode_response(document) == text


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_many_tags_are_read_wherever_they_are_cut(encoding: str) -> None:
    values = [f"value {number}" for number in range(10_000)]
    document = encode_response(values).decode().replace("1.0'", f"1.0' encoding='{encoding}'")
    assert decode_response(document.encode(encoding)) == values


@pytest.mark.parametrize("size", [65_536 - 1, 65_536, 65_536 + 1, 131_072, 131_073])
def test_documents_of_the_size_of_the_pieces(size: int) -> None:
    frame = len(response("<value>&amp;</value>"))
    document = response("<value>&amp;" + "x" * (size - frame) + "</value>")
    assert len(document) == size
    assert decode_response(document) == "&" + "x" * (size - frame)
    with pytest.raises(XmlRpcError, match="not XML"):
        decode_response(document[:-1])
    with pytest.raises(XmlRpcError, match="not XML"):
        decode_response(document + b"x")


@pytest.mark.parametrize(
    "entities",
    [
        # each ten times the one before: a few hundred octets that would become gigabytes
        '<!ENTITY a0 "ha">' + "".join(f'<!ENTITY a{n + 1} "{f"&a{n};" * 10}">' for n in range(10)),
        '<!ENTITY a10 SYSTEM "file:///etc/passwd">',
        '<!ENTITY % a10 SYSTEM "http://127.0.0.1:1/x.dtd"> %a10;',
    ],
    ids=["bomb", "file", "parameter"],
)
def test_entities_are_refused_before_they_are_read(entities: str) -> None:
    document = b"<!DOCTYPE x [" + entities.encode() + b"]>" + response("<value>&a10;</value>")
    with pytest.raises(XmlRpcError, match="document type declarations are refused"):
        decode_response(document)
