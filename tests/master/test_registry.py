"""The registry without a server: what is answered, and who is told."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from aioros1.master.registry import PublisherUpdate, Registry, Shutdown

A, B, C = "http://a:1/", "http://b:1/", "http://c:1/"


def state(registry: Registry) -> Any:
    return registry.system_state()[2]


def test_subscribers_are_told_of_every_registration() -> None:
    registry = Registry()
    assert registry.register_subscriber("/s", "/t", "a/T", A) == ((1, "Subscribed to [/t]", []), [])
    answer, told = registry.register_publisher("/p", "/t", "a/T", B)
    assert answer == (1, "Registered [/p] as publisher of [/t]", [A])
    assert told == [PublisherUpdate(A, "/t", [B])]
    assert registry.register_publisher("/p", "/t", "a/T", B) == (answer, told)
    assert state(registry) == [[["/t", ["/p"]]], [["/t", ["/s"]]], []]


def test_subscribers_are_told_of_the_last_publisher_leaving() -> None:
    registry = Registry()
    registry.register_publisher("/p", "/t", "a/T", B)
    registry.register_subscriber("/s", "/t", "a/T", A)
    answer, told = registry.unregister_publisher("/p", "/t", B)
    assert answer == (1, "Unregistered [/p] as provider of [/t]", 1)
    assert told == [PublisherUpdate(A, "/t", [])]
    assert registry.lookup_node("/p") == (-1, "unknown node [/p]", "")


def test_a_new_node_of_the_same_name_takes_everything() -> None:
    registry = Registry()
    registry.register_subscriber("/s", "/t", "a/T", A)
    registry.register_publisher("/dup", "/t", "a/T", B)
    registry.register_subscriber("/dup", "/u", "a/T", B)
    registry.register_service("/dup", "/v", "rosrpc://b:2", B)
    registry.register_param_subscriber("/dup", "/k/", B)
    _, told = registry.register_publisher("/dup", "/new", "a/T", C)
    assert told == [
        Shutdown(B, "/dup", "[/dup] Reason: new node registered with same name"),
        PublisherUpdate(A, "/t", []),
    ]
    assert state(registry) == [[["/new", ["/dup"]]], [["/t", ["/s"]]], []]
    assert registry.param_subscribers == {}
    assert registry.lookup_node("/dup")[2] == C
    assert not registry.knows_api(B)


def test_a_node_is_not_told_to_end_at_an_address_where_another_is_now() -> None:
    """The first was killed, and another program got its port."""
    registry = Registry()
    registry.register_publisher("/a", "/t", "a/T", A)
    registry.register_publisher("/b", "/u", "a/T", A)
    _, told = registry.register_publisher("/a", "/t", "a/T", B)
    assert told == []
    assert registry.lookup_node("/b")[2] == A
    assert registry.lookup_node("/a")[2] == B


def test_others_unregister_nothing() -> None:
    registry = Registry()
    registry.register_publisher("/p", "/t", "a/T", A)
    registry.register_publisher("/q", "/t", "a/T", B)
    assert registry.unregister_publisher("/q", "/t", A)[0][2] == 0
    assert registry.unregister_publisher("/p", "/t", B)[0][2] == 0
    assert state(registry)[0] == [["/t", ["/p", "/q"]]]


def test_the_last_provider_wins() -> None:
    registry = Registry()
    registry.register_service("/n1", "/s", "rosrpc://a:2", A)
    registry.register_service("/n2", "/s", "rosrpc://b:2", B)
    answer, _ = registry.unregister_service("/n1", "/s", "rosrpc://a:2")
    assert (answer[0], answer[2]) == (1, 0)
    assert registry.lookup_service("/s") == (1, "rosrpc URI: [rosrpc://b:2]", "rosrpc://b:2")
    assert registry.lookup_node("/n1")[0] == -1  # it has nothing left
    registry.register_service("/n2", "/s", "rosrpc://b:3", B)  # the same node, restarted inside
    assert registry.unregister_service("/n2", "/s", "rosrpc://b:2")[0][2] == 0
    assert registry.lookup_node("/n2")[0] == 1
    assert registry.unregister_service("/n2", "/s", "rosrpc://b:3")[0][2] == 1
    assert registry.lookup_service("/s") == (-1, "no provider", "")


def test_the_type_of_the_last_publisher_wins_and_is_kept() -> None:
    registry = Registry()
    registry.register_subscriber("/s", "/t", "*", A)
    assert registry.topic_types()[2] == []
    registry.register_subscriber("/s", "/t", "a/Sub", A)
    registry.register_publisher("/p", "/t", "*", A)
    assert registry.topic_types()[2] == [["/t", "a/Sub"]]
    registry.register_publisher("/p", "/t", "a/One", A)
    registry.register_publisher("/q", "/t", "a/Two", B)
    registry.register_subscriber("/s", "/t", "a/Sub", A)
    assert registry.topic_types()[2] == [["/t", "a/Two"]]
    registry.unregister_publisher("/p", "/t", A)
    registry.unregister_publisher("/q", "/t", B)
    assert registry.topic_types()[2] == [["/t", "a/Two"]]
    registry.register_publisher("/p", "/only", "*", A)
    assert registry.published_topics("") == (1, "current topics", [["/only", "*"]])


def test_a_node_that_only_follows_parameters_is_known_until_it_stops() -> None:
    registry = Registry()
    registry.register_param_subscriber("/n", "/k/", A)
    assert registry.lookup_node("/n") == (1, "node api", A)
    registry.unregister_param_subscriber("/n", "/k/", B)
    assert registry.lookup_node("/n")[0] == 1
    registry.unregister_param_subscriber("/n", "/k/", A)
    assert registry.lookup_node("/n")[0] == -1


def test_two_nodes_of_one_process_are_told_once() -> None:
    registry = Registry()
    registry.register_subscriber("/s1", "/t", "a/T", A)
    registry.register_subscriber("/s2", "/t", "a/T", A)
    _, told = registry.register_publisher("/p", "/t", "a/T", B)
    assert told == [PublisherUpdate(A, "/t", [B])]
    registry.unregister_subscriber("/s1", "/t", A)
    assert registry.knows_api(A)
    registry.unregister_subscriber("/s2", "/t", A)
    assert not registry.knows_api(A)


NODES = st.sampled_from(["/n1", "/n2", "/n3"])
APIS = st.sampled_from([A, B])
NAMES = st.sampled_from(["/x", "/y"])


@given(st.lists(st.tuples(st.sampled_from("pPsSvVkK"), NODES, NAMES, APIS)))
def test_the_tables_agree_with_each_other(steps: list[tuple[str, str, str, str]]) -> None:
    registry = Registry()
    for step, node, name, api in steps:
        match step:
            case "p":
                registry.register_publisher(node, name, "a/T", api)
            case "P":
                registry.unregister_publisher(node, name, api)
            case "s":
                registry.register_subscriber(node, name, "a/T", api)
            case "S":
                registry.unregister_subscriber(node, name, api)
            case "v":
                registry.register_service(node, name, "rosrpc://" + api, api)
            case "V":
                registry.unregister_service(node, name, "rosrpc://" + api)
            case "k":
                registry.register_param_subscriber(node, name, api)
            case "K":
                registry.unregister_param_subscriber(node, name, api)
        publishers, subscribers, services = state(registry)
        params = [[key, list(nodes)] for key, nodes in registry.param_subscribers.items()]
        named = {node for table in (publishers, subscribers, services, params)
                 for _, nodes in table for node in nodes}  # fmt: skip
        apis = set()
        for node in ("/n1", "/n2", "/n3"):
            code, _, uri = registry.lookup_node(node)
            assert code == 1 or node not in named
            if code == 1:
                apis.add(uri)
        assert all(
            nodes for table in (publishers, subscribers, services, params) for _, nodes in table
        )
        assert {api for api in (A, B) if registry.knows_api(api)} == apis
