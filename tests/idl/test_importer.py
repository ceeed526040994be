"""``from std_msgs.msg import String`` where there is no ROS, and where there is one."""

from __future__ import annotations

import importlib
import importlib.util
import pickle
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import aioros1
import aioros1.msg
from aioros1 import MessageStore, install_importer, uninstall_importer
from aioros1.idl.paths import bundle

ROOT = Path(aioros1.__file__).parents[1]


@pytest.fixture(autouse=True)
def no_ros(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No installed ROS is importable, and nothing stays installed or imported."""
    places = [place for place in sys.path if not (Path(place or ".") / "std_msgs").exists()]
    monkeypatch.setattr(sys, "path", places)
    before, finders = set(sys.modules), list(sys.meta_path)
    yield
    uninstall_importer()
    assert sys.meta_path == finders
    for name in set(sys.modules) - before:
        if not name.startswith("aioros1"):
            del sys.modules[name]


def write(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)


def test_code_for_rospy_finds_the_same_classes() -> None:
    install_importer()
    import std_msgs.msg  # type: ignore[import-not-found]
    from actionlib_tutorials.msg import (  # type: ignore[import-not-found]
        FibonacciAction,
        FibonacciGoal,
    )
    from std_msgs.msg import String
    from std_srvs.srv import (  # type: ignore[import-not-found]
        SetBool,
        SetBoolRequest,
        SetBoolResponse,
    )

    from aioros1.msg import actionlib_tutorials as actions
    from aioros1.msg import std_msgs as ours
    from aioros1.srv import std_srvs as services

    assert String is std_msgs.msg.String is ours.String
    assert String.__module__ == "aioros1.msg.std_msgs"
    assert SetBool is services.SetBool
    assert (SetBool._request_class, SetBool._response_class) == (SetBoolRequest, SetBoolResponse)
    assert SetBoolRequest is services.SetBoolRequest
    assert (FibonacciAction, FibonacciGoal) == (actions.FibonacciAction, actions.FibonacciGoal)


def test_a_package_has_its_modules() -> None:
    install_importer()
    import std_msgs
    import std_srvs

    assert std_msgs.msg.String(data="x").data == "x"
    assert std_srvs.srv.SetBool._type == "std_srvs/SetBool"
    assert not hasattr(std_msgs, "srv")
    with pytest.raises(AttributeError, match="there are only message definitions of std_msgs"):
        _ = std_msgs.node
    with pytest.raises(ModuleNotFoundError, match=r"'std_msgs\.srv'"):
        importlib.import_module("std_msgs.srv")


def test_the_module_of_one_type() -> None:
    install_importer()
    from geometry_msgs.msg._Twist import Twist  # type: ignore[import-not-found]
    from std_srvs.srv._SetBool import SetBool, SetBoolRequest

    assert Twist is aioros1.load_msg("geometry_msgs/Twist")
    assert SetBool.Request is SetBoolRequest
    with pytest.raises(ImportError, match=r"_Twist has no 'Pose'; it has: Twist"):
        from geometry_msgs.msg._Twist import Pose  # noqa: F401
    assert importlib.util.find_spec("geometry_msgs.msg._NoSuchType") is None


def test_names_are_listed_and_imported_by_a_star() -> None:
    install_importer()
    names: dict[str, object] = {}
    exec("from std_srvs.srv import *", names)
    module = importlib.import_module("std_srvs.srv")
    assert set(dir(module)) == set(module.__all__) == names.keys() - {"__builtins__"}
    assert {"SetBool", "SetBoolRequest", "SetBoolResponse"} <= names.keys()
    assert "FibonacciGoal" in dir(importlib.import_module("actionlib_tutorials.msg"))


def test_nothing_else_is_claimed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path, {"plain/readme": "a directory"})
    monkeypatch.syspath_prepend(str(tmp_path))
    install_importer()
    for name in ("nosuch", "nosuch.msg", "plain.msg", "nosuch.srv.Type", "genpy", "rospy"):
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module(name)
    assert importlib.util.find_spec("numpy").loader.name == "numpy"  # type: ignore[union-attr]
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("email.msg")


def test_an_unknown_type_says_where_it_was_searched(tmp_path: Path) -> None:
    write(tmp_path, {"robot_msgs/msg/Wheel.msg": "float64 speed\n"})
    install_importer(store=MessageStore([tmp_path], parent=None))
    with pytest.raises(ImportError) as caught:
        from robot_msgs.msg import Weel  # type: ignore[import-not-found]  # noqa: F401
    text = str(caught.value)
    assert "robot_msgs has no msg type 'Weel'" in text
    assert f"searched: {tmp_path}" in text
    assert "it has: Wheel" in text
    assert caught.value.name == "robot_msgs.msg"


def test_a_store_of_ones_own(tmp_path: Path) -> None:
    store = MessageStore()
    store.add_text("my_robot/Wheel", "float64 speed\n")
    install_importer(store=store)
    from my_robot.msg import Wheel  # type: ignore[import-not-found]

    assert Wheel is store.load_msg("my_robot/Wheel")
    assert pickle.loads(pickle.dumps(Wheel(speed=1.5))) == Wheel(speed=1.5)
    other = MessageStore()
    other.add_text("my_robot/Wheel", "float32 speed\n")
    install_importer(store=other)
    from my_robot.msg import Wheel as Other

    assert Other is other.load_msg("my_robot/Wheel")


def test_installing_twice_is_installing_once() -> None:
    install_importer()
    finders = list(sys.meta_path)
    module = importlib.import_module("std_msgs.msg")
    install_importer()
    assert sys.meta_path == finders
    assert importlib.import_module("std_msgs.msg") is module
    uninstall_importer()
    for name in ("std_msgs", "std_msgs.msg"):
        assert name not in sys.modules
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module(name)
    uninstall_importer()


def test_modules_are_found_reloaded_and_pickled() -> None:
    install_importer()
    spec = importlib.util.find_spec("std_msgs.msg")
    assert spec is not None
    assert spec.origin == "definitions of std_msgs"
    module = importlib.import_module("std_msgs.msg")
    string = module.String
    assert importlib.reload(module) is module
    assert importlib.reload(sys.modules["std_msgs"]).msg is module
    assert module.String is string
    assert pickle.loads(pickle.dumps(string)) is string
    assert pickle.loads(pickle.dumps(string(data="x"))) == string(data="x")


def test_an_installed_ros_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files = {
        "std_msgs/msg/__init__.py": "String = 'genpy'\n",
        "std_msgs/__init__.py": "",
    }
    write(tmp_path, files)
    monkeypatch.syspath_prepend(str(tmp_path))
    install_importer()
    assert importlib.import_module("std_msgs.msg").String == "genpy"
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("std_msgs.srv")
    for name in ("std_msgs.msg", "std_msgs"):
        del sys.modules[name]
    install_importer(shadow=True)
    assert importlib.import_module("std_msgs.msg").String is aioros1.load_msg("std_msgs/String")
    assert importlib.import_module("std_msgs").__file__ == str(tmp_path / "std_msgs/__init__.py")


def test_a_package_with_code_gets_its_messages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {
        "my_pkg/__init__.py": "answer = 42\n",
        "my_pkg/tools.py": "from my_pkg.msg import Mine\n",
        "my_pkg/msg/Mine.msg": "int32 x\n",
    }
    write(tmp_path, files)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    install_importer()
    import my_pkg  # type: ignore[import-not-found]
    import my_pkg.tools  # type: ignore[import-not-found]

    assert my_pkg.answer == 42
    assert my_pkg.tools.Mine is my_pkg.msg.Mine is aioros1.load_msg("my_pkg/Mine")
    uninstall_importer()
    assert not hasattr(my_pkg, "msg")
    assert my_pkg.answer == 42


def test_directories_of_a_workspace_are_no_packages_with_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {
        "src/my_robot/msg/Wheel.msg": "float64 speed\n",
        "src/my_robot/tool.py": "x = 1\n",
    }
    write(tmp_path, files)
    monkeypatch.syspath_prepend(str(tmp_path / "src"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    install_importer()
    assert importlib.import_module("my_robot.msg").Wheel(speed=1).speed == 1
    assert importlib.import_module("my_robot.tool").x == 1


def test_it_works_in_a_script_and_reads_nothing_before_it_is_asked() -> None:
    script = """
import sys
import aioros1
import aioros1.msg
from aioros1.idl.store import default_store
aioros1.install_importer()
store = default_store()
assert store._search._fixed is None, "something was searched"
import json, email.message
assert store._search._fixed is None, "something was searched"
assert not {"asyncio", "aiohttp"} & set(sys.modules)
from std_msgs.msg import String
print(String(data="hi").data)
"""
    done = subprocess.run(
        [sys.executable, "-S", "-c", f"import sys; sys.path.append({str(ROOT)!r})\n{script}"],
        check=True, capture_output=True, text=True,
    )  # fmt: skip
    assert done.stdout == "hi\n"


@pytest.mark.parametrize("package", MessageStore([bundle()], parent=None).packages())
def test_every_package_of_the_bundle(package: str) -> None:
    install_importer(store=MessageStore([bundle()], parent=None))
    for kind in ("msg", "srv"):
        if importlib.util.find_spec(f"{package}.{kind}") is None:
            continue
        module = importlib.import_module(f"{package}.{kind}")
        assert dir(module)
        for name in dir(module):
            assert getattr(module, name).__name__ == name
