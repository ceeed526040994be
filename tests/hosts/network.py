"""Hosts made of network namespaces, and the cables between them.

A network has a namespace of its own for its switches: bridges, to which each host has a
pair of veth interfaces. Nothing of it is seen outside, so that every network has the same
addresses, and any number of them are there at a time: only the names of the namespaces
have to be unique.
"""

from __future__ import annotations

import contextlib
import itertools
import os
import shutil
import subprocess
from collections.abc import Iterator, Mapping
from pathlib import Path

from .remote import Program

__all__ = ["Host", "Network", "network", "run", "sweep", "why_not"]

_numbers = itertools.count(1)
_ETC = Path("/etc/netns")


def run(*command: str) -> str:
    """What a command writes. Raises :class:`RuntimeError` with what it complains of."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout


def why_not() -> str | None:
    """What keeps this machine from having network namespaces; None if nothing does."""
    if shutil.which("ip") is None:
        return "there is no `ip`: apt-get install iproute2"
    try:
        with network() as net:
            net.host("probe").run("ip", "-br", "address")
    except RuntimeError as error:
        return f"no right to make network namespaces: {error}"
    return None


def sweep() -> None:
    """Take away what test runs have left that were killed."""
    for path in Path("/run/netns").glob("aioros1-*-*"):
        if not Path("/proc", path.name.split("-")[1]).exists():
            _remove(path.name)


def _remove(namespace: str) -> None:
    shutil.rmtree(_ETC / namespace, ignore_errors=True)
    with contextlib.suppress(RuntimeError):  # it may not have come into being
        run("ip", "netns", "delete", namespace)


@contextlib.contextmanager
def network() -> Iterator[Network]:
    """A network without hosts yet; nothing is left of it afterwards."""
    net = Network()
    try:
        net.open()
        yield net
    finally:
        net.close()


class Network:
    """Hosts, and the networks that they are on: 1 is 10.77.1.0/24 and fd77:1::/64."""

    def __init__(self) -> None:
        self._prefix = f"aioros1-{os.getpid()}-{next(_numbers)}"
        self._namespaces: list[str] = []
        self._lans: set[int] = set()
        self._hosts: list[Host] = []
        self.switch = ""

    def open(self) -> None:
        """Make a place for the switches."""
        self.switch = self._namespace("switch")

    def host(self, name: str, *lans: int) -> Host:
        """A new host on these networks, the first by default."""
        host = Host(self, name, self._namespace(name), len(self._hosts) + 2)
        self._hosts.append(host)
        for lan in lans or (1,):
            self._plug_in(host, lan)
        return host

    def close(self) -> None:
        """End all programs, and take everything away."""
        for host in self._hosts:
            for program in host.programs:
                program.kill()
        for namespace in self._namespaces:
            _remove(namespace)
        with contextlib.suppress(OSError):
            _ETC.rmdir()  # if nobody else has anything there

    def _namespace(self, name: str) -> str:
        namespace = f"{self._prefix}-{name}"
        self._namespaces.append(namespace)
        run("ip", "netns", "add", namespace)
        run("ip", "-n", namespace, "link", "set", "lo", "up")
        return namespace

    def _plug_in(self, host: Host, lan: int) -> None:
        if lan not in self._lans:
            self._lans.add(lan)
            run("ip", "-n", self.switch, "link", "add", f"lan{lan}", "type", "bridge")
            run("ip", "-n", self.switch, "link", "set", f"lan{lan}", "up")
        port, eth = host.port(lan), f"eth{lan}"
        peer = ("peer", "name", eth, "netns", host.namespace)
        run("ip", "-n", self.switch, "link", "add", port, "type", "veth", *peer)
        run("ip", "-n", self.switch, "link", "set", port, "master", f"lan{lan}", "up")
        host.give_address(host.address_on(lan), lan)
        with contextlib.suppress(RuntimeError):  # a kernel without IPv6
            ipv6 = f"fd77:{lan}::{host.number}/64"
            host.ip("address", "add", ipv6, "dev", eth, "nodad")
        host.ip("link", "set", eth, "up")
        if lan == 1:
            host.default_route()


class Host:
    """One machine of a :class:`Network`."""

    def __init__(self, net: Network, name: str, namespace: str, number: int) -> None:
        self.name = name
        self.namespace = namespace
        self.number = number
        self.programs: list[Program] = []
        self._net = net

    def address_on(self, lan: int) -> str:
        return f"10.77.{lan}.{self.number}"

    @property
    def address(self) -> str:
        """On the first network."""
        return self.address_on(1)

    @property
    def ipv6(self) -> str:
        """On the first network."""
        return f"fd77:1::{self.number}"

    def port(self, lan: int) -> str:
        """The other end of its cable."""
        return f"{self.name}{lan}"

    # what runs on it

    def command(self, *command: str) -> list[str]:
        """The command line that runs a command here."""
        return ["ip", "netns", "exec", self.namespace, *command]

    def run(self, *command: str) -> str:
        return run(*self.command(*command))

    def ip(self, *words: str) -> str:
        return run("ip", "-n", self.namespace, *words)

    def start(self, **environment: str) -> Program:
        """Start a program to be told what to do, with these variables and no others of ROS."""
        program = Program(self.name, self.command(), environment)
        self.programs.append(program)
        return program

    def know(self, names: Mapping[str, str]) -> None:
        """Give programs that are started from now on an ``/etc/hosts`` of their own, and
        nobody to ask for other names."""
        folder = _ETC / self.namespace
        folder.mkdir(parents=True, exist_ok=True)
        lines = [f"{address} {name}\n" for name, address in names.items()]
        (folder / "hosts").write_text("".join(lines))
        (folder / "resolv.conf").write_text("nameserver 127.0.0.1\n")

    def set(self, name: str, value: object) -> bool:
        """Set a value of the kernel's below ``/proc/sys/net``; whether it has it."""
        try:
            self.run("sh", "-c", f"echo {value} > /proc/sys/net/{name}")
        except RuntimeError:
            return False
        return True

    # what happens to its network

    def cut(self, lan: int = 1) -> None:
        """Let everything to and from it vanish, without a sign."""
        run("ip", "-n", self._net.switch, "link", "set", self.port(lan), "nomaster")

    def mend(self, lan: int = 1) -> None:
        """End what :meth:`cut` has begun."""
        switch, port = self._net.switch, self.port(lan)
        run("ip", "-n", switch, "link", "set", port, "master", f"lan{lan}")

    def unplug(self, lan: int = 1) -> None:
        """Pull the cable: its interface has no carrier."""
        run("ip", "-n", self._net.switch, "link", "set", self.port(lan), "down")

    def plug(self, lan: int = 1) -> None:
        """End what :meth:`unplug` has begun."""
        run("ip", "-n", self._net.switch, "link", "set", self.port(lan), "up")

    def disturb(self) -> bool:
        """Lose 5 % of what it sends, and hold back the rest for 50 ms; whether it can."""
        rule = ("root", "netem", "loss", "5%", "delay", "50ms")
        try:
            run("tc", "-n", self.namespace, "qdisc", "add", "dev", "eth1", *rule)
        except (OSError, RuntimeError):
            return False
        return True

    def lose(self) -> bool:
        """Lose 5 % of what comes; whether it can."""
        rules = (
            "add table inet loss",
            "add chain inet loss in { type filter hook input priority 0; }",
            "add rule inet loss in iifname eth1 numgen random mod 100 < 5 drop",
        )
        try:
            self.run("nft", "; ".join(rules))
        except RuntimeError:
            return False
        return True

    def vanish(self) -> None:
        """Take its interface away for good: nobody hears of it any more."""
        run("ip", "-n", self._net.switch, "link", "delete", self.port(1))

    def default_route(self) -> None:
        """By a gateway that nobody is."""
        self.ip("route", "replace", "default", "via", "10.77.1.1")

    def give_address(self, address: str, lan: int = 1) -> None:
        self.ip("address", "add", f"{address}/24", "dev", f"eth{lan}")

    def take_address(self, address: str, lan: int = 1) -> None:
        self.ip("address", "delete", f"{address}/24", "dev", f"eth{lan}")
