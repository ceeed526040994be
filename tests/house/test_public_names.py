"""Public names, their paths and the reference agree; what stands above the node uses only these.

That ``__init__.pyi`` has the same names as ``__all__`` is tested in ``test_embedding.py``.
"""

from __future__ import annotations

import pickle
import sys
import typing
from pathlib import Path
from types import ModuleType

import pytest

import aioros1

from .made_up import tree_of
from .public import (
    Public,
    documented,
    private_imports,
    private_in_signatures,
    public_modules,
    public_names,
    speechless,
    undescribed,
    unlike_the_reference,
    wrong_paths,
)
from .report import report
from .tree import read_tree


@pytest.fixture(scope="module")
def names() -> dict[str, Public]:
    return public_names(public_modules())


def test_public_names_show_the_path_they_are_imported_from(names):
    report("wrong paths", wrong_paths(names))


def test_the_reference_describes_what_is_public_and_nothing_else(names):
    report("differences from the reference", unlike_the_reference(names, list(documented())))


def test_whatever_is_public_is_described(names):
    report("members without a description", undescribed(names))


def test_instances_tell_what_they_are(names):
    report("classes without a repr", speechless(names))


def test_signatures_name_public_classes(names):
    report("private classes in public signatures", set(private_in_signatures(names)))


def test_what_stands_above_the_node_uses_public_names():
    usable = {module: set(sys.modules[module].__all__) for module in public_modules()}
    report("imports of private names", private_imports(read_tree(), usable))


# What @public does


def test_public_classes_are_pickled_by_their_public_path():
    error = aioros1.ClosedError("it is closed")
    assert b"aioros1.errors" not in pickle.dumps(error)
    assert str(pickle.loads(pickle.dumps(error))) == "it is closed"


def test_public_classes_keep_what_annotations_mean():
    from aioros1.testing import FlakyProxy, NodeProxies

    assert typing.get_type_hints(NodeProxies) == {"slave_api": FlakyProxy, "tcpros": FlakyProxy}


# What is the use of rules that cannot be broken?

MADE_UP = '''
from dataclasses import dataclass

class Base:
    """A base."""
    def inherited(self):
        """Described here."""

class Mute(Base):
    """It has ``named`` in its docstring."""
    described = 1
    """A class attribute."""
    bare = 1
    _hidden = 1

    def __init__(self, helper: Base):
        self.told: int = 1
        """An attribute."""
        self.named = 2
        self.untold = 3
        self._hidden = 4

    def inherited(self):
        return 1

    def method(self) -> "list[Base]":
        return []

    @property
    def prop(self):
        return 1

    @classmethod
    def make(cls) -> int: ...

@dataclass
class Data:
    field: int
    """A field."""
    other: int

def function(): ...

constant = 1
'''


@pytest.fixture
def made_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> typing.Any:
    """A public module of an application ``made_up``."""
    module = ModuleType("made_up")
    module.__file__ = str(tmp_path / "made_up.py")
    Path(module.__file__).write_text(MADE_UP)
    monkeypatch.setitem(sys.modules, "made_up", module)
    exec(compile(MADE_UP, module.__file__, "exec"), vars(module))
    module.__all__ = ["Mute", "Data", "function", "constant"]
    return module


def test_what_is_not_described_is_found(made_up):
    found = [line.partition(" is not")[0] for line in undescribed(public_names(("made_up",)))]
    assert sorted(found) == [
        "made_up.py:13: made_up.Mute.bare",
        "made_up.py:20: made_up.Mute.untold",
        "made_up.py:26: made_up.Mute.method",
        "made_up.py:30: made_up.Mute.prop",
        "made_up.py:34: made_up.Mute.make",
        "made_up.py:37: made_up.Data: has no docstring",
        "made_up.py:40: made_up.Data.other",
        "made_up.py:42: made_up.function: has no docstring",
    ]


def test_classes_without_a_repr_are_found(made_up):
    (found,) = speechless(public_names(("made_up",)))
    assert found.startswith("made_up.py:9: made_up.Mute: its repr tells only an address")


def test_another_path_is_found(made_up):
    made_up.Data.__module__ = "made_up.files"
    made_up.function.__module__ = "made_up.files"
    found = list(wrong_paths(public_names(("made_up",))))
    assert [line.partition("; ")[2] for line in found] == ["mark it with @public('made_up')"] * 2
    assert all("its __module__ is made_up.files" in line for line in found)


def test_what_only_the_code_or_only_the_reference_takes_for_public_is_found(made_up, tmp_path):
    (tmp_path / "page.md").write_text(
        "\n".join([
            "```{eval-rst}", ".. autoclass:: made_up.Mute", ".. autofunction:: made_up.gone",
            "   :no-index:", ".. py:function:: made_up.function", ".. autoclass:: made_up.Mute",
            "```", "",
        ])
    )  # fmt: skip
    described = list(documented(tmp_path))
    found = sorted(unlike_the_reference(public_names(("made_up",)), described))
    assert [line.partition("; ")[0] for line in found] == [
        "docs/api/page.md:3: made_up.gone is not public",
        "docs/api/page.md:6: made_up.Mute is described in docs/api/page.md:2 already",
        "made_up.constant: is not in the reference",
        "made_up.py:37: made_up.Data: is not in the reference",
    ]


def test_a_whole_module_is_described_but_for_what_is_left_out(made_up, tmp_path):
    (tmp_path / "page.md").write_text(
        ".. automodule:: made_up\n   :members:\n   :exclude-members: Data, constant\n"
        ".. py:module:: aioros1.msg\n"
    )
    described = [path for path, _ in documented(tmp_path)]
    assert described == ["made_up.Mute", "made_up.function"]


def test_private_classes_in_signatures_are_found(made_up):
    made_up.Base.__module__ = "aioros1"
    (found,) = private_in_signatures(public_names(("made_up",)))
    assert found.startswith("made_up.py:26: made_up.Mute has Base in a signature")


@pytest.mark.parametrize(
    "line",
    [
        "from aioros1.net.hosts import resolve",
        "import aioros1.node",
        "from aioros1 import Hidden",
        "import aioros1\naioros1.Hidden",
        "def f():\n    from aioros1.errors import ClosedError",
    ],
)
def test_an_import_of_what_is_not_public_is_found(tmp_path, line):
    usable = {"aioros1": {"Node"}, "aioros1.testing": {"FlakyProxy"}}
    modules = tree_of(tmp_path, net__hosts="", errors="", node="", contrib__threads=line, log=line)
    (found,) = private_imports(modules, usable)
    assert found.startswith(f"aioros1/contrib/threads.py:{line.count(chr(10)) + 1}: ")


def test_imports_of_public_names_are_in_order(tmp_path):
    usable = {"aioros1": {"Node"}, "aioros1.testing": {"FlakyProxy"}}
    modules = tree_of(
        tmp_path,
        contrib__threads="import aioros1\nfrom aioros1 import Node\naioros1.Node, aioros1.testing",
        contrib__other="from aioros1._public import public\nimport aioros1.contrib.threads",
        cli__topic="from aioros1.testing import FlakyProxy\nimport aioros1.msg.std_msgs",
        _public="",
    )
    assert not list(private_imports(modules, usable))
