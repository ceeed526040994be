"""Names: resolved, remapped and refused."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aioros1.errors import InvalidNameError
from aioros1.names import (
    anonymous_name,
    canonicalize,
    is_global,
    is_private,
    join,
    namespace_of,
    normalize_namespace,
    parse_args,
    qualify,
    resolve_from,
    resolve_name,
    resolve_remappings,
    validate,
    validate_base_name,
)

NODE = "/ns/node"


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("/", "/"),
        ("//", "/"),
        ("a", "a"),
        ("a//b/", "a/b"),
        ("//a//b/", "/a/b"),
        ("~a/", "~a"),
        ("", ""),
    ],
)
def test_canonical_form(name: str, expected: str) -> None:
    assert canonicalize(name) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("/abs", "/abs"),
        ("/abs//x/", "/abs/x"),
        ("rel", "/ns/rel"),
        ("rel/x", "/ns/rel/x"),
        ("~priv", "/ns/node/priv"),
        ("~/priv", "/ns/node/priv"),
        ("~", "/ns/node"),
        ("1abc", "/ns/1abc"),
        ("a-b", "/ns/a-b"),
        ("ü", "/ns/ü"),
    ],
)
def test_names_are_resolved_in_the_namespace_of_the_node(name: str, expected: str) -> None:
    assert resolve_name(name, "/ns", NODE) == expected


def test_resolution_in_the_root_namespace() -> None:
    assert resolve_name("rel", "/", "/node") == "/rel"
    assert resolve_name("~priv", "/", "/node") == "/node/priv"


@pytest.mark.parametrize("name", ["", "/", "//", "a b", "a:b", " "])
def test_names_that_no_master_accepts(name: str) -> None:
    with pytest.raises(InvalidNameError) as caught:
        resolve_name(name, "/ns", NODE, what="topic")
    assert repr(name) in str(caught.value)
    assert "topic" in str(caught.value)
    assert isinstance(caught.value, ValueError)


def test_names_are_strings() -> None:
    with pytest.raises(TypeError, match="a topic is a str, not int: 5"):
        validate(5, "topic")  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["", "/", "a/b", "/a", "~a", "a b", "a:b"])
def test_base_names_that_are_refused(name: str) -> None:
    with pytest.raises(InvalidNameError, match="node name"):
        validate_base_name(name)


@pytest.mark.parametrize(
    ("namespace", "expected"),
    [("foo", "/foo"), ("", "/"), ("/", "/"), ("/foo/", "/foo"), ("foo//bar/", "/foo/bar")],
)
def test_namespaces(namespace: str, expected: str) -> None:
    assert normalize_namespace(namespace) == expected
    assert qualify(namespace, "n") == (expected.rstrip("/") + "/n")


@pytest.mark.parametrize("namespace", ["~foo", "a b", "a:b"])
def test_namespaces_that_are_refused(namespace: str) -> None:
    with pytest.raises(InvalidNameError, match="namespace"):
        normalize_namespace(namespace)


def test_parts_of_names() -> None:
    assert [namespace_of(name) for name in ("/", "/a", "/a/b", "/a/b/")] == ["/", "/", "/a", "/a"]
    assert [join("/", "a"), join("/a", "b"), join("/a", "/b"), join("/a", "~b"), join("", "b")] == [
        "/a",
        "/a/b",
        "/b",
        "~b",
        "b",
    ]
    assert join("~", "a") == "~a"
    assert is_global("/a")
    assert not is_global("a")
    assert is_private("~a")
    assert not is_private("/~a")
    assert not is_global("")


# --------------------------------------------------------------------------- remappings


@pytest.mark.parametrize(
    "remapping",
    [("scan", "laser"), ("/ns/scan", "laser"), ("scan", "/ns/laser"), ("/ns/scan/", "/ns//laser")],
)
@pytest.mark.parametrize("name", ["scan", "/ns/scan"])
def test_remappings_match_whatever_way_they_are_written(
    remapping: tuple[str, str], name: str
) -> None:
    table = resolve_remappings(dict([remapping]), "/ns", NODE)
    assert resolve_name(name, "/ns", NODE, table) == "/ns/laser"


def test_remappings_of_private_names() -> None:
    table = resolve_remappings({"~in": "/camera", "out": "~debug"}, "/ns", NODE)
    assert resolve_name("~in", "/ns", NODE, table) == "/camera"
    assert resolve_name("out", "/ns", NODE, table) == "/ns/node/debug"
    assert resolve_name("other", "/ns", NODE, table) == "/ns/other"


def test_remappings_are_not_followed_twice() -> None:
    table = resolve_remappings({"a": "b", "b": "a"}, "/", "/n")
    assert resolve_name("a", "/", "/n", table) == "/b"


def test_remappings_to_what_is_no_name() -> None:
    with pytest.raises(InvalidNameError, match="remap"):
        resolve_remappings({"a": "b c"}, "/", "/n")


def test_arguments() -> None:
    argv = [
        "program.py",
        "a:=b",
        "/x/y:=~z",
        "_rate:=10",
        "_text:=a:=b",
        "_empty:=",
        "__name:=other",
        "__ns:=/robot",
        "__log:=/tmp/x.log",
        "--flag",
        "--opt=a:=b",
        "-x",
        "word",
        "1:=2",
        ":=",
    ]
    arguments = parse_args(argv)
    assert arguments.remappings == {"a": "b", "/x/y": "~z"}
    assert arguments.params == {"rate": "10", "text": "a:=b"}
    assert arguments.special == {"__name": "other", "__ns": "/robot", "__log": "/tmp/x.log"}
    assert arguments.rest == ["program.py", "--flag", "--opt=a:=b", "-x", "word", "1:=2", ":="]


@pytest.mark.parametrize("word", ["a:=", "a:= ", "/a:=", "~a:=", "_a:=", "_a:=  "])
def test_an_assignment_of_nothing_is_ignored(word: str) -> None:
    """A launch file has it whose argument is empty."""
    arguments = parse_args(["a:=b", "_a:=1", word])
    assert arguments.remappings == {"a": "b"}
    assert arguments.params == {"a": "1"}
    assert arguments.rest == []


def test_anonymous_names_differ_and_are_names() -> None:
    names = {anonymous_name("talker") for _ in range(100)}
    assert len(names) == 100
    for name in names:
        assert name.startswith("talker_")
        assert name.isidentifier()
    with pytest.raises(InvalidNameError):
        anonymous_name("a/b")


# --------------------------------------------------------------------------- as masters do


@pytest.mark.parametrize(
    ("name", "caller_id", "expected"),
    [
        ("/x//y/", "/ns/node", "/x/y"),
        ("key", "/ns/node", "/ns/key"),
        ("~key", "/ns/node", "/ns/node/key"),
        ("key", "/ns/", "/key"),
        ("key", "node", "/key"),
        ("key", "", "/key"),
        ("", "/ns/node", "/ns/"),
        ("a b", "/n", "/a b"),
    ],
)
def test_masters_resolve_names_relative_to_the_caller(
    name: str, caller_id: str, expected: str
) -> None:
    assert resolve_from(name, caller_id) == expected


@given(st.text(), st.text())
def test_masters_resolve_anything(name: str, caller_id: str) -> None:
    assert isinstance(resolve_from(name, caller_id), str)


@given(st.text(alphabet="ab/~"))
def test_resolved_names_stay_as_they_are(name: str) -> None:
    try:
        resolved = resolve_name(name, "/ns", NODE)
    except InvalidNameError:
        return
    assert resolved.startswith("/")
    assert canonicalize(resolved) == resolved
    assert resolve_name(resolved, "/other", "/other/n") == resolved


@pytest.mark.parametrize("bad", ["a\x01b", "a\x0cb", "a\ud800b", "\ufffe"])
def test_names_that_no_master_can_be_told_of(bad: str) -> None:
    for refused in (
        lambda: validate(bad),
        lambda: validate_base_name(bad),
        lambda: normalize_namespace(bad),
        lambda: resolve_name(bad, "/", "/node"),
        lambda: resolve_remappings({"a": bad}, "/", "/node"),
    ):
        with pytest.raises(InvalidNameError, match="XML cannot carry"):
            refused()
    # The value of a parameter is no name, and a file name may have any bytes.
    assert parse_args([f"_x:={bad}", f"{bad}.bag"]).params == {"x": bad}
