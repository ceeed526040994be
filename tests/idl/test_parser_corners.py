"""Odd definitions are read as genmsg reads them; `tests/interop` asks genmsg itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from aioros1.errors import MessageError, MessageSpecError
from aioros1.idl import MessageStore

from .corners import CORNERS, DIFFERENT, FILES, OTHER


def load(kind: str, text: str) -> str:
    """The MD5 sum of a definition of corner_msgs/Corner."""
    store = MessageStore()
    store.add_text("corner_msgs/Other", OTHER)
    store.add_text("corner_msgs/Corner", text, kind=kind)  # type: ignore[arg-type]
    load = store.load_msg if kind == "msg" else store.load_srv
    return load("corner_msgs/Corner")._md5sum


@pytest.mark.parametrize(
    ("kind", "text", "expected"),
    [pytest.param(kind, text, md5, id=f"{kind}-{name}") for kind, name, text, md5 in CORNERS],
)
def test_reads_what_genmsg_reads(kind: str, text: str, expected: str | None) -> None:
    if expected is None:
        with pytest.raises(MessageError):
            load(kind, text)
    else:
        assert load(kind, text) == expected


@pytest.mark.parametrize(
    ("kind", "text", "reason"),
    [pytest.param(kind, text, why, id=name) for kind, name, text, _, why in DIFFERENT],
)
def test_refuses_what_no_code_could_use(kind: str, text: str, reason: str) -> None:
    with pytest.raises(MessageError, match=reason):
        load(kind, text)


@pytest.mark.parametrize(
    ("content", "expected"), [pytest.param(data, md5, id=name) for name, data, md5 in FILES]
)
def test_reads_files_as_genmsg_reads_them(
    content: bytes, expected: str | None, tmp_path: Path
) -> None:
    path = tmp_path / "corner_msgs" / "msg" / "Corner.msg"
    path.parent.mkdir(parents=True)
    path.write_bytes(content)
    store = MessageStore([tmp_path])
    if expected is None:
        with pytest.raises(MessageSpecError):
            store.load_msg("corner_msgs/Corner")
    else:
        assert store.load_msg("corner_msgs/Corner")._md5sum == expected


@pytest.mark.parametrize(
    ("kind", "text", "line"),
    [
        ("msg", "int32 a\n\n# c\nint32", 4),
        ("msg", "int32 a\nint32 a", 2),
        ("msg", "\n\nuint8 X=256\n", 3),
        ("srv", "int32\n---\n", 1),
        ("srv", "int32 a\n---\nint32 b\nint32", 4),
        ("srv", "int32 a\n---\nint32 b\n---\nint32", 5),
        ("action", "int32 a\n---\nint32 b\n---\n\nint32", 6),
    ],
)
def test_errors_name_the_line(kind, text: str, line: int) -> None:
    with pytest.raises(MessageSpecError) as caught:
        MessageStore().add_text("corner_msgs/Corner", text, kind=kind)
    assert (caught.value.path, caught.value.line) == ("corner_msgs/Corner", line)


def test_errors_name_the_file(tmp_path) -> None:
    path = tmp_path / "my_msgs" / "msg" / "Bad.msg"
    path.parent.mkdir(parents=True)
    path.write_text("int32 a\nint32 1b\n")
    with pytest.raises(MessageSpecError) as caught:
        MessageStore([tmp_path]).load_msg("my_msgs/Bad")
    assert (caught.value.path, caught.value.line) == (str(path), 2)
    assert str(caught.value) == f"{path}:2: '1b' is not a legal field name"
