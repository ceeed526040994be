"""``_name:=value`` on a command line: what is read, with PyYAML and without, and when it is set."""

from __future__ import annotations

import asyncio
import itertools
import logging
import sys

import pytest
import yaml

import aioros1
from aioros1.node.private_params import PrivateParams, parse_value
from aioros1.node.yaml_scalars import NeedsYamlError, read_scalar
from aioros1.wire.xmlrpc import encode_response

SINGLE = [
    # numbers
    *("0", "7", "-7", "+7", "010", "-010", "0o7", "08", "0_7", "1_000", "_1", "1_", "0x10", "0X10"),
    *("-0xff", "0x_f", "0b1", "0b101", "-0b1", "0b", "0b2", "1:30", "-1:30", "1:30:15", "1:60"),
    *("1:30.5", "190:20:30.15", "2147483647", "-2147483648", "2147483648", "00", "0_", "1e5"),
    *("1.0e5", "1.5e+3", "1e+3", "1.", "-1.", ".5", "-.5", "+.5", "1.5.2", "1_0.2_5", "1,5"),
    *("nan", "NaN", ".nan", ".NaN", ".NAN", "-.nan", "inf", ".inf", "-.inf", "+.INF", ".Inf"),
    *("1.0e+400", "0.1", "1.e+3", "1.5E-3", "._1", ".", "-", "+", "--", "e5", "0x", "1__0"),
    # words
    *("true", "True", "TRUE", "tRUE", "false", "yes", "Yes", "no", "NO", "on", "On", "off", "OFF"),
    *("y", "n", "Y", "N", "t", "f", "~", "null", "Null", "NULL", "nULL", "none", "None", "~x"),
    # dates
    *("2001-12-14", "2001-1-4", "2001-12-14 21:59:43", "2001-12-14T21:59:43", "2001-13-14"),
    *("2001-12-14 21:59:43.10", "2001-12-14 21:59:43Z", "2001-12-14t21:59:43.1-05:00"),
    *("2001-02-30", "21:59:43", "2001-12-14 25:00:00", "2001-12-14  1:02:03 +2"),
    # text
    *("bob", "a b", "a#b", "a #b", "#a", "a:b", "http://host:1/x", "x, y", "a]", "a}", "-x", "?x"),
    *(
        ":x",
        "a'b",
        'a"b',
        "deg(90)",
        "rad(pi)",
        "$x",
        "(1, 2)",
        "/camera/image",
        "~/file",
        "/",
        "=",
    ),
    *(
        "<<",
        "a=b",
        "a - b",
        "a ? b",
        "ä",
        "日本",
        "a\tb",
        "---a",
        "..",
        "a\\nb",
        "a\x01b",
        "a\x7fb",
    ),
    *(",x", "]", "}", "%x", "@x", "`x", "a,", "a:", "a: ", "a : b", "-- x", "5 #five", "a  b"),
    # quotes
    *("'123'", '"123"', "'yes'", "''", '""', "'it''s'", "'a' #b", "'a'b", "'a", '"a', "'a''", "'"),
    *(r"'a\nb'", r'"a\nb"', r'"\x41\u00e9\U0001F600"', r'"\q"', r'"\x4"', r'"\e\a\0"', r'"a\"b"'),
    *(r'"\N\_\L\P"', '"a" x', "'a': 1", "'a':1", "'a' : 1", r'"\/"', "'#'", "' a '", '" a\t"'),
    r'"a\ b"',
]
MORE = [
    *(
        "[1, 2]",
        "[]",
        "{a: 1}",
        "{}",
        "[1,",
        "{a",
        "a: 1",
        "- 1",
        "-",
        "? a",
        "!!str 5",
        "!!int '5'",
    ),
    *(
        "!!float 5",
        "!!binary aGk=",
        "!x 5",
        "&a 5",
        "*a",
        "| x",
        ">",
        "|\n  a\n  b",
        "a\nb",
        "--- 5",
    ),
    *("...", "---", "[[1, 2.5], {b: yes}]", "!!python/name:os.system", "'a\n\n b'", "a:\n  b: 1"),
    "!!set {a}",
]


def read(text: str) -> object:
    """What a node sets for ``_x:=text``; the kind of error if it refuses that."""
    try:
        return repr(parse_value(text))
    except ValueError:
        return ValueError


@pytest.mark.parametrize("text", SINGLE)
def test_single_values_are_read_without_pyyaml_as_with_it(
    monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    try:
        value = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError):
        expected: object = ValueError
    else:
        try:
            encode_response(value)
            expected = repr(value)
        except (TypeError, ValueError, OverflowError):
            expected = ValueError
    assert read(text) == expected
    monkeypatch.setitem(sys.modules, "yaml", None)  # importing it fails
    try:
        found = read(text)
    except NeedsYamlError:  # a key, or the beginning of something
        assert isinstance(value, dict | list)
    else:
        assert found == expected


@pytest.mark.parametrize("text", MORE)
def test_what_takes_pyyaml_is_never_silently_text(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, text: str
) -> None:
    monkeypatch.setitem(sys.modules, "yaml", None)
    params = PrivateParams.of({"x": text, "y": "1"})
    assert params.values == {"x": text, "y": 1}
    assert f"_x:={text}" in params.warning
    assert "pip install 'aioros1[yaml]'" in params.warning


def test_short_words_of_every_kind() -> None:
    """All words of three of these characters: an error or a warning, or what PyYAML makes of it."""
    for word in map("".join, itertools.product("01.:-_eE'\"# [yn", repeat=3)):
        text = word.strip()
        try:
            expected: object = repr(yaml.safe_load(text))
        except (yaml.YAMLError, ValueError):
            expected = ValueError
        try:
            found: object = repr(read_scalar(text))
        except ValueError:
            found = ValueError
        except NeedsYamlError:
            if expected is ValueError or str(expected)[0] in "[{N":
                continue
            found = "a warning"
        assert found == expected, text


async def test_what_was_not_read_is_said_once(monkeypatch, caplog, make_node, master):
    monkeypatch.setitem(sys.modules, "yaml", None)
    with caplog.at_level(logging.WARNING):
        node = await make_node("demo", argv=["_list:=[1, 2]", "_table:={a: 1}", "_rate:=010"])
        assert await node.get_param("~") == {"list": "[1, 2]", "table": "{a: 1}", "rate": 8}
    (said,) = [record.getMessage() for record in caplog.records if "PyYAML" in record.getMessage()]
    assert said.startswith("_list:=[1, 2], _table:={a: 1}: kept as text")


@pytest.mark.parametrize(
    ("word", "text"),
    [
        ("_list:=[1, ", r"_list:=\[1,: expected a value in YAML, got '\[1,'"),
        ("_x:=~", r"_x:=~: expected the value of a parameter, got '~'"),
        ("_x:=2147483648", "_x:=2147483648: expected the value of a parameter"),
        ("_x:=" + "[" * 5000, "expected a value in YAML"),
    ],
)
def test_what_no_parameter_can_have_is_refused(word, text):
    with pytest.raises(ValueError, match=text):
        aioros1.Node("demo", argv=[word])


async def test_they_are_set_again_at_a_master_that_was_restarted(monkeypatch):
    async with aioros1.Master(host="localhost", port=0, rosout=False) as old:
        port, uri = old.port, old.uri
        node = aioros1.Node(
            "demo", master_uri=uri, host="localhost", heartbeat=0.02, argv=["_x:=1", "_y:=2"]
        )
        await node.start()
        await node.set_param("~z", 3)
        await node.set_param("~y", 4)
    try:
        async with aioros1.Master(
            host="localhost", port=port, rosout=False, params={"demo": {"x": 5}}
        ):
            async with asyncio.timeout(30):
                while not await node.has_param("~y"):
                    await asyncio.sleep(0.01)
            # What the launch file has set is not replaced; what the program set is its own.
            assert await node.get_param("~") == {"x": 5, "y": 2}
    finally:
        await node.close()


async def test_namespace_of_nothing_is_the_root(monkeypatch):
    """As in rospy and roscpp, whatever the environment says."""
    monkeypatch.setenv("ROS_NAMESPACE", "/env")
    assert aioros1.Node("demo", argv=[]).name == "/env/demo"
    assert aioros1.Node("demo", argv=["__ns:="]).name == "/demo"
    assert aioros1.Node("demo", argv=["__ns:="], namespace="given").name == "/given/demo"


@pytest.mark.parametrize("word", ["foo:=", "_x:=", "__name:=", "__master:=", "__ip:=", "__log:="])
async def test_a_node_starts_in_spite_of_an_empty_word(make_node, word):
    node = await make_node("demo", argv=[word])
    assert node.name == "/demo"
    assert node.resolve_name("foo") == "/foo"
    assert not await node.has_param("~x")
