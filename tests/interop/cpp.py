"""The C++ peer, compiled once and kept for as long as its source stays the same."""

from __future__ import annotations

import hashlib
import os
import subprocess
from pathlib import Path

from . import debian

__all__ = ["compile_peer"]

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


def compile_peer(folder: Path) -> Path:
    """Return the program, from ``folder`` when it was built there before."""
    debian.require("g++", *HEADERS)
    options = ["-O1", "-std=c++17", *(f"-l{name}" for name in LIBRARIES)]
    key = hashlib.sha256(SOURCE.read_bytes() + " ".join(options).encode()).hexdigest()[:16]
    program = folder / f"peer-{key}"
    if not program.exists():
        folder.mkdir(parents=True, exist_ok=True)
        # Several test processes may compile at the same time; the last one wins whole.
        fresh = program.with_suffix(f".{os.getpid()}")
        command = ["g++", str(SOURCE), "-o", str(fresh), *options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}\n{done.stderr}")
        fresh.replace(program)
    return program
