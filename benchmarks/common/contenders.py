"""Who is compared: this library on two event loops, and the peers that are installed."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path

__all__ = ["CLIENTS", "KEYS", "MASTERS", "Contender", "find"]

PEERS = Path(__file__).resolve().parent.parent / "peers"
DEBIAN_PYTHON = "/usr/bin/python3"
LIBRARIES = [
    *("-lroscpp", "-lrosconsole", "-lroscpp_serialization", "-lxmlrpcpp", "-lrostime"),
    *("-lcpp_common", "-lboost_system", "-lboost_thread", "-lpthread"),
]


class Missing(Exception):
    """Why a contender cannot run here."""


@dataclass(frozen=True)
class Contender:
    """A program that takes part; its command goes before, and ``words`` behind the mode."""

    key: str
    label: str
    command: tuple[str, ...]
    words: tuple[str, ...] = ()

    @property
    def ours(self) -> bool:
        return self.key.startswith("aioros1")

    def arguments(self, mode: str, **options: float | str) -> list[str]:
        words = [f"{name}={value}" for name, value in options.items()]
        return [*self.command, mode, *words, *self.words]


def asyncio_client(scratch: Path) -> Contender:
    return Contender("aioros1", "aioros1", (sys.executable, str(PEERS / "aioros1_peer.py")))


def uvloop_client(scratch: Path) -> Contender:
    need_module(sys.executable, "uvloop", "uvloop")
    command = (sys.executable, str(PEERS / "aioros1_peer.py"))
    return Contender("aioros1-uvloop", "aioros1, uvloop", command, ("uvloop=1",))


def rospy_client(scratch: Path) -> Contender:
    packages = "python3-rospy, python3-sensor-msgs, python3-std-srvs"
    need_module(DEBIAN_PYTHON, "rospy, sensor_msgs.msg, std_srvs.srv", f"rospy ({packages})")
    return Contender("rospy", "rospy, synchronous", (DEBIAN_PYTHON, str(PEERS / "rospy_peer.py")))


def roscpp_client(scratch: Path) -> Contender:
    headers = ["ros/ros.h", "std_msgs/String.h", "std_srvs/SetBool.h"]
    headers += ["sensor_msgs/Image.h", "geometry_msgs/TransformStamped.h"]
    compiler = shutil.which("g++")
    if not compiler or not all(Path("/usr/include", header).exists() for header in headers):
        packages = "g++, libroscpp-dev, lib{std,sensor,geometry}-msgs-dev, libstd-srvs-dev"
        raise Missing(f"roscpp is not installed ({packages})")
    binary = build(scratch, [compiler, "-std=c++17"], "roscpp_peer.cpp", LIBRARIES)
    return Contender("roscpp", "roscpp, unbounded", (binary,))


def tcp_client(scratch: Path) -> Contender:
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler:
        raise Missing("no C compiler for the bare socket (gcc)")
    return Contender("tcp", "C over TCP", (build(scratch, [compiler], "tcp_peer.c", []),))


def asyncio_master(scratch: Path) -> Contender:
    return Contender("aioros1", "aioros1", (sys.executable, str(PEERS / "aioros1_master.py")))


def uvloop_master(scratch: Path) -> Contender:
    need_module(sys.executable, "uvloop", "uvloop")
    command = (sys.executable, str(PEERS / "aioros1_master.py"))
    return Contender("aioros1-uvloop", "aioros1, uvloop", command, ("uvloop=1",))


def rosmaster(scratch: Path) -> Contender:
    script = Path("/usr/bin/rosmaster")
    if not script.exists():
        raise Missing("rosmaster is not installed (python3-rosmaster)")
    return Contender("rosmaster", "rosmaster", (DEBIAN_PYTHON, str(script), "--core", "-p"))


Find = Callable[[Path], Contender]
CLIENTS: dict[str, Find] = {
    "aioros1": asyncio_client,
    "aioros1-uvloop": uvloop_client,
    "rospy": rospy_client,
    "roscpp": roscpp_client,
    "tcp": tcp_client,
}
MASTERS: dict[str, Find] = {
    "aioros1": asyncio_master,
    "aioros1-uvloop": uvloop_master,
    "rosmaster": rosmaster,
}
KEYS = tuple({**CLIENTS, **MASTERS})
"""What ``--only`` can name."""


def find(
    known: dict[str, Find], wanted: Collection[str], scratch: Path
) -> tuple[list[Contender], list[str]]:
    """Those of ``wanted`` that can run here, and what to say of the others."""
    found, missing = [], []
    for key in known:
        if key in wanted:
            try:
                found.append(known[key](scratch))
            except Missing as error:
                missing.append(f"without {key}: {error}")
    return found, missing


def need_module(python: str, modules: str, name: str) -> None:
    command = [python, "-c", f"import {modules}"]
    if not Path(python).exists() or subprocess.run(command, capture_output=True).returncode:
        raise Missing(f"{name} is not installed")


def build(scratch: Path, compiler: list[str], source: str, libraries: list[str]) -> str:
    """The program made of a source; compiled once, however many suites ask for it."""
    binary = scratch / Path(source).stem
    if not binary.exists():
        print(f"compiling {source}", file=sys.stderr)
        command = [*compiler, "-O2", str(PEERS / source), "-o", str(binary), *libraries]
        subprocess.run(command, check=True)
    return str(binary)
