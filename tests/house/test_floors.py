"""Imports go down one list of floors."""

from __future__ import annotations

import subprocess
import sys

import pytest

from .floors import PURE, circles, impure, in_needless_company, without_aiohttp, wrong_ways
from .made_up import tree_of
from .report import report
from .tree import ROOT, read_tree


def test_imports_go_down():
    report("imports that do not go down", wrong_ways(read_tree()))


def test_nothing_is_imported_in_a_circle():
    report("circles of imports", circles(read_tree()))


def test_definitions_and_protocols_need_no_event_loop():
    report("impure modules", impure(read_tree()))


def test_only_http_servers_import_aiohttp():
    report("imports of aiohttp", in_needless_company(read_tree()))


PROGRAM = """
import sys

before = set(sys.modules)  # what the interpreter loads for itself

def check(name, unwanted):
    if unwanted in sys.modules.keys() - before:
        sys.exit(f"import {name} loads {unwanted}, which it does not need; import that "
                 "in the function that does, or move the code that does")

def load(names, unwanted):
    for name in names:
        __import__(name)
        check(name, unwanted)

load(["aioros1", *PURE], "asyncio")
import aioros1
aioros1.Time
aioros1.load_msg("std_msgs/String")
load(["aioros1.msg.std_msgs", "aioros1.srv.std_srvs"], "asyncio")
load(OTHERS, "aiohttp")
for name in ("Publisher", "Subscriber", "ServiceProvider", "ServiceCaller", "ParamSubscriber"):
    getattr(aioros1, name)
    check(name, "aiohttp")
"""


def test_what_needs_no_http_server_loads_none():
    names = without_aiohttp(read_tree())
    pure = [name for name in names if PURE.fullmatch(name)]
    assert len(pure) > 30
    assert len(names) > 70
    program = PROGRAM.replace("PURE", repr(pure)).replace("OTHERS", repr(names))
    # In the folder of the package, so that it is this one which is loaded.
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


# What is the use of rules that cannot be broken?


def test_modules_are_named_as_python_does(tmp_path):
    (tmp_path / "aioros1" / "msg" / "std_msgs").mkdir(parents=True)
    (tmp_path / "aioros1" / "msg" / "std_msgs" / "__init__.pyi").write_text("import generated")
    (tmp_path / "aioros1" / "__init__.pyi").write_text("import beside")
    (tmp_path / "aioros1" / "idl").mkdir()
    (tmp_path / "aioros1" / "idl" / "__init__.py").write_text("")
    (tmp_path / "aioros1" / "idl" / "alone.pyi").write_text("")
    modules = tree_of(tmp_path, errors="")
    assert set(modules) == {"aioros1", "aioros1.idl", "aioros1.idl.alone", "aioros1.errors"}
    assert [one.target for one in modules["aioros1"].imports] == ["beside"]


@pytest.mark.parametrize(
    "line",
    [
        "import aioros1.topics.publisher",
        "from aioros1.topics import publisher",
        "from aioros1.topics.publisher import Publisher",
        "from ..topics.publisher import Publisher",
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import aioros1.topics.publisher",
        "def f():\n    from aioros1.topics.publisher import Publisher",
        "from importlib import import_module\nimport_module('aioros1.topics.publisher')",
    ],
)
def test_an_import_that_goes_up_is_found_however_it_is_written(tmp_path, line):
    modules = tree_of(tmp_path, net__hosts=line, topics__publisher="")
    (found,) = wrong_ways(modules)
    assert found.startswith(f"aioros1/net/hosts.py:{line.count(chr(10)) + 1}: ")
    assert "imports aioros1.topics.publisher, which stands above net" in found


@pytest.mark.parametrize(
    ("here", "there", "why"),
    [
        ("wire__header", "idl.text", "stands beside wire"),
        ("topics__publisher", "services.caller", "stands beside topics"),
        ("msg__std_msgs", "errors", "msg stands on idl alone"),
        ("node__node", "master.server", "stands above node"),
        ("errors", "wire.header", "stands above errors"),
        ("contrib__threads", "testing.leaks", "stands beside contrib"),
    ],
)
def test_other_wrong_ways_are_found(tmp_path, here, there, why):
    modules = tree_of(tmp_path, **{here: f"import aioros1.{there}"})
    (found,) = wrong_ways(modules)
    assert why in found


def test_the_package_itself_is_for_what_stands_above_the_node(tmp_path):
    text = "import aioros1"
    modules = tree_of(tmp_path, node__node=text, master__server=text, script=text)
    (found,) = wrong_ways(modules)
    assert found.startswith("aioros1/node/node.py:1: imports aioros1, which names everything")


def test_an_entry_without_a_floor_is_found(tmp_path):
    (found,) = wrong_ways(tree_of(tmp_path, helpers="import aioros1.node"))
    assert "'helpers' stands on no floor" in found


def test_what_goes_down_or_stays_at_home_is_in_order(tmp_path):
    modules = tree_of(
        tmp_path,
        names="from aioros1.errors import InvalidNameError",
        msg____init__="import aioros1.idl.modules",
        net__hosts="import aioros1.names, aioros1.wire.header, aioros1.net.allow, socket",
        cli__stubs="import aioros1\nfrom aioros1.testing import FlakyProxy",
        __main__="import aioros1.cli",
    )
    assert not list(wrong_ways(modules))
    assert not list(circles(modules))


def test_a_circle_is_found_and_its_shortest_way_is_told(tmp_path):
    modules = tree_of(
        tmp_path,
        idl__a="import aioros1.idl.b, aioros1.idl.c",
        idl__b="def f():\n    import aioros1.idl.c",
        idl__c="if TYPE_CHECKING:\n    from aioros1.idl.d import D",
        idl__d="import aioros1.idl.a",
        idl__e="import aioros1.idl.a",
    )
    (found,) = circles(modules)
    way = "aioros1.idl.a -> aioros1.idl.c -> aioros1.idl.d -> aioros1.idl.a"
    assert found.startswith(f"aioros1/idl/a.py:1: a circle of imports: {way}, ")
    assert "the shortest among 4 modules" in found


def test_the_package_itself_closes_no_circle(tmp_path):
    modules = tree_of(tmp_path, __init__="import aioros1.script", script="import aioros1")
    assert not list(circles(modules))


def test_modules_that_need_what_they_should_not_are_found(tmp_path):
    modules = tree_of(
        tmp_path,
        wire__header="import asyncio.events",
        time="def f():\n    from asyncio import sleep",
        waiting="import asyncio",
        master__registry="import asyncio",
        master__server="import asyncio",
        net__hosts="from aiohttp import web",
        xmlrpc__server_http="from aiohttp import web",
    )
    assert sorted(found.partition(":")[0] for found in impure(modules)) == [
        "aioros1/master/registry.py", "aioros1/time.py", "aioros1/wire/header.py",
    ]  # fmt: skip
    (found,) = in_needless_company(modules)
    assert found.startswith("aioros1/net/hosts.py:1: imports aiohttp")
