"""The tree of parameters and its followers, without a server."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.master.parameters import (
    ParameterTree,
    ParamUpdate,
    holds_nil,
    param_updates,
    subscription_key,
)


def tree(root: dict[str, Any], **options: Any) -> ParameterTree:
    made = ParameterTree(**options)
    made.set("/", root)
    return made


def test_the_root_is_a_namespace() -> None:
    made = tree({"a": 1})
    made.set("/", {"b": 2})
    assert made.get("/") == {"b": 2}
    with pytest.raises(TypeError):
        made.set("/", 5)
    assert made.get("/") == {"b": 2}


@pytest.mark.parametrize("key", ["/", "/nope", "/a/b", "/s/below", "/s/below/more"])
def test_deleting_the_root_or_an_unset_key_raises_key_error(key: str) -> None:
    made = tree({"a": {}, "s": "text"})
    with pytest.raises(KeyError):
        made.delete(key)
    assert made.get("/") == {"a": {}, "s": "text"}


def test_a_value_in_the_way_becomes_a_namespace() -> None:
    made = tree({"s": "text"})
    made.set("/s/a/b", 1)
    assert made.get("/s") == {"a": {"b": 1}}


def test_below_a_value_there_is_nothing() -> None:
    made = tree({"s": "text", "l": [1]})
    for key in ("/s/x", "/l/0", "/s/x/y"):
        assert not made.has(key)
        with pytest.raises(KeyError):
            made.get(key)


def test_empty_namespaces_stay() -> None:
    made = tree({"a": {"b": {"c": 1}}})
    made.delete("/a/b/c")
    assert made.get("/a") == {"b": {}}
    assert made.has("/a/b")
    assert made.names() == []


def test_a_namespace_is_read_as_a_dict() -> None:
    made = tree({"a": {"b": 1}, "c": [{"d": 2}]})
    assert made.get("/a") == {"b": 1}
    assert made.names() == ["/a/b", "/c"]


@pytest.mark.parametrize(
    ("caller_id", "key", "expected"),
    [
        ("/ns/node", "priv", "/ns/node/priv"),
        ("/ns/node", "rel", "/ns/rel"),
        ("/ns/node/deep", "rel", "/ns/rel"),
        ("/ns/node", "top", "/top"),
        ("/", "top", "/top"),
        ("/ns/node", "rel/not/there", "/ns/rel/not/there"),
        ("/ns/node", "rel/", "/ns/rel/"),
        ("/ns/node", "absent", None),
        ("/ns/node", "/ns/rel", "/ns/rel"),
        ("/ns/node", "/rel", None),
    ],
)
def test_search_goes_up_from_the_namespace_of_the_caller(
    caller_id: str, key: str, expected: str | None
) -> None:
    made = tree({"ns": {"node": {"priv": 1}, "rel": {"x": 2}}, "top": 3})
    assert made.search(caller_id, key) == expected


@pytest.mark.parametrize(("caller_id", "key"), [("/n", "~a"), ("/n", ""), ("n", "a"), ("", "a")])
def test_search_with_an_invalid_key_or_caller_is_refused(caller_id: str, key: str) -> None:
    with pytest.raises(ValueError, match=r"invalid key|must be global"):
        tree({"a": 1}).search(caller_id, key)


def test_the_depth_of_the_whole_tree_is_bounded() -> None:
    made = tree({}, max_depth=4)
    made.set("/a/b/c/d", 1)
    made.set("/a/b/c", [1])
    for key, value in (("/a/b/c/d/e", 1), ("/a/b/c", [[1]]), ("/", {"a": {"b": {"c": {"d": {}}}}})):
        with pytest.raises(ValueError, match="4 namespaces"):
            made.set(key, value)
    assert made.get("/") == {"a": {"b": {"c": [1]}}}


@given(st.data())
def test_what_was_read_does_not_change(data: st.DataObject) -> None:
    names = st.sampled_from(["a", "b", "c"])
    keys = st.lists(names, min_size=1, max_size=3).map(lambda parts: "/" + "/".join(parts))
    values = st.recursive(st.integers(), lambda inner: st.dictionaries(names, inner), max_leaves=5)
    made = ParameterTree()
    snapshots: list[tuple[Any, str]] = []
    for _ in range(data.draw(st.integers(1, 8))):
        key = data.draw(keys)
        if data.draw(st.booleans()):
            value = data.draw(values)
            made.set(key, value)
            assert made.get(key) == value
            assert made.has(key)
        elif made.has(key):
            made.delete(key)
            assert not made.has(key)
        root = made.get("/")
        snapshots.append((root, repr(root)))
    assert all(repr(root) == text for root, text in snapshots)
    for name in made.names():
        assert not isinstance(made.get(name), dict)


# --------------------------------------------------------------------------- followers


def told(
    followers: dict[str, str], key: str, value: Any, **options: Any
) -> list[tuple[str, str, Any]]:
    """``followers``: key -> node; returns (node, key, value) in any order."""
    subscribers: dict[str, dict[str, str]] = {}
    for followed, node in followers.items():
        subscribers.setdefault(subscription_key(followed), {})[node] = "http://" + node
    updates = param_updates(subscribers, key, value, **options)
    assert all(update.api == "http://" + update.caller_id for update in updates)
    return sorted((update.caller_id, update.key, update.value) for update in updates)


def test_keys_of_updates_end_in_a_slash() -> None:
    assert told({"/q/r": "n"}, "/q/r", 5) == [("n", "/q/r/", 5)]
    assert param_updates({"/q/": {"n": "http://n"}}, "/q", 1) == [
        ParamUpdate("http://n", "n", "/q/", 1)
    ]


def test_a_follower_is_told_of_children() -> None:
    assert told({"/q/r": "n", "/": "root"}, "/q/r/c", 5) == [
        ("n", "/q/r/c/", 5),
        ("root", "/q/r/c/", 5),
    ]


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("/q", {"r": 5, "s": 6}, 5),
        ("/q", {"r": {"c": 1}}, {"c": 1}),
        ("/", {"q": {"r": 7}}, 7),
        ("/q", {"s": 6}, {}),
        ("/q", {}, {}),
        ("/q", "a value in place of the namespace", {}),
    ],
)
def test_a_follower_is_told_only_its_part_of_a_parent(key: str, value: Any, expected: Any) -> None:
    assert told({"/q/r": "n"}, key, value) == [("n", "/q/r/", expected)]


def test_siblings_are_not_mixed_up() -> None:
    assert told({"/q/r": "n"}, "/q/rr", 5) == []
    assert told({"/q/rr": "n"}, "/q/r", {}) == []


def test_the_node_that_sets_a_parameter_is_not_told() -> None:
    assert told({"/q/r": "n", "/q": "m"}, "/q/r", 5, setter="n") == [("m", "/q/r/", 5)]


def test_nobody_follows() -> None:
    assert param_updates({}, "/q", 1) == []


def test_struct_keys_with_slashes_are_not_paths() -> None:
    assert told({"/d/x/y": "n"}, "/d", {"x/y": 1}) == [("n", "/d/x/y/", {})]


@pytest.mark.parametrize(
    ("key", "expected"), [("/", "/"), ("/a", "/a/"), ("/a/", "/a/"), ("//a//b", "/a/b/")]
)
def test_subscription_keys(key: str, expected: str) -> None:
    assert subscription_key(key) == expected


def test_nils_are_found() -> None:
    assert holds_nil(None)
    assert holds_nil({"a": [1, {"b": None}]})
    assert not holds_nil({"a": [1, {"b": {}}], "": 0})


def test_the_whole_tree_is_bounded_and_what_is_replaced_makes_room() -> None:
    tree = ParameterTree(max_bytes=10_000, max_values=100)
    for _ in range(20):
        tree.set("/text", "x" * 8_000)
    with pytest.raises(ValueError, match="more than 10000 bytes of parameters"):
        tree.set("/other", "x" * 4_000)
    assert tree.names() == ["/text"]
    tree.delete("/text")
    for _ in range(20):
        tree.set("/list", [0] * 90)
    with pytest.raises(ValueError, match="more than 100 values in all parameters"):
        tree.set("/a/b/c", list(range(20)))
    tree.set("/list", 1)
    tree.set("/a/b/c", list(range(20)))
    tree.set("/", {})
    tree.set("/text", "x" * 8_000)


def test_names_that_nobody_can_ask_for_are_not_listed() -> None:
    """Each name repeats those of its namespaces: a small struct may have huge names."""
    tree = ParameterTree()
    value = {"b" * 500: {"c" * 520: 1, "d" * 521: 2}, "e" * 1021: 3, "f" * 1022: {"g": 4}}
    tree.set("/a", value)
    assert sorted(map(len, tree.names())) == [1024, 1024]
    assert tree.get("/a") == value


def test_all_names_together_are_bounded() -> None:
    tree = ParameterTree(max_names=10)
    tree.set("/a", {"bcd": 1})
    assert tree.names() == ["/a/bcd"]
    tree.set("/a/e", 1)
    assert sorted(tree.names()) == ["/a/bcd", "/a/e"]
    tree.set("/f", 1)
    with pytest.raises(ValueError, match="more than 10 characters together"):
        tree.names()
