"""``from aioros1.msg.std_msgs import String``."""

from __future__ import annotations

import importlib
import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

import aioros1.action
import aioros1.msg
import aioros1.srv
from aioros1.idl import load_msg, load_srv


def test_messages() -> None:
    from aioros1.msg.std_msgs import Header, String

    assert String is load_msg("std_msgs/String")
    assert Header.__module__ == "aioros1.msg.std_msgs"
    import aioros1.msg.sensor_msgs

    assert aioros1.msg.sensor_msgs.Image is load_msg("sensor_msgs/Image")
    assert aioros1.msg.geometry_msgs.Point is load_msg("geometry_msgs/Point")


def test_services() -> None:
    from aioros1.srv.std_srvs import SetBool, SetBoolRequest, SetBoolResponse

    assert SetBool is load_srv("std_srvs/SetBool")
    assert (SetBoolRequest, SetBoolResponse) == (SetBool.Request, SetBool.Response)
    assert SetBoolRequest.__module__ == "aioros1.srv.std_srvs"


def test_names_are_listed() -> None:
    module = importlib.import_module("aioros1.msg.std_msgs")
    assert {"String", "Header", "Float64MultiArray"} <= set(dir(module))
    assert "SetBool" in dir(importlib.import_module("aioros1.srv.std_srvs"))
    assert {"std_msgs", "geometry_msgs"} <= set(dir(aioros1.msg))
    assert "std_srvs" in dir(aioros1.srv)
    assert "std_srvs" not in dir(aioros1.msg)


def test_everything_is_imported_by_a_star() -> None:
    names: dict[str, object] = {}
    exec("from aioros1.srv.std_srvs import *", names)
    assert names.keys() > {"SetBool", "SetBoolRequest", "SetBoolResponse", "Empty", "Trigger"}
    assert names["SetBool"] is load_srv("std_srvs/SetBool")


def test_a_module_is_reloaded() -> None:
    import aioros1.msg.std_msgs as module

    before = module.String
    assert importlib.reload(module) is module
    assert module.String is before


def test_unknown_names() -> None:
    with pytest.raises(ImportError, match=r"std_msgs has no msg type 'Sting' .*searched: .*String"):
        from aioros1.msg.std_msgs import Sting  # type: ignore[attr-defined]  # noqa: F401
    module = importlib.import_module("aioros1.msg.std_msgs")
    with pytest.raises(AttributeError, match=r"std_msgs has no msg type 'Sting'.*it has: .*String"):
        _ = module.Sting
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("aioros1.msg.no_such_msgs")
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("aioros1.msg.std_srvs")
    with pytest.raises(AttributeError, match="no_such_msgs"):
        _ = aioros1.msg.no_such_msgs
    with pytest.raises(AttributeError):
        _ = aioros1.msg._private
    assert importlib.util.find_spec("aioros1.msg.std_msgs._nothing") is None
    with pytest.raises(ModuleNotFoundError):  # it is there, but no module
        importlib.import_module("aioros1.msg.std_msgs.String")
    srv = importlib.import_module("aioros1.srv.std_srvs")
    for name in ("NoSuchService", "NoSuchRequest"):
        with pytest.raises(AttributeError, match="std_srvs has no srv type"):
            getattr(srv, name)


def test_packages_of_the_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "mine_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "msg" / "Mine.msg").write_text("int32 x\n")
    (package / "action").mkdir()
    (package / "action" / "Go.action").write_text("int32 a\n---\n---\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    mine = importlib.import_module("aioros1.msg.mine_msgs")
    assert mine.Mine(x=1).to_bytes() == b"\1\0\0\0"
    go = importlib.import_module("aioros1.action.mine_msgs").Go
    assert go.Goal is mine.GoGoal
    assert "mine_msgs" in dir(aioros1.action)


def test_the_messages_of_actions_alone_make_a_module(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "acts_only" / "action").mkdir(parents=True)
    (tmp_path / "acts_only" / "action" / "Go.action").write_text("int32 a\n---\n---\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    module = importlib.import_module("aioros1.msg.acts_only")
    assert module.GoGoal(a=1).a == 1
    assert set(dir(module)) == {
        *("GoAction", "GoGoal", "GoResult", "GoFeedback"),
        *("GoActionGoal", "GoActionResult", "GoActionFeedback"),
    }
    assert "acts_only" in dir(aioros1.msg)
    assert "acts_only" not in dir(aioros1.srv)


def test_importing_reads_no_definitions_and_no_heavy_modules() -> None:
    script = (
        "import sys; import aioros1.idl, aioros1.msg, aioros1.srv, aioros1.time;"
        "from aioros1.idl import default_store;"
        "assert '0 types loaded' in repr(default_store());"
        "bad = {'asyncio', 'aiohttp', 'numpy', 'xml', 'yaml'} & set(sys.modules);"
        "assert not bad, bad"
    )
    # Without what aioros1/__init__.py may import itself.
    script = (
        "import sys, types; p = types.ModuleType('aioros1'); "
        f"p.__path__ = [{str(Path(aioros1.msg.__file__).parent.parent)!r}]; "
        "sys.modules['aioros1'] = p; " + script
    )
    subprocess.run([sys.executable, "-c", script], check=True)
