"""How many messages a second get through, beside rospy and roscpp in the same run.

    python benchmarks/topics.py [--count N] [--size BYTES] [--runs N] [--json FILE]

Each client sends ``std_msgs/String`` from one process to another over loopback, under one
master. Peers that are not installed are left out, and the table says so. Figures drift
from machine to machine and from minute to minute: quote the ratios, which are of medians
of runs that took turns. To compare interpreters fairly, run it with a virtual environment
made from the Python that has rospy (``/usr/bin/python3`` on Debian).
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import xmlrpc.client
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
PEERS = HERE / "peers"
DEBIAN_PYTHON = "/usr/bin/python3"
LIBRARIES = [
    *("-lroscpp", "-lrosconsole", "-lroscpp_serialization", "-lxmlrpcpp", "-lrostime"),
    *("-lcpp_common", "-lboost_system", "-lboost_thread", "-lpthread"),
]
TIMEOUT = 300


@dataclass(frozen=True)
class Result:
    """One run: what arrived, in how long, and what both processes used for it."""

    sent: int
    received: int
    seconds: float
    cpu: float

    @property
    def rate(self) -> float:
        return (self.received - 1) / self.seconds

    @property
    def cpu_per_million(self) -> float:
        return self.cpu / self.received * 1e6

    @property
    def lost(self) -> float:
        return 1 - self.received / self.sent


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--count", type=int, default=1_000_000, help="messages per run")
    parser.add_argument("--size", type=int, default=32, help="bytes of the string")
    parser.add_argument("--runs", type=int, default=3, help="runs of each client")
    parser.add_argument("--json", type=Path, help="write all results to this file")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        environment = ros_environment(Path(scratch))
        clients, missing = find_clients(Path(scratch))
        master = start_master(environment)
        try:
            results = run_all(clients, options, environment)
        finally:
            master.terminate()
            master.wait()
    print_table(results, options)
    for text in missing:
        print(text)
    if options.json:
        rows = {name: [vars(result) for result in runs] for name, runs in results.items()}
        options.json.write_text(json.dumps(rows, indent=2))


def find_clients(scratch: Path) -> tuple[dict[str, list[str]], list[str]]:
    """The command of each client that can run here, and what to say of the others."""
    ours = [sys.executable, str(PEERS / "aioros1_peer.py")]
    clients = {"aioros1": ours}
    missing = []
    if subprocess.run([sys.executable, "-c", "import uvloop"], capture_output=True).returncode == 0:
        clients["aioros1, uvloop"] = [*ours, "--uvloop"]
    else:
        missing.append("uvloop is not installed")
    python = Path(DEBIAN_PYTHON)
    if (
        python.exists()
        and subprocess.run([python, "-c", "import rospy"], capture_output=True).returncode == 0
    ):
        clients["rospy, synchronous"] = [DEBIAN_PYTHON, str(PEERS / "rospy_peer.py")]
    else:
        missing.append("rospy is not installed (python3-rospy)")
    if Path("/usr/include/ros/ros.h").exists() and shutil.which("g++"):
        binary = scratch / "roscpp_peer"
        source = str(PEERS / "roscpp_peer.cpp")
        subprocess.run(
            ["g++", "-O2", "-std=c++17", source, "-o", str(binary), *LIBRARIES], check=True
        )
        clients["roscpp, unbounded"] = [str(binary)]
    else:
        missing.append("roscpp is not installed (libroscpp-dev, libstd-msgs-dev, g++)")
    return clients, missing


def ros_environment(scratch: Path) -> dict[str, str]:
    """The environment of all programs: a free port for the master, everything on loopback."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
    environment.update(
        ROS_MASTER_URI=f"http://localhost:{port}",
        ROS_HOSTNAME="localhost",
        ROS_HOME=str(scratch),
        ROS_PACKAGE_PATH="/usr/share",
        PYTHONPATH=os.pathsep.join(filter(None, [str(HERE.parent), os.environ.get("PYTHONPATH")])),
        PYTHONWARNINGS="ignore",
    )
    return environment


def start_master(environment: dict[str, str]) -> subprocess.Popen[bytes]:
    """Our own master; which one it is makes no difference to messages."""
    uri = environment["ROS_MASTER_URI"]
    code = (
        "import asyncio, sys, aioros1\n"
        "async def main():\n"
        "    async with aioros1.Master('localhost', int(sys.argv[1])) as master:\n"
        "        await master.wait_closed()\n"
        "asyncio.run(main())\n"
    )
    master = subprocess.Popen([sys.executable, "-c", code, uri.rpartition(":")[2]], env=environment)
    for _ in range(200):
        try:
            xmlrpc.client.ServerProxy(uri).getPid("/benchmark")
        except OSError:
            time.sleep(0.05)
        else:
            return master
    raise SystemExit("the master did not start")


def run_all(
    clients: dict[str, list[str]], options: argparse.Namespace, environment: dict[str, str]
) -> dict[str, list[Result]]:
    """Every client in turn, as often as asked, so that a drift of the machine hits all."""
    results: dict[str, list[Result]] = {name: [] for name in clients}
    for number in range(options.runs):
        for name, command in clients.items():
            print(f"run {number + 1}: {name}", file=sys.stderr)
            results[name].append(run_once(command, options, environment))
    return results


def run_once(
    command: list[str], options: argparse.Namespace, environment: dict[str, str]
) -> Result:
    arguments = [str(options.count), str(options.size)]
    program, *rest = command
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    sub = subprocess.Popen(
        [program, *rest[:1], "sub", *arguments, *rest[1:]], env=environment, stdout=subprocess.PIPE
    )
    pub = subprocess.Popen([program, *rest[:1], "pub", *arguments, *rest[1:]], env=environment)
    try:
        output, _ = sub.communicate(timeout=TIMEOUT)
        pub.wait(timeout=TIMEOUT)
    finally:
        for process in (sub, pub):
            if process.poll() is None:
                process.kill()
                process.wait()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    # roscpp logs to standard output as well.
    (line,) = [line for line in output.decode().splitlines() if line.startswith("{")]
    return Result(sent=options.count, cpu=cpu, **json.loads(line))


def print_table(results: dict[str, list[Result]], options: argparse.Namespace) -> None:
    rates = {name: statistics.median(run.rate for run in runs) for name, runs in results.items()}
    print(
        f"std_msgs/String of {options.size} bytes, {options.count} a run, medians of "
        f"{options.runs} runs; Python {sys.version.split()[0]}, start-up is in the CPU time"
    )
    others = [name for name in rates if not name.startswith("aioros1")]
    header = f"{'':22}{'messages/s':>12}{'lost':>8}{'CPU s/million':>15}"
    print(header + "".join(f"{'x ' + name.split(',')[0]:>12}" for name in others))
    for name, runs in results.items():
        lost = max(run.lost for run in runs)
        cpu = statistics.median(run.cpu_per_million for run in runs)
        ratios = "".join(f"{rates[name] / rates[other]:>12.2f}" for other in others)
        print(f"{name:22}{rates[name]:>12,.0f}{lost:>8.1%}{cpu:>15.2f}{ratios}")


if __name__ == "__main__":
    main()
