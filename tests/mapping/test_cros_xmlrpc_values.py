"""XmlrpcParam and what belongs to it: plain values of Python."""

from __future__ import annotations

import asyncio
import copy
import datetime
import xmlrpc.client
from urllib.parse import urlsplit

import pytest

from aioros1.wire.xmlrpc import (
    XmlRpcError,
    XmlRpcFault,
    decode_call,
    decode_response,
    encode_call,
    encode_fault,
    encode_response,
)

WHEN = datetime.datetime(2024, 2, 29, 12, 30, 15)


async def round_trip(node, value):
    """Through the parameter server, as every other program would see it."""
    await node.set_param("value", value)
    return await node.get_param("value")


@pytest.mark.parametrize(
    ("type_", "value"),
    [
        (bool, True),
        (int, -(2**31)),
        (float, 0.1),
        (str, "ü <&>"),
        (list, [1, [2]]),
        (datetime.datetime, WHEN),
        (bytes, b"\0\xff"),
        (dict, {"a": {"b": 1}}),
    ],
    ids=["BOOL", "INT", "DOUBLE", "STRING", "ARRAY", "DATETIME", "BINARY", "STRUCT"],
)
async def test_XmlrpcParamType_is_the_type_of_the_value(make_node, type_, value):
    node = await make_node()
    found = await round_trip(node, value)
    assert type(found) is type_
    assert found == value


async def test_XmlrpcParamType_UNKNOWN_is_refused(make_node):
    node = await make_node()
    for value in (None, [None], {"a": object()}):
        with pytest.raises(TypeError, match="XML-RPC has no type"):
            await node.set_param("value", value)


@pytest.mark.parametrize("value", [2**31, -(2**31) - 1], ids=["above", "below"])
async def test_XmlrpcParam_int_has_32_bits(make_node, value):
    node = await make_node()
    with pytest.raises(OverflowError, match="32 bits"):
        await node.set_param("value", value)


@pytest.mark.parametrize(
    ("function", "value"),
    [
        ("xmlrpcParamInit", 0),
        ("xmlrpcParamNew", {}),
        ("xmlrpcParamClone", copy.deepcopy({"a": [1]})),
        ("xmlrpcParamCopy", copy.copy([1, 2])),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
async def test_making_and_copying(make_node, function, value):
    """Literals and the module ``copy``; an empty struct is a parameter without value."""
    node = await make_node()
    assert await round_trip(node, value) == value


@pytest.mark.parametrize("function", ["xmlrpcParamRelease", "xmlrpcParamFree"])
async def test_freeing(make_node, function):
    """A value belongs to whoever has it, and may be changed: nobody else sees that."""
    node = await make_node()
    value = [1, 2]
    await node.set_param("value", value)
    value.clear()
    assert await node.get_param("value") == [1, 2]


async def test_xmlrpcParamRelease_of_what_one_follows_oneself(make_node):
    node = await make_node()
    async with node.subscribe_param("value", default=0) as psub:
        value = [1, 2]
        await node.set_param("value", value)
        value.clear()
        assert psub.value == [1, 2]
        psub.value.clear()
        assert psub.value == [1, 2]
        update = await asyncio.wait_for(anext(psub), 30)
        update.value.clear()
        assert psub.value == [1, 2]


async def test_xmlrpcParamCopy_is_the_same_for_all_who_follow(pair):
    """A tuple becomes a list, for the one who set it as for the others."""
    setter, other = pair
    async with (
        setter.subscribe_param("value", default=0) as own,
        other.subscribe_param("value", default=0) as theirs,
    ):
        await setter.set_param("value", {"a": (1, 2)})
        assert await theirs.wait_for(bool, timeout=30) == {"a": [1, 2]}
        assert own.value == {"a": [1, 2]}


@pytest.mark.parametrize("function", ["xmlrpcParamPrint", "paramPrint", "paramArrayPrint"])
async def test_printing(make_node, capsys, function):
    node = await make_node()
    print(await round_trip(node, {"gains": [1, 2.5, "x", True]}))
    assert capsys.readouterr().out == "{'gains': [1, 2.5, 'x', True]}\n"


@pytest.mark.parametrize(
    ("function", "value"),
    [
        ("xmlrpcParamSetBool", False),
        ("xmlrpcParamSetInt", 7),
        ("xmlrpcParamSetDouble", 7.0),
        ("xmlrpcParamSetString", "seven"),
        ("xmlrpcParamSetStringN", "seventeen"[:5]),
        ("xmlrpcParamSetArray", []),
        ("xmlrpcParamSetStruct", {"seven": 7}),
        ("xmlrpcParamGetBool", False),
        ("xmlrpcParamGetInt", 7),
        ("xmlrpcParamGetDouble", 7.0),
        ("xmlrpcParamGetString", "seven"),
        ("xmlrpcParamGetType", 7.0),
    ],
    ids=lambda value: value if str(value).startswith("xmlrpc") else "",
)
async def test_setting_and_getting(make_node, function, value):
    node = await make_node()
    found = await round_trip(node, value)
    assert (type(found), found) == (type(value), value)


async def test_xmlrpcParamSetUnknown_is_delete_param(make_node):
    node = await make_node()
    await node.set_param("value", 1)
    await node.delete_param("value")
    assert not await node.has_param("value")


@pytest.mark.parametrize(
    ("function", "item"),
    [
        ("xmlrpcParamArrayPushBackBool", True),
        ("xmlrpcParamArrayPushBackInt", 7),
        ("xmlrpcParamArrayPushBackDouble", 7.5),
        ("xmlrpcParamArrayPushBackString", "seven"),
        ("xmlrpcParamArrayPushBackStringN", "seventeen"[:5]),
        ("xmlrpcParamArrayPushBackArray", [7]),
        ("xmlrpcParamArrayPushBackStruct", {"seven": 7}),
    ],
    ids=lambda value: value if str(value).startswith("xmlrpc") else "",
)
async def test_appending_to_an_array(make_node, function, item):
    node = await make_node()
    array = [0]
    array.append(item)
    found = await round_trip(node, array)
    assert found == [0, item]
    assert type(found[1]) is type(item)


async def test_xmlrpcParamArrayGetSize(make_node):
    assert len(await round_trip(await make_node(), [4, 5, 6])) == 3


async def test_xmlrpcParamArrayGetParamAt(make_node):
    assert (await round_trip(await make_node(), [4, 5, 6]))[1] == 5


@pytest.mark.parametrize(
    ("function", "item"),
    [
        ("xmlrpcParamStructPushBackBool", True),
        ("xmlrpcParamStructPushBackInt", 7),
        ("xmlrpcParamStructPushBackDouble", 7.5),
        ("xmlrpcParamStructPushBackString", "seven"),
        ("xmlrpcParamStructPushBackStringN", "seventeen"[:5]),
        ("xmlrpcParamStructPushBackArray", [7]),
        ("xmlrpcParamStructPushBackStruct", {"seven": 7}),
    ],
    ids=lambda value: value if str(value).startswith("xmlrpc") else "",
)
async def test_adding_to_a_struct(make_node, function, item):
    node = await make_node()
    struct = {"first": 0}
    struct["second"] = item
    found = await round_trip(node, struct)
    assert found == {"first": 0, "second": item}
    assert type(found["second"]) is type(item)


async def test_xmlrpcParamStructGetParam(make_node):
    node = await make_node()
    assert (await round_trip(node, {"a": {"b": 5}}))["a"]["b"] == 5
    assert await node.get_param("value/a/b") == 5


# ------------------------------------------------------------------ documents

EVERYTHING = (True, 7, 7.5, "ü <&>", [1, ["two"]], {"a": {"b": []}}, b"\0\xff", WHEN)


def test_xmlrpcParamToXml_is_read_by_others():
    document = encode_call("setParam", EVERYTHING)
    values, method = xmlrpc.client.loads(document, use_builtin_types=True)
    assert (method, values) == ("setParam", EVERYTHING)


def test_xmlrpcParamFromXml_reads_what_others_write():
    document = xmlrpc.client.dumps(EVERYTHING, "setParam").encode()
    assert decode_call(document) == ("setParam", EVERYTHING)


@pytest.mark.parametrize(
    ("function", "values"),
    [
        ("xmlrpcParamVectorInit", ()),
        ("xmlrpcParamVectorRelease", ()),
        ("xmlrpcParamVectorPushBack", EVERYTHING),
        ("xmlrpcParamVectorPushBackBool", (False,)),
        ("xmlrpcParamVectorPushBackInt", (1, 2)),
        ("xmlrpcParamVectorPushBackDouble", (1.5,)),
        ("xmlrpcParamVectorPushBackString", ("one", "")),
        ("xmlrpcParamVectorPushBackArray", ([], [1])),
        ("xmlrpcParamVectorPushBackStruct", ({}, {"a": 1})),
        ("xmlrpcParamVectorGetSize", (1, 2, 3)),
        ("xmlrpcParamVectorAt", ("a", "b")),
        ("xmlrpcParamVectorPrint", ("a", 1)),
    ],
    ids=lambda value: value if str(value).startswith("xmlrpc") else "",
)
def test_parameters_of_a_call_are_a_tuple(function, values):
    _, found = decode_call(encode_call("anything", values))
    assert (len(found), found, str(found)) == (len(values), values, str(values))


def test_generateXmlrpcMessage_and_parseXmlrpcMessage():
    assert decode_call(encode_call("getPid", ("/talker",))) == ("getPid", ("/talker",))
    assert decode_response(encode_response([1, "", 42])) == [1, "", 42]
    with pytest.raises(XmlRpcFault, match="why not"):
        decode_response(encode_fault(-1, "why not"))


def test_parseXmlrpcMessage_of_what_is_none():
    for document in (b"", b"<", b"<html/>", b"<!DOCTYPE x><methodCall/>"):
        with pytest.raises(XmlRpcError):
            decode_call(document)


@pytest.mark.parametrize(
    "function",
    [
        "xmlrpcProcessInit",
        "xmlrpcProcessRelease",
        "xmlrpcProcessClear",
        "xmlrpcProcessReset",
        "xmlrpcProcessChangeState",
        "cRosApiParseRequestPrepareResponse",
    ],
)
async def test_request_after_request_on_one_connection(make_node, function):
    """By hand, as any program may speak HTTP."""
    node = await make_node("talker")
    body = xmlrpc.client.dumps(("/by_hand",), "getUri").encode()
    head = f"POST /RPC2 HTTP/1.1\r\nHost: localhost\r\nContent-Length: {len(body)}\r\n\r\n"
    reader, writer = await asyncio.open_connection("127.0.0.1", urlsplit(node.uri).port)
    try:
        for _ in range(3):
            writer.write(head.encode() + body)
            async with asyncio.timeout(30):
                answer = (await reader.readuntil(b"\r\n\r\n")).decode().lower()
                length = int(answer.partition("content-length:")[2].split()[0])
                document = await reader.readexactly(length)
            assert answer.startswith("http/1.1 200 ok")
            assert xmlrpc.client.loads(document)[0][0][2] == node.uri
    finally:
        writer.close()
        await writer.wait_closed()
