"""A proxy that misbehaves on purpose: what both sides of it see."""

from __future__ import annotations

import asyncio
import math
import os
import socket
import subprocess
import sys
import time
import tracemalloc

import pytest

import aioros1
from aioros1.testing import FlakyProxy, flow

from .ends import PATIENCE, other

WAYS = pytest.mark.parametrize("way", ["up", "down"])
MEGABYTE = bytes(range(256)) * 4096
MORE_THAN_THE_SYSTEM_HOLDS = MEGABYTE * 32


def open_files() -> int:
    """How many files and sockets the process has open, where that can be seen."""
    return len(os.listdir("/proc/self/fd")) if sys.platform.startswith("linux") else 0


# without a fault


@WAYS
async def test_everything_passes_as_it_was_sent(pair, way):
    sender, receiver = pair.ends(way)
    sender.write(MEGABYTE * 8)
    assert await receiver.take(8 << 20) == MEGABYTE * 8
    assert (pair.passed(way), pair.passed(other(way))) == (8 << 20, 0)


async def test_both_ways_at_once(pair):
    pair.client.write(MEGABYTE * 4)
    pair.server.write(MEGABYTE[::-1] * 4)
    up, down = await asyncio.gather(pair.server.take(4 << 20), pair.client.take(4 << 20))
    assert up == MEGABYTE * 4
    assert down == MEGABYTE[::-1] * 4


async def test_it_tells_of_its_connections(proxy, ends):
    assert (proxy.connections, proxy.accepted) == ((), 0)
    client = await ends.client(proxy)
    await ends.client(proxy)
    async with asyncio.timeout(PATIENCE):
        await proxy.wait_accepted(2)
    assert proxy.accepted == 2
    assert [each.number for each in proxy.connections] == [1, 2]
    first = proxy.connections[0]
    assert first.client == client.writer.get_extra_info("sockname")
    assert repr(first) == f"<FlakyConnection 1 from 127.0.0.1:{first.client[1]}, open>"
    proxy.cut()
    assert proxy.connections == ()
    assert proxy.accepted == 2
    assert not first.is_open


@WAYS
async def test_the_end_passes_and_the_other_way_goes_on(pair, proxy, way):
    sender, receiver = pair.ends(way)
    sender.write(b"last")
    sender.writer.write_eof()
    assert await receiver.rest() == b"last"
    receiver.write(MEGABYTE)
    assert await sender.take(1 << 20) == MEGABYTE
    assert pair.connection.is_open
    receiver.writer.close()
    assert await sender.rest() == b""
    await pair.connection.wait_closed()
    assert proxy.connections == ()


@WAYS
async def test_a_reset_passes(pair, way):
    sender, receiver = pair.ends(way)
    sender.reset()
    assert await receiver.until_reset() == b""
    await pair.connection.wait_closed()


async def test_a_client_is_reset_when_the_server_refuses(ends):
    with socket.socket() as nobody:
        nobody.bind(("127.0.0.1", 0))
        async with FlakyProxy("127.0.0.1", nobody.getsockname()[1]) as proxy:
            client = await ends.client(proxy)
            assert await client.until_reset() == b""
            assert (proxy.connections, proxy.accepted) == ((), 1)


async def test_all_addresses_of_the_server_are_tried(ends, server):
    """``localhost`` is 127.0.0.1 and ::1; nothing listens at the first."""
    try:
        listening = await asyncio.start_server(server.came, "::1", 0)
    except OSError:
        pytest.skip("needs IPv6")
    port = listening.sockets[0].getsockname()[1]
    async with FlakyProxy("localhost", port, listen_host="::1") as proxy:
        assert repr(proxy) == f"<FlakyProxy at [::1]:{proxy.port} before localhost:{port}, open>"
        assert await (await ends.pair(proxy)).is_whole()
    listening.close()


async def test_it_listens_where_it_is_told(ends, server):
    async with FlakyProxy("localhost", server.port, listen_host="localhost") as first:
        assert first.host == "127.0.0.1"
        place = f"127.0.0.1:{first.port}"
        assert repr(first) == f"<FlakyProxy at {place} before localhost:{server.port}, open>"
        with pytest.raises(OSError, match=f"cannot listen on {place}: .+"):
            async with FlakyProxy("127.0.0.1", server.port, listen_port=first.port):
                pass
    async with FlakyProxy("127.0.0.1", server.port, listen_port=first.port) as second:
        assert await (await ends.pair(second)).is_whole()


@WAYS
async def test_nothing_is_left_of_it(ends, server, way):
    files = open_files()
    async with FlakyProxy("127.0.0.1", server.port) as proxy:
        pair = await ends.pair(proxy)
        sender, receiver = pair.ends(way)
        proxy.delay(1000, way)
        proxy.throttle(1, other(way))
        sender.write(MORE_THAN_THE_SYSTEM_HOLDS)
        receiver.write(MEGABYTE)
        waiting = asyncio.create_task(proxy.wait_accepted(2))
        await asyncio.sleep(0)
    with pytest.raises(aioros1.ClosedError, match="is closed"):
        await waiting
    with pytest.raises(ConnectionRefusedError):
        await ends.client(proxy)
    assert not pair.connection.is_open
    for end in (pair.client, pair.server):
        end.writer.transport.abort()
    async with asyncio.timeout(PATIENCE):
        while open_files() > files:
            await asyncio.sleep(0.001)


async def test_closing_is_in_good_order(ends, server):
    async with FlakyProxy("127.0.0.1", server.port) as proxy:
        pair = await ends.pair(proxy)
    assert await pair.client.rest() == b""
    assert await pair.server.rest() == b""


async def test_it_is_used_once(proxy):
    with pytest.raises(RuntimeError, match="cannot be used a second time"):
        async with proxy:
            pass


# cut, close, shut


@WAYS
async def test_cut(pair, proxy, ends, way):
    sender, receiver = pair.ends(way)
    sender.write(b"1")
    await receiver.take(1)
    proxy.cut()
    for end in (sender, receiver):
        assert await end.until_reset() == b""
    assert await (await ends.pair(proxy)).is_whole()


@pytest.mark.parametrize("act", ["cut", "refuse", "half_open", "stall"])
async def test_a_connection_that_has_only_just_come(proxy, server, act):
    """The system has taken it, the event loop has not seen it: it is one all the same."""
    with socket.socket() as client:
        client.settimeout(PATIENCE)
        client.connect((proxy.host, proxy.port))
        getattr(proxy, act)()
        assert proxy.accepted == 1
        assert len(proxy.connections) == (act != "cut")
        client.setblocking(False)
        if act == "cut":
            with pytest.raises(ConnectionResetError):
                await asyncio.get_running_loop().sock_recv(client, 1)
        else:
            await server.end()


async def test_one_connection_is_cut(pair, proxy, ends):
    second = await ends.pair(proxy)
    pair.connection.cut()
    pair.connection.cut()
    assert await pair.client.until_reset() == b""
    assert proxy.connections == (second.connection,)
    assert await second.is_whole()


async def test_close_is_no_reset_even_if_something_was_not_read(pair):
    pair.connection.stall()
    pair.client.write(MEGABYTE[:1000])
    pair.server.write(MEGABYTE[:1000])
    assert await pair.server.hears_nothing()
    pair.connection.close()
    assert await pair.client.rest() == b""
    assert await pair.server.rest() == b""


@WAYS
async def test_shut(pair, way):
    sender, receiver = pair.ends(way)
    pair.connection.shut(way)
    assert await receiver.rest() == b""
    sender.write(MORE_THAN_THE_SYSTEM_HOLDS)  # nobody will hear it, and it is no obstacle
    async with asyncio.timeout(PATIENCE):
        await sender.writer.drain()
    receiver.write(b"still there")
    assert await sender.take(11) == b"still there"
    assert pair.passed(way) == 0
    receiver.writer.close()
    assert await sender.rest() == b""
    await pair.connection.wait_closed()


# stall


@WAYS
async def test_stall_and_resume(pair, proxy, ends, way):
    sender, receiver = pair.ends(way)
    proxy.stall(way)
    later = await ends.pair(proxy)
    for each in (pair, later):
        sender, receiver = each.ends(way)
        sender.write(b"abc")
        sender.writer.write_eof()
        receiver.write(b"back")
        assert await sender.take(4) == b"back"
        assert await receiver.hears_nothing()
        assert each.connection.is_open
    proxy.resume(way)
    for each in (pair, later):
        assert await each.ends(way)[1].rest() == b"abc"


@WAYS
async def test_a_stall_is_felt_by_the_sender(pair, way):
    sender, receiver = pair.ends(way)
    pair.connection.stall()
    sender.write(MORE_THAN_THE_SYSTEM_HOLDS)
    with pytest.raises(TimeoutError):
        async with asyncio.timeout(0.05):
            await sender.writer.drain()
    pair.connection.resume()
    assert await receiver.take(len(MORE_THAN_THE_SYSTEM_HOLDS)) == MORE_THAN_THE_SYSTEM_HOLDS


async def test_a_connection_has_faults_of_its_own(pair, proxy, ends):
    second = await ends.pair(proxy)
    pair.connection.stall()
    assert await second.is_whole()
    proxy.stall()
    second.connection.resume()
    assert await second.is_whole()
    pair.client.write(b"x")
    assert await pair.server.hears_nothing()


# throttle and delay: lower bounds alone, which hold on the slowest machine


@WAYS
async def test_throttle(pair, proxy, way):
    sender, receiver = pair.ends(way)
    start = time.monotonic()
    proxy.throttle(1_000_000, way)
    sender.write(MEGABYTE[:200_000])
    assert await receiver.take(200_000) == MEGABYTE[:200_000]
    assert time.monotonic() - start >= 0.15  # a little passes at once
    proxy.throttle(0.001, way)
    sender.write(b"x" * 1000)
    await receiver.take(1)
    assert await receiver.hears_nothing()
    assert pair.passed(way) == 200_001
    receiver.write(b"as quick as ever")
    assert await sender.take(16) == b"as quick as ever"
    proxy.throttle(None, way)
    assert await receiver.take(999) == b"x" * 999


@WAYS
async def test_delay(pair, proxy, way):
    sender, receiver = pair.ends(way)
    proxy.delay(0.1, way)
    start = time.monotonic()
    sender.write(b"first, ")
    await asyncio.sleep(0.05)
    second = time.monotonic()
    sender.write(b"second")
    sender.writer.write_eof()
    assert await receiver.take(7) == b"first, "
    assert time.monotonic() - start >= 0.1
    assert await receiver.rest() == b"second"
    assert time.monotonic() - second >= 0.1
    receiver.write(b"at once")
    assert await sender.take(7) == b"at once"


@WAYS
async def test_order_is_kept_when_a_delay_becomes_shorter(pair, way):
    sender, receiver = pair.ends(way)
    pair.connection.delay(1000, way)
    sender.write(b"one ")
    assert await receiver.hears_nothing()
    pair.connection.delay(0.02, way)
    sender.write(b"two ")
    pair.connection.delay(0)
    sender.write(b"three")
    assert await receiver.take(13) == b"one two three"


@pytest.mark.parametrize("size", [1, 1 << 16])
async def test_memory_is_bounded(pair, size):
    """However much is sent, and in however small pieces."""
    pair.connection.delay(1000)
    tracemalloc.start()
    try:
        for _ in range(2000 if size == 1 else 100):
            pair.client.write(b"x" * size)
            await asyncio.sleep(0)
        assert await pair.server.hears_nothing()
        snapshot = tracemalloc.take_snapshot()
    finally:
        tracemalloc.stop()
    held = snapshot.filter_traces([tracemalloc.Filter(True, flow.__file__)])
    assert sum(each.size for each in held.statistics("filename")) < 2 * flow.ROOM


# corrupt


@WAYS
async def test_corrupt_every_byte(pair, proxy, way):
    sender, receiver = pair.ends(way)
    proxy.corrupt(1, way)
    sender.write(MEGABYTE)
    received = await receiver.take(1 << 20)
    assert all(there != here for there, here in zip(received, MEGABYTE, strict=True))
    receiver.write(MEGABYTE)
    assert await sender.take(1 << 20) == MEGABYTE
    proxy.corrupt(0, way)
    sender.write(MEGABYTE)
    assert await receiver.take(1 << 20) == MEGABYTE


@pytest.mark.parametrize("probability", [0.5, 0.01, 1e-300])
async def test_corrupt_some_bytes(pair, probability):
    pair.connection.corrupt(probability, seed=1)
    pair.client.write(MEGABYTE)
    received = await pair.server.take(1 << 20)
    changed = sum(there != here for there, here in zip(received, MEGABYTE, strict=True))
    mean = probability * (1 << 20)
    assert abs(changed - mean) <= 6 * math.sqrt(mean)


async def test_a_seed_makes_it_repeatable_whatever_the_pieces(ends, server):
    async def received(size: int) -> list[bytes]:
        """What two connections carry of the same, sent in pieces of ``size``."""
        results = []
        async with FlakyProxy("127.0.0.1", server.port) as proxy:
            proxy.corrupt(0.1, seed=17)
            for _ in range(2):
                pair = await ends.pair(proxy)
                for start in range(0, 10_000, size):
                    pair.client.write(MEGABYTE[start : start + size])
                    await pair.connection.passed(start + size, "up")
                results.append(await pair.server.take(10_000))
        return results

    whole, pieces = await received(10_000), await received(100)
    assert whole == pieces
    assert whole[0] != whole[1]  # or a second attempt would always fail as the first


# refuse and half_open


async def test_refuse_and_accept(pair, proxy, ends):
    waiting = await ends.client(proxy)  # connected before
    port = proxy.port
    proxy.refuse()
    proxy.refuse()
    with pytest.raises(ConnectionRefusedError):
        await ends.client(proxy)
    with socket.socket() as other, pytest.raises(OSError, match="in use"):
        other.bind((proxy.host, port))
    assert await pair.is_whole()
    waiting.write(b"me too")
    assert await (await ends.server.end()).take(6) == b"me too"
    proxy.accept()
    proxy.accept()
    assert proxy.port == port
    assert await (await ends.pair(proxy)).is_whole()
    assert proxy.accepted == 3


async def test_half_open(pair, proxy, ends, server):
    waiting = await ends.client(proxy)  # connected before
    proxy.half_open(True)
    client = await ends.client(proxy)
    client.write(MORE_THAN_THE_SYSTEM_HOLDS)
    assert await client.hears_nothing()
    waiting.write(b"me too")
    assert await (await server.end()).take(6) == b"me too"
    assert len(server.all) == 2
    assert len(proxy.connections) == 3
    assert await pair.is_whole()
    silent = proxy.connections[-1]
    silent.stall()
    silent.resume()
    silent.shut("down")
    assert await client.rest() == b""
    silent.cut()
    proxy.half_open(False)
    assert await (await ends.pair(proxy)).is_whole()


# mistakes


@pytest.mark.parametrize(
    ("fault", "value"),
    [
        ("throttle", 0),
        ("throttle", math.inf),
        ("throttle", math.nan),
        ("delay", -1),
        ("delay", math.nan),
        ("corrupt", 1.5),
        ("corrupt", math.nan),
        ("stall", "left"),
    ],
)
async def test_what_means_nothing_is_refused(pair, proxy, fault, value):
    for flaky in (proxy, pair.connection):
        with pytest.raises(ValueError, match=rf"must .*, got {value!r}$"):
            getattr(flaky, fault)(value)
    assert await pair.is_whole()


@pytest.mark.parametrize(
    ("ports", "error"),
    [
        ((0, 0), "port must be a number from 1 to 65535, got 0"),
        ((70000, 0), "port must be a number from 1 to 65535, got 70000"),
        (("http", 0), "port must be a number from 1 to 65535, got 'http'"),
        ((80, -1), "listen_port must be a number from 0 to 65535, got -1"),
    ],
)
def test_a_port_that_is_none(ports, error):
    with pytest.raises(ValueError, match=f"^{error}$"):
        FlakyProxy("localhost", ports[0], listen_port=ports[1])


@pytest.mark.skipif(sys.platform == "win32", reason="needs limits of resources")
@pytest.mark.parametrize("files", [0, 1])
async def test_a_connection_that_cannot_be_taken_ends_the_block(server, files):
    """There is no file left for it, or only one of the two."""
    import resource

    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    with pytest.raises(OSError, match="Too many open files"), socket.socket() as client:
        client.setblocking(False)
        async with FlakyProxy("127.0.0.1", server.port) as proxy:
            next_file = os.dup(0)
            os.close(next_file)
            resource.setrlimit(resource.RLIMIT_NOFILE, (next_file + files, limits[1]))
            try:
                client.connect_ex((proxy.host, proxy.port))
                await asyncio.sleep(PATIENCE)
            finally:
                resource.setrlimit(resource.RLIMIT_NOFILE, limits)


def test_it_is_not_loaded_with_the_library_and_needs_nothing_else():
    code = (
        "import sys, aioros1; assert 'aioros1.testing' not in sys.modules\n"
        "import aioros1.testing; assert aioros1.testing.FlakyProxy\n"
        "assert not {'aiohttp', 'pytest', 'aioros1.node'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=20)
