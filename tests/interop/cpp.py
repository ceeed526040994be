"""The C++ peer, compiled once and kept for as long as its source stays the same."""

from __future__ import annotations

import fcntl
import hashlib
import subprocess
from pathlib import Path

import pytest

from . import debian

__all__ = ["compile_peer", "shared_folder"]

SOURCE = Path(__file__).parent / "peers" / "peer.cpp"
HEADERS = (
    "/usr/include/ros/ros.h",
    "/usr/include/std_msgs/String.h",
    "/usr/include/std_srvs/SetBool.h",
    "/usr/include/sensor_msgs/Image.h",
    "/usr/include/geometry_msgs/Pose.h",
    "/usr/include/nav_msgs/Path.h",
)
LIBRARIES = (
    "roscpp",
    "rosconsole",
    "roscpp_serialization",
    "xmlrpcpp",
    "rostime",
    "cpp_common",
    "boost_system",
    "boost_thread",
    "pthread",
)


PATIENCE = 300.0
"""Seconds that the compiler may take."""


def shared_folder(config: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that all processes of this test run share, and the next run if possible."""
    cache = getattr(config, "cache", None)
    if cache is not None:
        return Path(cache.mkdir("aioros1-interop"))
    folder = tmp_path_factory.getbasetemp()
    # Each process of pytest-xdist has a folder of its own in that of the test run.
    return (folder.parent if hasattr(config, "workerinput") else folder) / "aioros1-interop"


def compile_peer(folder: Path) -> Path:
    """Return the program, from ``folder`` when it was built there before.

    Of several processes one compiles, and the others wait for it.
    """
    debian.require("g++", *HEADERS)
    options = ["-O1", "-std=c++17", *(f"-l{name}" for name in LIBRARIES)]
    key = hashlib.sha256(SOURCE.read_bytes() + " ".join(options).encode()).hexdigest()[:16]
    program = folder / f"peer-{key}"
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not program.exists():
            fresh = program.with_suffix(".new")
            command = ["g++", str(SOURCE), "-o", str(fresh), *options]
            done = subprocess.run(
                command, capture_output=True, text=True, check=False, timeout=PATIENCE
            )
            if done.returncode != 0:
                raise RuntimeError(f"{' '.join(command)}\n{done.stderr}")
            fresh.replace(program)
    return program
