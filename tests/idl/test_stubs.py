"""Stubs of messages: those that come with the library, and those of others."""

from __future__ import annotations

import ast
from pathlib import Path, PurePosixPath
from typing import Any

import pytest

import aioros1
from aioros1.idl import Message, MessageStore
from aioros1.idl.modules import DefinitionLoader, names_of
from aioros1.idl.stubs import HEADER, Stubs, bundled_store, bundled_stubs, write_stubs

ROOT = Path(aioros1.__file__).parents[1]
FILES = bundled_stubs()


def names_in(text: str) -> set[str]:
    """The public names a stub has."""
    names: set[str] = set()
    for node in ast.parse(text).body:
        if isinstance(node, ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.ImportFrom):
            names.update(alias.asname for alias in node.names if alias.asname == alias.name)
    return names


def classes_in(text: str) -> dict[str, ast.ClassDef]:
    return {node.name: node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)}


def attributes_of(node: ast.ClassDef) -> dict[str, str]:
    return {
        each.target.id: ast.unparse(each.annotation)
        for each in node.body
        if isinstance(each, ast.AnnAssign) and isinstance(each.target, ast.Name)
    }


def parameters_of(node: ast.ClassDef) -> list[list[str]]:
    """The names of the parameters of each constructor."""
    return [
        [arg.arg for arg in (*each.args.posonlyargs, *each.args.args, *each.args.kwonlyargs)][1:]
        for each in node.body
        if isinstance(each, ast.FunctionDef)
    ]


def store_of(**texts: str) -> MessageStore:
    store = MessageStore(parent=bundled_store())
    for name, text in texts.items():
        store.add_text(name.replace("__", "/"), text)
    return store


# -- the bundle -----------------------------------------------------------------------


def test_the_stubs_of_the_bundle_are_current() -> None:
    """``python -m aioros1.idl.stubs`` has been run since the definitions were changed."""
    there = {
        PurePosixPath(path.relative_to(ROOT)): path.read_text(encoding="utf-8")
        for kind in ("msg", "srv", "action")
        for path in ROOT.glob(f"aioros1/{kind}/**/*.pyi")
    }
    assert there.keys() == FILES.keys()
    assert [path for path in FILES if there[path] != FILES[path]] == []


@pytest.mark.parametrize("path", FILES, ids=str)
def test_a_stub_has_what_the_module_has(path: PurePosixPath) -> None:
    package = path.parts[2]
    kind: Any = path.parts[1]
    loader = DefinitionLoader(bundled_store(), package, kind)
    assert names_in(FILES[path]) == set(names_of(bundled_store(), package, kind))
    for name, node in classes_in(FILES[path]).items():
        cls = loader.load(name)
        if issubclass(cls, Message):
            slots = list(cls.__slots__)
            constants = [constant.name for constant in cls._constants]
            assert list(attributes_of(node)) == constants + slots
            assert parameters_of(node) == ([slots, slots] if slots else [[]])
        else:
            for attribute, value in attributes_of(node).items():
                assert value == "_ty.TypeAlias"
                assert issubclass(getattr(cls, attribute), Message)


def test_the_library_says_that_it_is_typed() -> None:
    assert (Path(aioros1.__file__).parent / "py.typed").exists()


# -- definitions of others -------------------------------------------------------------


def test_types_of_fields() -> None:
    store = store_of(
        my__Kinds="int8 i\nfloat32 f\nbool b\nstring s\ntime t\nduration d\nHeader h\n"
        "int16[] ia\nfloat64[3] fa\nbool[] ba\nstring[] sa\ntime[] ta\nduration[] da\n"
        "uint8[] ua\nchar[2] ca\nbyte[] ya\nOther o\nOther[] oa\ngeometry_msgs/Point[] pa\n",
        my__Other="int32 x\n",
    )
    files = Stubs(store, "importer").files("my")
    node = classes_in(files[PurePosixPath("my/msg/__init__.pyi")])["Kinds"]
    assert attributes_of(node) == {
        "i": "_b.int",
        "f": "_b.float",
        "b": "_b.bool",
        "s": "_b.str",
        "t": "_t.Time",
        "d": "_t.Duration",
        "h": "_msg_std_msgs.Header",
        "ia": "_t.IntArray",
        "fa": "_t.FloatArray",
        "ba": "_t.BoolList",
        "sa": "_t.TextList",
        "ta": "_t.ItemList[_t.Time]",
        "da": "_t.ItemList[_t.Duration]",
        "ua": "_t.OctetArray",
        "ca": "_t.OctetArray",
        "ya": "_t.IntArray",
        "o": "_my_msg.Other",
        "oa": "_t.ItemList[_my_msg.Other]",
        "pa": "_t.ItemList[_msg_geometry_msgs.Point]",
    }


def test_names_that_python_has_other_uses_for() -> None:
    store = store_of(
        my__Hard='string from=text\nint32 LAST=-1\nfloat32 inf=inf\nstring QUOTED="it\'s" \\n\n'
        "string None\nstring from\nint32 self\nstring[] list\nfloat64 float\ntime Time\n"
    )
    text = Stubs(store, "importer").files("my")[PurePosixPath("my/msg/__init__.pyi")]
    node = classes_in(text)["Hard"]
    assert attributes_of(node) == {
        "LAST": "_ty.Final",
        "inf": "_ty.Final[_b.float]",
        "QUOTED": "_ty.Final[_b.str]",
        "self": "_b.int",
        "list": "_t.TextList",
        "float": "_b.float",
        "Time": "_t.Time",
    }
    assert "LAST: _ty.Final = -1\n" in text
    assert parameters_of(node) == [
        ["self", "list", "float", "Time"],
        ["_None", "_from", "self", "list", "float", "Time"],
    ]


def test_types_of_the_bundle_are_taken_from_there() -> None:
    files = Stubs(bundled_store(), "importer").files("std_srvs")
    text = files[PurePosixPath("std_srvs/srv/__init__.pyi")]
    assert "from aioros1.srv.std_srvs import SetBoolRequest as SetBoolRequest\n" in text
    assert names_in(text) == set(names_of(bundled_store(), "std_srvs", "srv"))
    # But not one by the same name that is defined otherwise.
    store = store_of(std_msgs__String="string text\n", my__Uses="std_msgs/String s\n")
    stubs = Stubs(store, "importer")
    text = stubs.files("std_msgs")[PurePosixPath("std_msgs/msg/__init__.pyi")]
    assert attributes_of(classes_in(text)["String"]) == {"text": "_b.str"}
    assert "from aioros1.msg.std_msgs import Bool as Bool\n" in text
    text = stubs.files("my")[PurePosixPath("my/msg/__init__.pyi")]
    assert attributes_of(classes_in(text)["Uses"]) == {"s": "_std_msgs_msg.String"}


def test_other_packages_are_referred_to() -> None:
    store = store_of(my__Uses="other/Thing thing\nHeader header\n", other__Thing="int32 x\n")
    stubs = Stubs(store, "importer")
    files = stubs.files("my")
    text = files[PurePosixPath("my/msg/__init__.pyi")]
    assert "import other.msg as _other_msg\n" in text
    assert stubs.referred == {"other"}
    assert files.keys() == {
        PurePosixPath("my/msg/__init__.pyi"),
        PurePosixPath("my/__init__.pyi"),
    }
    assert stubs.files("nothing") == {}


def test_services_and_actions() -> None:
    store = store_of(
        my__Do="int32 a\n---\nmy/Thing thing\n", my__Go="---\n---\n", my__Thing="int32 x\n"
    )
    files = Stubs(store, "importer").files("my")
    messages = names_in(files[PurePosixPath("my/msg/__init__.pyi")])
    services = classes_in(files[PurePosixPath("my/srv/__init__.pyi")])
    assert messages == {"Thing", *(f"Go{s}" for s in ("Goal", "Result", "Feedback", "Action"))} | {
        f"GoAction{s}" for s in ("Goal", "Result", "Feedback")
    }
    assert services.keys() == {"Do", "DoRequest", "DoResponse"}
    assert ast.unparse(services["Do"].bases[0]) == "_t.Service[DoRequest, DoResponse]"
    assert attributes_of(services["DoResponse"]) == {"thing": "_my_msg.Thing"}


def test_a_definition_that_cannot_be_read() -> None:
    store = store_of(my__Broken="no_such_msgs/Type x\n")
    with pytest.raises(aioros1.MessageNotFoundError, match="no_such_msgs/Type"):
        Stubs(store, "importer").files("my")


# -- files ----------------------------------------------------------------------------


def test_only_what_has_changed_is_written(tmp_path: Path) -> None:
    store = store_of(my__A="int32 x\n", my__B="---\n")
    files = Stubs(store, "importer").files("my")
    assert set(write_stubs(files, tmp_path)) == {tmp_path / path for path in files}
    assert write_stubs(files, tmp_path) == []
    store.add_text("my/A", "int32 y\n")
    files = Stubs(store, "importer").files("my")
    assert write_stubs(files, tmp_path) == [tmp_path / "my/msg/__init__.pyi"]
    assert "y: _b.int" in (tmp_path / "my/msg/__init__.pyi").read_text()


def test_files_of_others_are_not_replaced(tmp_path: Path) -> None:
    files = Stubs(store_of(my__A="int32 x\n"), "importer").files("my")
    theirs = tmp_path / "my" / "__init__.pyi"
    theirs.parent.mkdir()
    theirs.write_text("x: int\n")
    with pytest.raises(FileExistsError, match=r"my/__init__\.pyi was not made by aioros1"):
        write_stubs(files, tmp_path)
    assert theirs.read_text() == "x: int\n"
    assert not (tmp_path / "my" / "msg").exists()


def test_a_package_with_code_keeps_its_name(tmp_path: Path) -> None:
    (tmp_path / "my").mkdir()
    (tmp_path / "my" / "__init__.py").write_text("x = 1\n")
    files = Stubs(store_of(my__A="int32 x\n"), "importer").files("my")
    assert write_stubs(files, tmp_path) == [tmp_path / "my/msg/__init__.pyi"]
    assert (tmp_path / "my/msg/__init__.pyi").read_text().startswith(HEADER)
