"""``aioros1 stubs``."""

from __future__ import annotations

from pathlib import Path

import pytest

import aioros1.cli


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    for name, text in {
        "my_robot/msg/Wheel.msg": "other_robot/Arm arm\n",
        "my_robot/srv/Spin.srv": "Wheel wheel\n---\n",
        "other_robot/msg/Arm.msg": "uint8[] joints\n",
    }.items():
        path = tmp_path / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path


def run(*words: str) -> object:
    with pytest.raises(SystemExit) as ended:
        aioros1.cli.main(["stubs", *words])
    return ended.value.code


def test_it_writes_what_it_says(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = workspace / "out"
    words = ("my_robot", "other_robot", "--path", str(workspace / "src"), "-o", str(out))
    assert run(*words) == 0
    said = capsys.readouterr()
    files = {path for path in out.rglob("*") if path.is_file()}
    assert {Path(line) for line in said.out.splitlines()} == files
    assert {str(path.relative_to(out)) for path in files} == {
        "my_robot/__init__.pyi",
        "my_robot/msg/__init__.pyi",
        "my_robot/srv/__init__.pyi",
        "other_robot/__init__.pyi",
        "other_robot/msg/__init__.pyi",
    }
    assert said.err == ""
    assert run(*words) == 0
    assert capsys.readouterr().out == ""  # nothing has changed


def test_packages_that_are_needed_too(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("my_robot", "--path", str(workspace / "src"), "-o", str(workspace)) == 0
    said = capsys.readouterr().err
    assert said == "aioros1 stubs: these refer to other_robot: stubs of that are needed, too\n"


def test_a_package_that_is_not_there(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = workspace / "out"
    words = ("my_robot", "no_robot", "--path", str(workspace / "src"), "-o", str(out))
    assert run(*words) == 1
    said = capsys.readouterr().err
    assert said.startswith("aioros1: no definitions of a package 'no_robot'; searched: ")
    assert str(workspace / "src") in said
    assert not out.exists()


def test_a_file_that_is_somebody_elses(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    theirs = workspace / "my_robot" / "msg" / "__init__.pyi"
    theirs.parent.mkdir(parents=True)
    theirs.write_text("x: int\n")
    assert run("my_robot", "--path", str(workspace / "src"), "-o", str(workspace)) == 1
    assert f"{theirs} was not made by aioros1" in capsys.readouterr().err
    assert theirs.read_text() == "x: int\n"


@pytest.mark.parametrize("words", [(), ("std_msgs",), ("-o", "out")])
def test_wrong_usage(words: tuple[str, ...]) -> None:
    assert run(*words) == 2
