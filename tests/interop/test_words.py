"""The words of a command line: what rospy makes of each, and what we do."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest

from aioros1.names import parse_args

from . import debian
from .world import World

WORDS = [
    *("foo:=bar", "foo:=", "foo:= ", ":=x", ":=", "a:=b:=c", "foo:=/x", "~a:=b", "/a:=~b", "1a:=b"),
    *("__ns:=", "__ns:=/", "__ns:=q", "__ns:=/q/r/", "__name:=", "__name:=other", "__foo:=bar"),
    *("_x:=", "_x:= ", "_x:=1", "_x:=010", "_x:=1e5", "_x:=yes", "_x:='123'", "_x:=[1, {a: on}]"),
    *(
        "_x:=~",
        "_x:=[1,",
        "_x:=1:30",
        "_x:=deg(90)",
        "_x:=2001-12-14",
        "_/x:=1",
        "_x/y:=2",
        "_x:=''",
    ),
    *("--foo:=bar", "-f:=b", "a-b:=c", "___x:=1", "word"),
]

NAMES = ("foo", "a", "/a", "~a", "__foo", "1a")

ROSPY = """
import json, sys
import rosgraph.names, rospy
from rospy.client import load_command_line_node_params, myargv

def of(words, names):
    name = rosgraph.names.load_mappings(words).get("__name", "n")
    namespace = rosgraph.names.get_ros_namespace(argv=words)
    rospy.names.reload_mappings(words)
    rospy.names._set_caller_id(namespace + name)
    rospy.names.initialize_mappings(namespace + name)
    params = load_command_line_node_params(words)
    json.dumps(params)  # no dates
    assert None not in params.values()
    return {"name": namespace + name, "params": params, "rest": myargv(words),
            "resolved": [rospy.names.resolve_name(each) for each in names]}

for words in json.loads(sys.argv[1]):
    try:
        print(json.dumps(of(words, sys.argv[2:])))
    except Exception as error:
        print(json.dumps(None))
"""


async def test_each_word_means_what_it_means_to_rospy(under_ours: World) -> None:
    world = under_ours
    debian.require_python("rospy")
    cases = [[word, "foo:="] if word == "foo:=bar" else [word] for word in WORDS]
    done = await world.run(debian.PYTHON, "-c", ROSPY, json.dumps(cases), *NAMES)
    for words, line in zip(cases, done.stdout.splitlines(), strict=True):
        expected = json.loads(line)
        if expected is None:
            with pytest.raises(ValueError, match=re.escape(words[0])):
                world.node("n", argv=words)
            continue
        async with world.node("n", argv=words, rosout=False) as node:
            found = {
                "name": node.name,
                "params": await node.get_param("~", {}),
                "rest": parse_args(words).rest,
                "resolved": [node.resolve_name(each) for each in NAMES],
            }
            assert found == {**expected, "params": nested(expected["params"])}, words
            if found["params"]:
                await node.delete_param("~")


def nested(params: dict[str, Any]) -> dict[str, Any]:
    tree: dict[str, Any] = {}
    for key, value in params.items():
        inner = tree
        *above, last = key.strip("/").split("/")
        for name in above:
            inner = inner.setdefault(name, {})
        inner[last] = value
    return tree
