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
    method: str
    params: tuple[Any, ...]
    ours: Any = None
    """The answer of ours where it differs."""


def row(method: str, *params: Any, ours: Any = None) -> Row:
    return Row(method, params, ours)


# In order: each request sees what those before it have left.
CONVERSATION = [
    # The root is a namespace: a dict replaces all of it, anything else is refused.
    row("setParam", "/c", "/", {"a": {"b": 1}, "s": "text"}),
    row("setParam", "/c", "/", 5),
    # Neither the root nor what is not set can be deleted.
    row("deleteParam", "/c", "/"),
    row("deleteParam", "/c", "/nope"),
    # Slashes are reduced to the canonical ones.
    row("setParam", "/c", "//x//y/", 1),
    row("getParam", "/c", "/x/y/"),
    row("getParam", "/c", "/x//y"),
    # A value in the way becomes a namespace.
    row("setParam", "/c", "/s/below", 2),
    row("getParam", "/c", "/s"),
    # Nothing lies below a value.
    row("getParam", "/c", "/s/below/more"),
    row("hasParam", "/c", "/s/below/more"),
    # An empty namespace stays, and no name is listed for it.
    row("deleteParam", "/c", "/s/below"),
    row("getParam", "/c", "/s"),
    row("hasParam", "/c", "/s"),
    row("getParamNames", "/c"),
    # A namespace is read as a dict.
    row("getParam", "/c", "/"),
    row("getParam", "/c", "/unset"),
    # The server resolves relative and private keys, from the name of the caller.
    row("setParam", "/ns/node", "rel", 1),
    row("setParam", "/ns/node", "~priv", 2),
    row("getParam", "/c", "/ns"),
    row("getParam", "/ns/node", "~priv"),
    row("getParam", "node", "ns/rel"),
    row("getParam", "", "ns/rel"),
    row("getParam", "/ns/", "ns/rel"),
    # Parameters may have any name.
    row("setParam", "/c", "/with space/ü/1abc", [1, 2.5, "x", True, [], {}]),
    row("getParam", "/c", "/with space"),
    # searchParam goes up from the caller's private namespace; only the first part has to be set.
    row("searchParam", "/ns/node", "priv"),
    row("searchParam", "/ns/node/deeper", "rel"),
    row("searchParam", "/ns/node", "rel/not/there"),
    row("searchParam", "/ns/node", "rel/"),
    row("searchParam", "/ns/node", "a"),
    row("searchParam", "/ns/node", "a/b"),
    row("searchParam", "/ns/node", "absent"),
    row("searchParam", "/ns/node", "/ns/rel"),
    row("searchParam", "/ns/node", "/rel"),
    row("searchParam", "/ns/node", "~priv"),
    row("searchParam", "/ns/node", ""),
    row("searchParam", "node", "a"),
    row("searchParam", "/", "a"),
    # Parameters that are not set can be followed.
    row("subscribeParam", "/c", API, "/unset/param"),
    row("subscribeParam", "/c", API, "/x/y"),
    row("subscribeParam", "/c", API, "/x/"),
    row("subscribeParam", "/c", API, "/"),
    # Unsubscribing always succeeds.
    row("unsubscribeParam", "/never", API, "/x"),
    row("unsubscribeParam", "/c", API, "/x"),
    # A node that follows parameters is known until it stops.
    row("lookupNode", "/c", "/c"),
    # Unsubscribing always succeeds.
    row("unsubscribeParam", "/c", API, "/x/y"),
    row("unsubscribeParam", "/c", API, "/unset/param"),
    row("unsubscribeParam", "/c", API, "/"),
    # A node that follows parameters is known until it stops.
    row("lookupNode", "/c", "/c"),
    # Infinity is kept.
    row("setParam", "/c", "/inf", float("inf")),
    row("getParam", "/c", "/inf"),
    # Doubles keep every digit.
    row("setParam", "/c", "/pi", 3.141592653589793),
    row("getParam", "/c", "/pi"),
    # Binary values are kept.
    row("setParam", "/c", "/bin", b"\x00\xff"),
    row("getParam", "/c", "/bin"),
    # Keys of structs with slashes are no paths.
    row("setParam", "/c", "/d", {"x/y": 1}),
    row("getParam", "/c", "/d/x/y"),
    row("hasParam", "/c", "/d/x"),
    row("getParamNames", "/c"),
    row("deleteParam", "/c", "/d"),
    # Empty keys of structs are kept.
    row("setParam", "/c", "/e", {"": 1}),
    row("getParam", "/c", "/e"),
    row("deleteParam", "/c", "/e"),
    # Wrong callers, and too few or wrong parameters, are refused without a fault.
    row("setParam", "/c", "", 1),
    row("setParam", "/c", 5, 1),
    row("setParam", 5, "/x", 1),
    row("setParam", "/c", "/x"),
    row("setParam", "/c", "/x", 1, 2),
    row("getParam"),
    row("getParam", "/c", 0),
    row("hasParam", "/c"),
    row("hasParam", 1, "/x"),
    row("searchParam"),
    row("getParamNames"),
    row("getParamNames", "/c", 1),
    row("deleteParam", "/c"),
    row("subscribeParam", "/c", "nouri", "/x"),
    row("subscribeParam", "/c", "", "/x"),
    row("unsubscribeParam", "/c", API, ""),
    row("registerPublisher", "/c"),
    row("registerPublisher"),
    row("registerSubscriber", 1, "/t", "std_msgs/String", API),
    row("registerService", "/c", "/s"),
    row("unregisterService", "/c", "/s"),
    row("lookupNode"),
    row("lookupNode", "/c", ""),
    row("lookupNode", "/c", "http://x"),
    row("lookupNode", "/c", 7),
    row("lookupService", "/c", ""),
    row("lookupService", "/c", "/"),
    row("getPublishedTopics", "/c"),
    row("getPublishedTopics", "/c", 5),
    row("getTopicTypes"),
    row("getTopicTypes", "/c", 1),
    row("getSystemState"),
    row("getSystemState", 1),
    row("getUri"),
    row("getPid"),
    row("getPid", 3),
    row("shutdown", "/c"),
    row("shutdown"),
    # Several calls in one request.
    row("system.multicall", [{"methodName": "getParam", "params": ["/c", "/x/y"]},
                                   {"methodName": "lookupNode", "params": ["/c", "/none"]}]),
    # Topics and services may have any name without spaces and colons.
    row("registerPublisher", "/c", "a b", "std_msgs/String", API),
    row("registerPublisher", "/c", "a:b", "std_msgs/String", API),
    row("registerPublisher", "/c", "", "std_msgs/String", API),
    row("registerPublisher", "/c", "/", "std_msgs/String", API),
    row("registerPublisher", "/c", "/1abc", "std_msgs/String", API),
    row("registerPublisher", "/c", "/a-b", "std_msgs/String", API),
    row("registerPublisher", "/c", "/ü", "std_msgs/String", API),
    row("registerService", "/c", "/a b", RPC, API),
    row("registerService", "/c", "/", RPC, API),
    # Types are package/Name.
    row("registerPublisher", "/c", "/t", "String", API),
    row("registerPublisher", "/c", "/t", "a/b/c", API),
    row("registerPublisher", "/c", "/t", "", API),
    row("registerPublisher", "/c", "/t", 3, API),
    row("registerSubscriber", "/c", "/slash", "/", API),
    # URIs of nodes are http, or rosrpc.
    row("registerPublisher", "/c", "/t", "a/b", "https://h:1/"),
    row("registerPublisher", "/c", "/t", "a/b", ""),
    row("registerPublisher", "/c", "/t", "a/b", 5),
    row("registerSubscriber", "/r", "/t", "a/b", RPC),
    row("unregisterSubscriber", "/r", "/t", RPC),
    # Unregistering what is not registered succeeds, with 0.
    row("unregisterPublisher", "/nobody", "/t", API),
    row("unregisterSubscriber", "/c", "/t", API),
    row("unregisterService", "/nobody", "/s", RPC),
    # The last publisher decides the type, which is kept when it leaves.
    row("registerSubscriber", "/s", "/typed", "*", API),
    row("registerPublisher", "/p1", "/typed", "a/One", API),
    row("registerPublisher", "/p2", "/typed", "a/Two", API),
    row("registerPublisher", "/p3", "/typed", "*", API),
    row("registerSubscriber", "/s", "/typed", "a/Three", API),
    row("getTopicTypes", "/c"),
    # A namespace as a filter of getPublishedTopics.
    row("getPublishedTopics", "/c", ""),
    row("getPublishedTopics", "/c", "/typed"),
    row("getPublishedTopics", "/c", "/ty"),
    row("registerPublisher", "/p1", "/sub/one", "a/One", API),
    row("getPublishedTopics", "/c", "/sub"),
    row("getPublishedTopics", "/c", "sub/"),
    row("getPublishedTopics", "/sub/x", "one"),
    # The state of the whole system.
    row("getSystemState", "/c"),
    # Only the right node at the right URI is unregistered.
    row("unregisterPublisher", "/p2", "/sub/one", API),
    row("unregisterPublisher", "/p1", "/sub/one", "http://other:1/"),
    row("unregisterPublisher", "/p1", "/sub/one", API),
    # The last publisher decides the type, which is kept when it leaves.
    row("unregisterPublisher", "/p1", "/typed", API),
    row("unregisterPublisher", "/p2", "/typed", API),
    row("unregisterPublisher", "/p3", "/typed", API),
    row("getTopicTypes", "/c"),
    # lookupNode resolves names relative to the caller.
    row("lookupNode", "/s", "s"),
    row("lookupNode", "/ns/x", "s"),
    row("lookupNode", "/s", "~"),
    # The last provider of a service wins.
    row("lookupService", "/c", "/srv"),
    row("registerService", "/n1", "/srv", RPC, API),
    row("registerService", "/n2", "/srv", "rosrpc://127.0.0.1:3", "http://127.0.0.1:4/"),
    row("lookupService", "/c", "/srv"),
    row("unregisterService", "/n1", "/srv", RPC),
    row("lookupService", "/c", "srv"),
    # The state of the whole system.
    row("getSystemState", "/c"),
    # The last provider of a service wins.
    row("unregisterService", "/n2", "/srv", "rosrpc://127.0.0.1:3"),
    row("lookupService", "/c", "/srv"),
    row("lookupNode", "/c", "/n2"),
    # A new node of the same name replaces the old one.
    row("registerPublisher", "/dup", "/old", "a/One", API),
    row("registerSubscriber", "/dup", "/olds", "a/One", API),
    row("registerService", "/dup", "/oldsrv", RPC, API),
    row("registerPublisher", "/dup", "/new", "a/One", "http://127.0.0.1:5/"),
    row("lookupNode", "/c", "/dup"),
    row("lookupService", "/c", "/oldsrv"),
    # The state of the whole system.
    row("getSystemState", "/c"),
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
                different.append(f"{request.method}{request.params}: {expected} -> {got}")
        await client.close()
    assert not different, "\n".join(different)
