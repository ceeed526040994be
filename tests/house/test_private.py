"""What begins with an underscore is used in its own package only."""

from __future__ import annotations

import pytest

from .made_up import tree_of
from .private import InsidePython, touched
from .report import report
from .tree import read_tree


def test_nobody_touches_what_is_private_to_others():
    report("uses of private names", touched(read_tree()))


# What is the use of rules that cannot be broken?

OWNER = "class Publication:\n    def __init__(self): self._known = 1"


@pytest.mark.parametrize(
    "use",
    [
        "def f(it): return it._known",
        "def f(it): it._known = 2",
        "def f(it): del it.publication._known[0]",
        "def f(it): return it()._known",
        "def f(it): return getattr(it, '_known', None)",
        "def f(it): setattr(it, '_known', None)",
        "from operator import attrgetter\nf = attrgetter('_known')",
        "from aioros1.topics.publication import _known",
    ],
)
def test_a_use_from_another_package_is_found_however_it_is_written(tmp_path, use):
    modules = tree_of(tmp_path, topics__publication=OWNER, node__rosout=use)
    (found,) = touched(modules, ())
    line = use.count("\n") + 1
    assert found.startswith(f"aioros1/node/rosout.py:{line}: ")
    assert "._known is private to another package" in found
    at_home = tree_of(tmp_path / "home", topics__publication=OWNER, topics__publisher=use)
    assert not list(touched(at_home, ()))


@pytest.mark.parametrize(
    "definition",
    [
        "class A:\n    def _mine(self): ...",
        "class A:\n    @property\n    def _mine(self): ...",
        "class A:\n    _mine: int",
        "class A:\n    _mine = 1",
        "class A:\n    __slots__ = ('_mine',)",
        "class A:\n    def f(self): self._mine: int = 1",
        "class A:\n    def f(self): self.a, self._mine = 1, 2",
        "_mine = 1",
        "try:\n    _mine = 1\nexcept E:\n    pass",
        "def _mine(): ...",
        "class _mine: ...",
    ],
)
def test_what_a_package_defines_it_may_use(tmp_path, definition):
    use = "def f(it): return it._mine"
    assert not list(touched(tree_of(tmp_path, net__a=definition, net__b=use), ()))
    other = tree_of(tmp_path / "other", net__a=definition, topics__b=use)
    assert len(list(touched(other, ()))) == 1


def test_a_local_variable_defines_nothing(tmp_path):
    text = "def f(it):\n    _mine = it._mine\n    return _mine"
    (found,) = touched(tree_of(tmp_path, net__a=text), ())
    assert found.startswith("aioros1/net/a.py:2: it._mine ")


def test_names_in_a_table_are_found_in_what_stands_on_public_names(tmp_path):
    text = "NAMES = ['_fd', '_', 'fd']\ndef f(it): return [getattr(it, name) for name in NAMES]"
    modules = tree_of(tmp_path, testing__leaks=text, idl__factory=text)
    (found,) = touched(modules, ())
    assert found.startswith("aioros1/testing/leaks.py:1: object._fd ")


def test_single_modules_are_by_themselves(tmp_path):
    modules = tree_of(
        tmp_path, time="class Time:\n    _raw = 1", names="def f(time): return time._raw"
    )
    (found,) = touched(modules, ())
    assert found.startswith("aioros1/names.py:1: time._raw ")


def test_what_is_inherited_is_for_parts_of_the_node_only(tmp_path):
    text = "class A(Role):\n    def f(self):\n        super()._close()\n        return self._node"
    modules = tree_of(tmp_path, topics__a=text, contrib__a=text, bond__a=text)
    assert sorted(found.partition(" is ")[0] for found in touched(modules, ())) == [
        "aioros1/bond/a.py:3: super()._close", "aioros1/bond/a.py:4: self._node",
        "aioros1/contrib/a.py:3: super()._close", "aioros1/contrib/a.py:4: self._node",
    ]  # fmt: skip


COMPOSITES = """
class Base(aioros1.Composite):
    async def _open(self):
        self.pub = await self._own(self.node.advertise("a", "b/C"))

class Client(Base, Generic[T]):
    async def _close(self):
        self._check_open()
        await super()._close()
        self._create_task(self._finish())

class Other:
    def f(self):
        return self._own(1)
"""


def test_composites_use_what_they_inherit_for_that(tmp_path):
    modules = tree_of(
        tmp_path, node__composite="class Composite:\n    _own = 1", bond__a=COMPOSITES
    )
    assert sorted(found.partition(" is ")[0] for found in touched(modules, ())) == [
        "aioros1/bond/a.py:10: self._finish", "aioros1/bond/a.py:14: self._own",
    ]  # fmt: skip


def test_public_names_of_others_may_begin_with_an_underscore(tmp_path):
    text = "def f(cls, it): return cls._type, it._md5sum, it._replace(), it.__class__, it.a_, it._"
    assert not list(touched(tree_of(tmp_path, topics__a=text), ()))


def test_modules_that_are_private_to_the_whole_package_are_for_all_of_it(tmp_path):
    text = "from aioros1._version import __version__\nfrom aioros1 import _version"
    assert not list(touched(tree_of(tmp_path, _version="", topics__a=text), ()))


def test_what_is_inside_python_is_named_with_its_module(tmp_path):
    inside = (InsidePython("aioros1.testing.leaks", "_fut_waiter", "there is no other way"),)
    use = "def f(task): return task._fut_waiter"
    assert not list(touched(tree_of(tmp_path, testing__leaks=use), inside))
    (found,) = touched(tree_of(tmp_path / "other", testing__flow=use), inside)
    assert found.startswith("aioros1/testing/flow.py:1: task._fut_waiter ")
    (found,) = touched(tree_of(tmp_path / "idle", testing__leaks=""), inside)
    assert "_fut_waiter is not used any more" in found
