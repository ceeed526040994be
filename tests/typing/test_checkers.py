"""The type checkers themselves, with stubs of a package of one's own."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import aioros1
import aioros1.cli

ROOT = Path(aioros1.__file__).parents[1]

DEFINITIONS = {
    "my_robot/msg/Wheel.msg": "float64 MAX_SPEED=2.5\nstring name\nfloat64 speed\n",
    "my_robot/msg/Wheels.msg": "Header header\nWheel[] wheels\nother_robot/Arm arm\n",
    "my_robot/msg/Hard.msg": "string from\nstring[] list\ntime[] Time\nint32 self\nWheel replace\n",
    "my_robot/srv/Spin.srv": "Wheel wheel\n---\ngeometry_msgs/Twist twist\n",
    "my_robot/action/Drive.action": "float64 far\n---\nWheels wheels\n---\n",
    "other_robot/msg/Arm.msg": "uint8[] joints\n",
}

RIGHT = """
from typing import Any, assert_type
import aioros1
from aioros1.msg import std_msgs as ours
from aioros1.msg.geometry_msgs import Twist
from my_robot.msg import DriveGoal, DriveResult, Hard, Wheel, Wheels
from my_robot.srv import Spin, SpinRequest
from other_robot.msg import Arm
from std_msgs.msg import String
from std_srvs.srv import SetBool

wheels = Wheels(wheels=[Wheel(name="left", speed=1)], arm=Arm(joints=b"12"))
assert_type(wheels.wheels, list[Wheel])
assert_type(wheels.header.stamp, aioros1.Time)
assert_type(wheels.arm.joints, bytes)
assert_type(Wheel.MAX_SPEED, float)
fields: dict[str, Any] = {"from": "x"}
assert_type(Hard(**fields).Time, list[aioros1.Time])
assert_type(Hard(self=1).replace, Wheel)
assert_type(DriveResult().wheels, Wheels)
assert_type(DriveGoal(far=1.0).far, float)
assert_type(Spin.Request(wheel=Wheel("right", 1.0)), SpinRequest)
assert_type(String(data="x"), ours.String)
assert_type(SetBool.Response().message, str)

async def main(node: aioros1.Node) -> None:
    assert_type((await node.call("spin", Spin, wheel=Wheel())).twist, Twist)
    assert_type(await node.wait_for_message("wheels", Wheels), Wheels)
"""

WRONG = """
from my_robot.msg import Wheel, Wheels
Wheel(nam="left")
Wheels(wheels=[1])
Wheel().speed = "fast"
"""


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project with definitions, their stubs, and code that uses them."""
    root = tmp_path_factory.mktemp("project")
    for name, text in DEFINITIONS.items():
        path = root / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    packages = ["my_robot", "other_robot", "std_msgs", "std_srvs"]
    words = ["stubs", *packages, "--path", str(root / "src"), "-o", str(root / "typings")]
    with pytest.raises(SystemExit) as ended:
        aioros1.cli.main(words)
    assert ended.value.code == 0
    (root / "right.py").write_text(RIGHT)
    (root / "wrong.py").write_text(WRONG)
    paths = {"extraPaths": ["typings", str(ROOT)], "typeCheckingMode": "strict"}
    (root / "pyrightconfig.json").write_text(json.dumps(paths))
    return root


def check(project: Path, module: str, *words: str) -> subprocess.CompletedProcess[str]:
    if importlib.util.find_spec(module) is None:
        pytest.skip(f"{module} is not installed")
    environ = os.environ | {"MYPYPATH": os.pathsep.join(["typings", str(ROOT)])}
    return subprocess.run(
        [sys.executable, "-m", module, *words],
        cwd=project, env=environ, capture_output=True, text=True,
    )  # fmt: skip


def test_mypy(project: Path) -> None:
    right = check(project, "mypy", "--strict", "right.py")
    assert right.stdout == "Success: no issues found in 1 source file\n"
    wrong = check(project, "mypy", "--strict", "wrong.py")
    lines = [line.split(":")[1] for line in wrong.stdout.splitlines() if " error: " in line]
    assert lines == ["3", "4", "5"]


def test_pyright(project: Path) -> None:
    words = ["--outputjson", "--pythonpath", sys.executable]
    answer = json.loads(check(project, "pyright", *words, "right.py", "wrong.py").stdout)
    found = [
        (Path(each["file"]).name, each["range"]["start"]["line"] + 1)
        for each in answer["generalDiagnostics"]
    ]
    assert found == [("wrong.py", 3), ("wrong.py", 4), ("wrong.py", 5)]
