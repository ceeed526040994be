"""Who is compared: this library on two event loops, and the peers that are installed."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import aioros1
from common import ROOT
from common.versions import debian_package, distribution, output

__all__ = ["PEERS", "Contender", "Find", "Missing", "Places"]

PEERS = Path(__file__).resolve().parent.parent / "peers"
VERSION = aioros1.__version__
DEBIAN_PYTHON = "/usr/bin/python3"
LIBRARIES = [
    *("-lroscpp", "-lrosconsole", "-lroscpp_serialization", "-lxmlrpcpp", "-lrostime"),
    *("-lcpp_common", "-lboost_system", "-lboost_thread", "-lpthread"),
]


class Missing(Exception):
    """Why a contender cannot run here."""


@dataclass(frozen=True)
class Places:
    """Where what is needed is found, and where to put what is made of it."""

    scratch: Path
    node_modules: Path | None = None
    cros: Path | None = None


@dataclass(frozen=True)
class Contender:
    """A program that takes part; its command goes before, and ``words`` behind the mode.

    ``share`` is the part of the messages that is enough for it: the slow ones would take too
    long otherwise, and the quick ones would have nothing to do.
    """

    key: str
    label: str
    command: tuple[str, ...]
    words: tuple[str, ...] = ()
    version: str = ""
    share: float = 1.0

    @property
    def ours(self) -> bool:
        return self.key.startswith("aioros1")

    def count(self, number: int) -> int:
        """Its part of so many messages, but not of so few that they only show that it works."""
        return max(round(number * self.share), min(number, 100))

    def arguments(self, mode: str, **options: float | str) -> list[str]:
        words = [f"{name}={value}" for name, value in options.items()]
        return [*self.command, mode, *words, *self.words]


Find = Callable[[Places], Contender]


def our(program: str) -> tuple[str, str]:
    return sys.executable, str(PEERS / program)


def with_uvloop(program: str) -> Contender:
    need_module(sys.executable, "uvloop", "uvloop")
    words, version = ("uvloop=1",), f"{VERSION}, uvloop {distribution('uvloop')}"
    return Contender("aioros1-uvloop", "aioros1, uvloop", our(program), words, version)


def asyncio_client(places: Places) -> Contender:
    return Contender("aioros1", "aioros1", our("aioros1_peer.py"), version=VERSION)


def uvloop_client(places: Places) -> Contender:
    return with_uvloop("aioros1_peer.py")


def rospy_client(places: Places) -> Contender:
    packages = "python3-rospy, python3-sensor-msgs, python3-std-srvs"
    need_module(DEBIAN_PYTHON, "rospy, sensor_msgs.msg, std_srvs.srv", f"rospy ({packages})")
    command = (DEBIAN_PYTHON, str(PEERS / "rospy_peer.py"))
    version = f"{debian_package('python3-rospy')}, {output(DEBIAN_PYTHON, '--version')}"
    return Contender("rospy", "rospy, synchronous", command, version=version)


def roscpp_client(places: Places) -> Contender:
    headers = ["ros/ros.h", "std_msgs/String.h", "std_srvs/SetBool.h"]
    headers += ["sensor_msgs/Image.h", "geometry_msgs/TransformStamped.h"]
    compiler = shutil.which("g++")
    if not compiler or not all(Path("/usr/include", header).exists() for header in headers):
        packages = "g++, libroscpp-dev, lib{std,sensor,geometry}-msgs-dev, libstd-srvs-dev"
        raise Missing(f"roscpp is not installed ({packages})")
    binary = build(places.scratch, [compiler, "-std=c++17"], "roscpp_peer.cpp", LIBRARIES)
    version = f"{debian_package('libroscpp-dev')}, g++ {output(compiler, '-dumpfullversion')}"
    return Contender("roscpp", "roscpp, unbounded", (binary,), version=version)


def tcp_client(places: Places) -> Contender:
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler:
        raise Missing("no C compiler for the bare socket (gcc)")
    binary = build(places.scratch, [compiler], "tcp_peer.c", [])
    version = f"{Path(compiler).name} {output(compiler, '-dumpfullversion')}"
    return Contender("tcp", "C over TCP", (binary,), version=version)


def cros_client(places: Places) -> Contender:
    if not places.cros:
        raise Missing("no --cros DIR with a built cROS")
    library = next(places.cros.glob("**/libcros.a"), None)
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler or not library or not (places.cros / "include" / "cros.h").exists():
        raise Missing(f"no C compiler, or no include/cros.h and libcros.a in {places.cros}")
    command = [compiler, f"-I{places.cros / 'include'}"]
    binary = build(places.scratch, command, "cros_peer.c", [str(library), "-lm"])
    words = (f"messages={cros_messages(places.scratch)}",)
    return Contender("cros", "cROS", (binary,), words, version=output(compiler, "-dumpfullversion"))


def cros_messages(scratch: Path) -> Path:
    """The definitions as cROS looks for them: one folder for each package, and no more."""
    folder = scratch / "cros_messages"
    for package in ("std_msgs", "std_srvs", "sensor_msgs", "geometry_msgs", "rosgraph_msgs"):
        (folder / package).mkdir(parents=True)
        for source in (ROOT / "share" / "msg" / package).glob("*/*.*"):
            shutil.copy(source, folder / package)
    return folder


def asyncio_master(places: Places) -> Contender:
    return Contender("aioros1", "aioros1", our("aioros1_master.py"), version=VERSION)


def uvloop_master(places: Places) -> Contender:
    return with_uvloop("aioros1_master.py")


def rosmaster(places: Places) -> Contender:
    script = Path("/usr/bin/rosmaster")
    if not script.exists():
        raise Missing("rosmaster is not installed (python3-rosmaster)")
    command = (DEBIAN_PYTHON, str(script), "--core", "-p")
    version = f"{debian_package('python3-rosmaster')}, {output(DEBIAN_PYTHON, '--version')}"
    return Contender("rosmaster", "rosmaster", command, version=version)


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
