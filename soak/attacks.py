"""What others can do to a node or a master, and what it costs those who behave.

    python soak/attacks.py [ATTACK ...] [--uvloop] [--tree PATH] [--json FILE]

Each attack runs in three processes: a victim, an attacker and a bystander, who asks the victim
for something small all the time. It prints the memory of the victim at its peak, beyond what it
had before, and the longest that the bystander had to wait for an answer. The attacker is this
process. ``--tree`` is another checkout to attack, to compare with.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import gzip
import json
import os
import resource
import signal
import socket
import struct
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

MB = 1 << 20

MEMORY = 8 << 30
"""Bytes that a victim may have, so that it ends before other programs do."""

LONGEST = 60.0
"""Seconds after which the bystander stops to wait."""


# ------------------------------------------------------------------- the victim


def call(method: str, *params: str) -> bytes:
    """The document of a call, whose parameters are XML."""
    values = "".join(f"<param><value>{each}</value></param>" for each in params)
    return (
        f"<?xml version='1.0'?><methodCall><methodName>{method}</methodName>"
        f"<params>{values}</params></methodCall>"
    ).encode()


def post(body: bytes, *fields: str) -> bytes:
    """An HTTP request."""
    head = ["POST / HTTP/1.1", "Host: x", f"Content-Length: {len(body)}", *fields, "", ""]
    return "\r\n".join(head).encode() + body


async def victim(kind: str) -> None:
    """A master, or a node with a topic, a subscription and a service, until stdin ends."""
    import aioros1
    from aioros1.msg.std_msgs import String
    from aioros1.srv.std_srvs import SetBool

    async with contextlib.AsyncExitStack() as stack:
        master = aioros1.Master("127.0.0.1", port=0, rosout=False)
        await stack.enter_async_context(master)
        addresses = {"xmlrpc": master.uri, "tcpros": ""}
        if kind == "node":
            node = aioros1.Node("victim", master_uri=master.uri, host="127.0.0.1", rosout=False)
            await stack.enter_async_context(node)
            await node.advertise("chatter", String)
            await node.subscribe("heard", String)
            await node.advertise_service("flip", SetBool, lambda request: {})
            host, port = node.tcpros_address
            addresses = {"xmlrpc": node.uri, "tcpros": f"{host}:{port}"}
        print(json.dumps(addresses), flush=True)
        loop = asyncio.get_running_loop()
        await loop.run_in_executor(None, sys.stdin.read)
    os._exit(0)


def bystander(uri: str) -> None:
    """Ask for the process id again and again, until told to end; print the longest wait."""
    address = urlsplit(uri)
    assert address.hostname is not None
    assert address.port is not None
    request = post(call("getPid", "/bystander"))
    ended = False

    def end(*_: object) -> None:
        nonlocal ended
        ended = True

    signal.signal(signal.SIGTERM, end)
    longest = 0.0
    failed = 0
    print("ready", flush=True)
    sock: socket.socket | None = None
    while not ended:
        begin = time.perf_counter()
        try:
            if sock is None:
                sock = socket.create_connection((address.hostname, address.port), LONGEST)
            sock.sendall(request)
            if not sock.recv(65536):
                raise ConnectionResetError
        except OSError:
            failed += 1
            if sock is not None:
                sock.close()
            sock = None
            time.sleep(0.05)
        longest = max(longest, time.perf_counter() - begin)
        time.sleep(0.002)
    print(json.dumps({"longest": longest, "failed": failed}), flush=True)


# ------------------------------------------------------------------- the attacks


@dataclass
class Target:
    """The addresses of a victim."""

    xmlrpc: tuple[str, int]
    tcpros: tuple[str, int]

    async def ask(self, request: bytes, *, seconds: float = 120) -> bytes:
        """The beginning of the answer, once all of it has come; nothing if none comes."""
        try:
            async with asyncio.timeout(seconds):
                reader, writer = await asyncio.open_connection(*self.xmlrpc, limit=MB)
                writer.write(request)
                head = await reader.readuntil(b"\r\n\r\n")
                length = int(head.lower().partition(b"content-length:")[2].split()[0])
                begin = await reader.readexactly(min(length, 200))
                length -= len(begin)
                while length:
                    data = await reader.read(min(length, MB))
                    if not data:
                        break
                    length -= len(data)
                writer.close()
                return begin
        except (OSError, TimeoutError, asyncio.IncompleteReadError, ValueError, IndexError):
            return b""

    async def ask_and_read_nothing(self, request: bytes) -> asyncio.StreamWriter | None:
        try:
            _, writer = await asyncio.open_connection(*self.xmlrpc, limit=1024)
            writer.transport.pause_reading()  # type: ignore[attr-defined]
            writer.write(request)
            async with asyncio.timeout(30):
                await writer.drain()
            return writer
        except (OSError, TimeoutError):
            return None

    async def send(self, where: tuple[str, int], *parts: bytes) -> asyncio.StreamWriter | None:
        """Send ``parts``, and keep the connection."""
        try:
            _, writer = await asyncio.open_connection(*where)
            for part in parts:
                writer.write(part)
                async with asyncio.timeout(30):
                    await writer.drain()
            return writer
        except (OSError, TimeoutError):
            return None

    async def set_param(self, key: str, value: str) -> bytes:
        return await self.ask(post(call("setParam", "/attacker", key, value)))


def array(values: str) -> str:
    return f"<array><data>{values}</data></array>"


def header(**fields: str) -> bytes:
    def frame(data: bytes) -> bytes:
        return struct.pack("<I", len(data)) + data

    return frame(b"".join(frame(f"{name}={text}".encode()) for name, text in fields.items()))


async def multicall(target: Target) -> None:
    await target.set_param("/p", "x" * 1_000_000)
    entry = (
        "<value><struct><member><name>methodName</name><value>getParam</value></member><member>"
        "<name>params</name><value><array><data><value>/a</value><value>/p</value></data></array>"
        "</value></member></struct></value>"
    )
    body = call("system.multicall", array(entry * 2000))
    await target.ask(post(body))


async def gzipped(target: Target) -> None:
    body = gzip.compress(call("getPid", "/a" + "x" * (60 * MB)), 9)
    request = post(body, "Content-Encoding: gzip")
    await asyncio.gather(*(target.ask(request) for _ in range(100)))


async def gzip_tail(target: Target) -> None:
    body = gzip.compress(call("getPid", "/a")) + b"x" * (60 * MB)
    await target.ask(post(body, "Content-Encoding: gzip"))


async def unread(target: Target) -> None:
    await target.set_param("/p", "x" * (60 * MB))
    request = post(call("getParam", "/a", "/p"))
    kept = [await target.ask_and_read_nothing(request) for _ in range(20)]
    await asyncio.sleep(10)
    _close(kept)


async def unread_versions(target: Target) -> None:
    kept = []
    for number in range(15):
        await target.set_param("/p", f"{number}" + "x" * (50 * MB))
        kept.append(await target.ask_and_read_nothing(post(call("getParam", "/a", "/p"))))
    await asyncio.sleep(2)
    _close(kept)


async def half_bodies(target: Target) -> None:
    request = post(call("setParam", "/a", "/p", "x" * (50 * MB)))[:-1]
    kept = await asyncio.gather(*(target.send(target.xmlrpc, request) for _ in range(40)))
    await asyncio.sleep(2)
    _close(kept)


async def parameters(target: Target) -> None:
    for number in range(40):
        await target.set_param(f"/p{number}", "x" * (50 * MB))


async def large_param(target: Target) -> None:
    await target.set_param("/p", "x" * (60 * MB))
    await target.ask(post(call("getParam", "/a", "/p")))


async def many_values(target: Target) -> None:
    await target.set_param(
        "/p", f"<array><data>{'<value><i4>1</i4></value>' * 240_000}</data></array>"
    )
    await target.ask(post(call("getParam", "/a", "/p")))


async def small_values_at_once(target: Target) -> None:
    request = post(
        call("setParam", "/a", "/p", f"<array><data>{'<value/>' * 7_000}</data></array>")
    )
    await asyncio.gather(*(target.ask(request) for _ in range(300)))


async def system_state(target: Target) -> None:
    for number in range(0, 10_000, 200):
        await asyncio.gather(
            *(
                target.ask(
                    post(call("registerService", f"/n{each % 997}", f"/service{each}",
                              "rosrpc://127.0.0.1:1", f"http://127.0.0.1:1/{each % 997}"))
                )
                for each in range(number, number + 200)
            )
        )  # fmt: skip
    request = post(call("getSystemState", "/a"))
    await asyncio.gather(*(target.ask(request) for _ in range(50)))


async def long_key(target: Target) -> None:
    await target.ask(post(call("getParam", "/a", "/x" * (30 * MB))))


async def long_uris(target: Target) -> None:
    for number in range(60):
        uri = f"http://127.0.0.1:1/{number}" + "x" * (8 * MB)
        await target.ask(post(call("registerSubscriber", f"/n{number}", "/t", "a/B", uri)))
    uri = "http://127.0.0.1:1/"
    await target.ask(post(call("registerPublisher", "/p", "/t", "a/B", uri)))
    await asyncio.sleep(3)


async def publishers(target: Target) -> None:
    uris = "".join(
        f"<value>http://127.{each // 250 % 250}.{each % 250}.1:1/{each}</value>"
        for each in range(60_000)
    )
    body = call("publisherUpdate", "/a", "/heard", array(uris))
    await target.ask(post(body), seconds=20)
    await asyncio.sleep(10)


async def headers(target: Target) -> None:
    first = header(
        callerid="/a", md5sum="*", topic="/chatter", type="*", message_definition="x" * 1_000_000
    )
    kept = []
    for _ in range(50):
        kept += await asyncio.gather(*(target.send(target.tcpros, first) for _ in range(10)))
    await target.ask(post(call("getBusInfo", "/a")))
    _close(kept)


async def long_names(target: Target) -> None:
    first = header(callerid="/" + "x" * 1_000_000, md5sum="*", topic="/chatter", type="*")
    kept = []
    for _ in range(50):
        kept += await asyncio.gather(*(target.send(target.tcpros, first) for _ in range(10)))
    await target.ask(post(call("getBusInfo", "/a")))
    _close(kept)


async def half_headers(target: Target) -> None:
    first = header(callerid="/a", md5sum="*", topic="/chatter", x="x" * 1_000_000)[:-1]
    kept = []
    for _ in range(200):
        kept += await asyncio.gather(*(target.send(target.tcpros, first) for _ in range(10)))
    await asyncio.sleep(2)
    _close(kept)


async def service_requests(target: Target) -> None:
    first = header(callerid="/a", md5sum="*", service="/flip", persistent="1")
    parts = [first, struct.pack("<I", 900 * MB), *[b"x" * MB] * 100]
    kept = await asyncio.gather(*(target.send(target.tcpros, *parts) for _ in range(30)))
    await asyncio.sleep(1)
    _close(kept)


def _close(kept: list[asyncio.StreamWriter | None]) -> None:
    for writer in kept:
        if writer is not None:
            writer.transport.abort()


@dataclass(frozen=True)
class Attack:
    what: str
    victim: str
    run: Callable[[Target], Awaitable[None]]


ATTACKS = {
    "multicall": Attack("one multicall of 2,000 `getParam` of 1 MB", "master", multicall),
    "gzip": Attack("100 bodies of 60 kB that gzip makes of 60 MB", "master", gzipped),
    "gzip-tail": Attack("60 MB behind the end of a gzip body", "master", gzip_tail),
    "unread": Attack("20 connections that ask for 60 MB and read nothing", "master", unread),
    "unread-versions": Attack(
        "the same, with a new value of 50 MB for each of 15", "master", unread_versions
    ),
    "half-bodies": Attack("40 bodies of 50 MB without the last byte", "master", half_bodies),
    "parameters": Attack("40 parameters of 50 MB", "master", parameters),
    "large-param": Attack("a parameter of 60 MB, set and read", "master", large_param),
    "many-values": Attack("a parameter of 240,000 values, set and read", "master", many_values),
    "at-once": Attack("300 requests of 7,000 values at once", "master", small_values_at_once),
    "system-state": Attack("10,000 registrations, asked for 50 times", "master", system_state),
    "long-key": Attack("a key of 60 MB with 30 million slashes", "master", long_key),
    "long-uris": Attack("60 nodes with URIs of 8 MB, to be notified", "master", long_uris),
    "publishers": Attack("one list of 60,000 publishers", "node", publishers),
    "headers": Attack("500 subscribers with headers of 1 MB, then `getBusInfo`", "node", headers),
    "long-names": Attack("the same with names of 1 MB", "node", long_names),
    "half-headers": Attack("2,000 headers of 1 MB without the last byte", "node", half_headers),
    "service-requests": Attack(
        "30 service requests of 900 MB, of which 100 MB arrive", "node", service_requests
    ),
}  # fmt: skip


# ------------------------------------------------------------------- measuring


@contextlib.asynccontextmanager
async def started(*words: str, tree: Path) -> AsyncIterator[asyncio.subprocess.Process]:
    process = await asyncio.create_subprocess_exec(
        *(sys.executable, __file__, "--tree", str(tree), *words),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield process
    finally:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        await process.wait()


def forget_peak(pid: int) -> None:
    """Let the peak of a process begin now."""
    Path(f"/proc/{pid}/clear_refs").write_text("5")


def memory(pid: int, name: str) -> int:
    """Bytes of memory that a process has, or had at most."""
    with contextlib.suppress(OSError):
        for line in Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith(name):
                return int(line.split()[1]) << 10
    return 0


async def measure(attack: Attack, tree: Path, loop: list[str]) -> dict[str, Any]:
    async with started("--victim", attack.victim, *loop, tree=tree) as process:
        assert process.stdout is not None
        told = json.loads(await process.stdout.readline())
        xmlrpc = urlsplit(told["xmlrpc"])
        host, _, port = (told["tcpros"] or ":0").partition(":")
        assert xmlrpc.port is not None
        target = Target(("127.0.0.1", xmlrpc.port), (host, int(port)))
        async with started("--bystander", told["xmlrpc"], tree=tree) as other:
            assert other.stdout is not None
            await other.stdout.readline()
            await asyncio.sleep(0.3)
            forget_peak(process.pid)
            before = memory(process.pid, "VmRSS")
            begin = time.monotonic()
            await attack.run(target)
            peak = memory(process.pid, "VmHWM")
            lives = process.returncode is None
            other.terminate()
            try:
                async with asyncio.timeout(LONGEST + 10):
                    result = json.loads(await other.stdout.readline())
            except (TimeoutError, ValueError):
                result = {"longest": LONGEST, "failed": 1}
    return {
        "what": attack.what,
        "victim": attack.victim,
        "megabytes": round((peak - before) / 1e6) if lives else None,
        "longest": round(result["longest"], 3),
        "failed": result["failed"],
        "seconds": round(time.monotonic() - begin, 1),
    }


async def main(options: argparse.Namespace) -> None:
    loop = ["--uvloop"] if options.uvloop else []
    for name in options.attacks or ATTACKS:
        result = await measure(ATTACKS[name], options.tree, loop)
        ended = "ended" if result["megabytes"] is None else f"{result['megabytes']:,} MB"
        print(
            f"{name}: {ended}, longest wait {result['longest']:.2f} s, "
            f"{result['failed']} failed, in {result['seconds']} s",
            flush=True,
        )
        if options.json:
            kept = json.loads(options.json.read_text()) if options.json.exists() else {}
            options.json.write_text(json.dumps(kept | {name: result}, indent=1))


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("attacks", nargs="*", metavar="ATTACK", help=", ".join(ATTACKS))
    parser.add_argument("--uvloop", action="store_true", help="the victim runs on uvloop")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep the results there")
    parser.add_argument("--tree", type=Path, default=Path(__file__).resolve().parent.parent)
    parser.add_argument("--victim", help=argparse.SUPPRESS)
    parser.add_argument("--bystander", help=argparse.SUPPRESS)
    options = parser.parse_args()
    for name in options.attacks:
        if name not in ATTACKS:
            parser.error(f"no attack {name!r}; there are {', '.join(ATTACKS)}")
    return options


if __name__ == "__main__":
    options = parse()
    if options.bystander:
        bystander(options.bystander)
    elif options.victim:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        sys.path.insert(0, str(options.tree))
        factory = None
        if options.uvloop:
            import uvloop

            factory = uvloop.new_event_loop
        with asyncio.Runner(loop_factory=factory) as runner:
            runner.run(victim(options.victim))
    else:
        asyncio.run(main(options))
