"""The same requests to rosmaster and to ours: the same codes, words and values.

Where ours answers differently on purpose, the row says how and why.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import pytest

from aioros1.master import Master
from aioros1.wire.xmlrpc import XmlRpcFault
from aioros1.xmlrpc.client import XmlRpcClient

pytestmark = pytest.mark.interop

API = "http://127.0.0.1:1/"  # nobody listens: notifications are refused at once
RPC = "rosrpc://127.0.0.1:2"


class Row(NamedTuple):
    row: str
    method: str
    params: tuple[Any, ...]
    ours: Any = None
    """The answer of ours where it differs."""


def row(number: str, method: str, *params: Any, ours: Any = None) -> Row:
    return Row(number, method, params, ours)


# In order: each request sees what those before it have left.
CONVERSATION = [
    row("P1", "setParam", "/c", "/", {"a": {"b": 1}, "s": "text"}),
    row("P1", "setParam", "/c", "/", 5),
    row("P2", "deleteParam", "/c", "/"),
    row("P2", "deleteParam", "/c", "/nope"),
    row("P3", "setParam", "/c", "//x//y/", 1),
    row("P3", "getParam", "/c", "/x/y/"),
    row("P3", "getParam", "/c", "/x//y"),
    row("P4", "setParam", "/c", "/s/below", 2),
    row("P4", "getParam", "/c", "/s"),
    row("P5", "getParam", "/c", "/s/below/more"),
    row("P5", "hasParam", "/c", "/s/below/more"),
    row("P6", "deleteParam", "/c", "/s/below"),
    row("P6", "getParam", "/c", "/s"),
    row("P6", "hasParam", "/c", "/s"),
    row("P6", "getParamNames", "/c"),
    row("P7", "getParam", "/c", "/"),
    row("P7", "getParam", "/c", "/unset"),
    row("P8", "setParam", "/ns/node", "rel", 1),
    row("P8", "setParam", "/ns/node", "~priv", 2),
    row("P8", "getParam", "/c", "/ns"),
    row("P8", "getParam", "/ns/node", "~priv"),
    row("P8", "getParam", "node", "ns/rel"),
    row("P8", "getParam", "", "ns/rel"),
    row("P8", "getParam", "/ns/", "ns/rel"),
    row("P9", "setParam", "/c", "/with space/ü/1abc", [1, 2.5, "x", True, [], {}]),
    row("P9", "getParam", "/c", "/with space"),
    row("P10", "searchParam", "/ns/node", "priv"),
    row("P10", "searchParam", "/ns/node/deeper", "rel"),
    row("P10", "searchParam", "/ns/node", "rel/not/there"),
    row("P10", "searchParam", "/ns/node", "rel/"),
    row("P10", "searchParam", "/ns/node", "a"),
    row("P10", "searchParam", "/ns/node", "a/b"),
    row("P10", "searchParam", "/ns/node", "absent"),
    row("P10", "searchParam", "/ns/node", "/ns/rel"),
    row("P10", "searchParam", "/ns/node", "/rel"),
    row("P10", "searchParam", "/ns/node", "~priv"),
    row("P10", "searchParam", "/ns/node", ""),
    row("P10", "searchParam", "node", "a"),
    row("P10", "searchParam", "/", "a"),
    row("P11", "subscribeParam", "/c", API, "/unset/param"),
    row("P11", "subscribeParam", "/c", API, "/x/y"),
    row("P11", "subscribeParam", "/c", API, "/x/"),
    row("P11", "subscribeParam", "/c", API, "/"),
    row("P18", "unsubscribeParam", "/never", API, "/x"),
    row("P18", "unsubscribeParam", "/c", API, "/x"),
    row("P21", "lookupNode", "/c", "/c"),
    row("P18", "unsubscribeParam", "/c", API, "/x/y"),
    row("P18", "unsubscribeParam", "/c", API, "/unset/param"),
    row("P18", "unsubscribeParam", "/c", API, "/"),
    row("P21", "lookupNode", "/c", "/c"),
    row("X16", "setParam", "/c", "/inf", float("inf")),
    row("X16", "getParam", "/c", "/inf"),
    row("X17", "setParam", "/c", "/pi", 3.141592653589793),
    row("X17", "getParam", "/c", "/pi"),
    row("X18", "setParam", "/c", "/bin", b"\x00\xff"),
    row("X18", "getParam", "/c", "/bin"),
    row("X19", "setParam", "/c", "/d", {"x/y": 1}),
    row("X19", "getParam", "/c", "/d/x/y"),
    row("X19", "hasParam", "/c", "/d/x"),
    row("X19", "getParamNames", "/c"),
    row("X19", "deleteParam", "/c", "/d"),
    row("X20", "setParam", "/c", "/e", {"": 1}),
    row("X20", "getParam", "/c", "/e"),
    row("X20", "deleteParam", "/c", "/e"),
    row("X6", "setParam", "/c", "", 1),
    row("X6", "setParam", "/c", 5, 1),
    row("X6", "setParam", 5, "/x", 1),
    row("X6", "setParam", "/c", "/x"),
    row("X6", "setParam", "/c", "/x", 1, 2),
    row("X6", "getParam"),
    row("X6", "getParam", "/c", 0),
    row("X6", "hasParam", "/c"),
    row("X6", "hasParam", 1, "/x"),
    row("X6", "searchParam"),
    row("X6", "getParamNames"),
    row("X6", "getParamNames", "/c", 1),
    row("X6", "deleteParam", "/c"),
    row("X6", "subscribeParam", "/c", "nouri", "/x"),
    row("X6", "subscribeParam", "/c", "", "/x"),
    row("X6", "unsubscribeParam", "/c", API, ""),
    row("X6", "registerPublisher", "/c"),
    row("X6", "registerPublisher"),
    row("X6", "registerSubscriber", 1, "/t", "std_msgs/String", API),
    row("X6", "registerService", "/c", "/s"),
    row("X6", "unregisterService", "/c", "/s"),
    row("X6", "lookupNode"),
    row("X6", "lookupNode", "/c", ""),
    row("X6", "lookupNode", "/c", "http://x"),
    row("X6", "lookupNode", "/c", 7),
    row("X6", "lookupService", "/c", ""),
    row("X6", "lookupService", "/c", "/"),
    row("X6", "getPublishedTopics", "/c"),
    row("X6", "getPublishedTopics", "/c", 5),
    row("X6", "getTopicTypes"),
    row("X6", "getTopicTypes", "/c", 1),
    row("X6", "getSystemState"),
    row("X6", "getSystemState", 1),
    row("X6", "getUri"),
    row("X6", "getPid"),
    row("X6", "getPid", 3),
    row("X6", "shutdown", "/c"),
    row("X6", "shutdown"),
    row("X4", "system.multicall", [{"methodName": "getParam", "params": ["/c", "/x/y"]},
                                   {"methodName": "lookupNode", "params": ["/c", "/none"]}]),
    row("P9", "registerPublisher", "/c", "a b", "std_msgs/String", API),
    row("P9", "registerPublisher", "/c", "a:b", "std_msgs/String", API),
    row("P9", "registerPublisher", "/c", "", "std_msgs/String", API),
    row("P9", "registerPublisher", "/c", "/", "std_msgs/String", API),
    row("P9", "registerPublisher", "/c", "/1abc", "std_msgs/String", API),
    row("P9", "registerPublisher", "/c", "/a-b", "std_msgs/String", API),
    row("P9", "registerPublisher", "/c", "/ü", "std_msgs/String", API),
    row("P9", "registerService", "/c", "/a b", RPC, API),
    row("P9", "registerService", "/c", "/", RPC, API),
    row("G6", "registerPublisher", "/c", "/t", "String", API),
    row("G6", "registerPublisher", "/c", "/t", "a/b/c", API),
    row("G6", "registerPublisher", "/c", "/t", "", API),
    row("G6", "registerPublisher", "/c", "/t", 3, API),
    row("G6", "registerSubscriber", "/c", "/slash", "/", API),
    row("G7", "registerPublisher", "/c", "/t", "a/b", "https://h:1/"),
    row("G7", "registerPublisher", "/c", "/t", "a/b", ""),
    row("G7", "registerPublisher", "/c", "/t", "a/b", 5),
    row("G7", "registerSubscriber", "/r", "/t", "a/b", RPC),
    row("G7", "unregisterSubscriber", "/r", "/t", RPC),
    row("G3", "unregisterPublisher", "/nobody", "/t", API),
    row("G3", "unregisterSubscriber", "/c", "/t", API),
    row("G3", "unregisterService", "/nobody", "/s", RPC),
    row("G5", "registerSubscriber", "/s", "/typed", "*", API),
    row("G5", "registerPublisher", "/p1", "/typed", "a/One", API),
    row("G5", "registerPublisher", "/p2", "/typed", "a/Two", API),
    row("G5", "registerPublisher", "/p3", "/typed", "*", API),
    row("G5", "registerSubscriber", "/s", "/typed", "a/Three", API),
    row("G5", "getTopicTypes", "/c"),
    row("G12", "getPublishedTopics", "/c", ""),
    row("G12", "getPublishedTopics", "/c", "/typed"),
    row("G12", "getPublishedTopics", "/c", "/ty"),
    row("G12", "registerPublisher", "/p1", "/sub/one", "a/One", API),
    row("G12", "getPublishedTopics", "/c", "/sub"),
    row("G12", "getPublishedTopics", "/c", "sub/"),
    row("G12", "getPublishedTopics", "/sub/x", "one"),
    row("G14", "getSystemState", "/c"),
    row("G2", "unregisterPublisher", "/p2", "/sub/one", API),
    row("G2", "unregisterPublisher", "/p1", "/sub/one", "http://other:1/"),
    row("G2", "unregisterPublisher", "/p1", "/sub/one", API),
    row("G5", "unregisterPublisher", "/p1", "/typed", API),
    row("G5", "unregisterPublisher", "/p2", "/typed", API),
    row("G5", "unregisterPublisher", "/p3", "/typed", API),
    row("G5", "getTopicTypes", "/c"),
    row("G13", "lookupNode", "/s", "s"),
    row("G13", "lookupNode", "/ns/x", "s"),
    row("G13", "lookupNode", "/s", "~"),
    row("G4", "lookupService", "/c", "/srv"),
    row("G4", "registerService", "/n1", "/srv", RPC, API),
    row("G4", "registerService", "/n2", "/srv", "rosrpc://127.0.0.1:3", "http://127.0.0.1:4/"),
    row("G4", "lookupService", "/c", "/srv"),
    row("G4", "unregisterService", "/n1", "/srv", RPC),
    row("G4", "lookupService", "/c", "srv"),
    row("G14", "getSystemState", "/c"),
    row("G4", "unregisterService", "/n2", "/srv", "rosrpc://127.0.0.1:3"),
    row("G4", "lookupService", "/c", "/srv"),
    row("G4", "lookupNode", "/c", "/n2"),
    row("G1", "registerPublisher", "/dup", "/old", "a/One", API),
    row("G1", "registerSubscriber", "/dup", "/olds", "a/One", API),
    row("G1", "registerService", "/dup", "/oldsrv", RPC, API),
    row("G1", "registerPublisher", "/dup", "/new", "a/One", "http://127.0.0.1:5/"),
    row("G1", "lookupNode", "/c", "/dup"),
    row("G1", "lookupService", "/c", "/oldsrv"),
    row("G14", "getSystemState", "/c"),
]  # fmt: skip


async def ask(client: XmlRpcClient, uri: str, request: Row) -> Any:
    try:
        return _sorted(await client.call(uri, request.method, *request.params))
    except XmlRpcFault:
        return "fault"


def _sorted(answer: Any) -> Any:
    """Lists of the graph in one order: theirs is that of a hash table."""
    if isinstance(answer, list):
        return sorted((_sorted(item) for item in answer), key=repr)
    return answer


async def test_answers_are_those_of_rosmaster(rosmaster: str) -> None:
    client = XmlRpcClient()
    async with Master("127.0.0.1", port=0, rosout=False) as ours:
        different = []
        for request in CONVERSATION:
            expected = await ask(client, rosmaster, request)
            got = await ask(client, ours.uri, request)
            if request.ours is not None:
                expected = _sorted(request.ours)
            if got != expected:
                different.append(
                    f"{request.row} {request.method}{request.params}: {expected} -> {got}"
                )
        await client.close()
    assert not different, "\n".join(different)
