"""Our messages in the hands of genpy, rosbag, rospy and rostopic, and theirs in ours.

All of it in one process each.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import aioros1

from . import debian
from .test_genpy_types import PACKAGES

PEERS = Path(__file__).parent / "peers"
ROOT = str(Path(aioros1.__file__).parent.parent)
MODULES = ("genpy", "rospy", "rosbag", "rostopic", "geometry_msgs", "sensor_msgs")


@pytest.mark.parametrize(
    "check",
    [
        "classes",
        "their_messages",
        "our_messages",
        "texts",
        "rosbag",
        "printing",
        "publishing",
        "filling",
    ],
)
def test_in_the_python_of_debian(check: str, tmp_path: Path) -> None:
    """One of the checks of ``peers/beside_genpy.py``."""
    debian.require_python(*MODULES)
    run([debian.PYTHON, str(PEERS / "beside_genpy.py"), check, *PACKAGES], ROOT, tmp_path)


def test_at_our_node(tmp_path: Path) -> None:
    """genpy's classes and messages wherever a node takes ours."""
    debian.require_python("genpy", "genmsg", "geometry_msgs", "std_srvs")
    # Debian's modules come last: what is installed for this Python is found first.
    path = os.pathsep.join([ROOT, *filter(None, sys.path), str(debian.PYTHON_PACKAGES)])
    run([sys.executable, str(PEERS / "genpy_at_our_node.py")], path, tmp_path)


def run(command: list[str], path: str, folder: Path) -> None:
    env = debian.environment("http://localhost:1", folder)
    env["PYTHONPATH"] = path
    done = subprocess.run(command, env=env, cwd=folder, capture_output=True, text=True, check=False)
    assert done.stdout == "done\n", done.stdout[-2000:] + done.stderr[-5000:]
