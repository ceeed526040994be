"""Scripts for each connection: faults at an exact byte, and what becomes of their errors."""

from __future__ import annotations

import asyncio

import pytest

from aioros1.testing import FlakyConnection, FlakyProxy

from .ends import PATIENCE, other

WAYS = pytest.mark.parametrize("way", ["up", "down"])
LETTERS = b"abcdefghijklmnopqrstuvwxyz"


@pytest.fixture
def proxy_with(server):
    """``proxy_with(script)``: a proxy before the server."""
    return lambda script: FlakyProxy("127.0.0.1", server.port, script=script)


async def forever(connection: FlakyConnection) -> None:
    await asyncio.get_running_loop().create_future()


# bytes


@WAYS
@pytest.mark.parametrize("count", [0, 1, 17, 26])
async def test_a_cut_after_exactly_so_many_bytes(ends, proxy_with, way, count):
    async def script(connection):
        await connection.passed(count, way)
        connection.cut()

    async with proxy_with(script) as proxy:
        # Not pair(): by then it may be over.
        client = await ends.client(proxy)
        server = await ends.server.end()
        sender, receiver = (client, server) if way == "up" else (server, client)
        sender.write(LETTERS)
        assert await receiver.until_reset() == LETTERS[:count]


@WAYS
async def test_shut_and_close_after_exactly_so_many_bytes(ends, proxy_with, way):
    async def script(connection):
        await connection.passed(5, way)
        connection.shut(way)
        await connection.passed(7, other(way))
        connection.close()

    async with proxy_with(script) as proxy:
        pair = await ends.pair(proxy)
        sender, receiver = pair.ends(way)
        sender.write(LETTERS)
        assert await receiver.rest() == LETTERS[:5]
        receiver.write(LETTERS)
        assert await sender.rest() == LETTERS[:7]
        assert (pair.passed(way), pair.passed(other(way))) == (5, 7)
        assert proxy.connections == ()


@WAYS
async def test_corruption_of_exactly_these_bytes(ends, proxy_with, way):
    async def script(connection):
        await connection.passed(3, way)
        connection.corrupt(1, way)
        await connection.passed(10, way)
        connection.corrupt(0, way)

    async with proxy_with(script) as proxy:
        pair = await ends.pair(proxy)
        sender, receiver = pair.ends(way)
        sender.write(LETTERS)
        received = await receiver.take(26)
        changed = [at for at in range(26) if received[at] != LETTERS[at]]
        assert changed == list(range(3, 10))


@WAYS
async def test_a_stall_after_exactly_so_many_bytes_of_many(ends, proxy_with, way):
    stalled = asyncio.Event()

    async def script(connection):
        await connection.passed(1_234_567, way)
        connection.stall(way)
        stalled.set()

    async with proxy_with(script) as proxy:
        pair = await ends.pair(proxy)
        sender, receiver = pair.ends(way)
        sender.write(bytes(4 << 20))
        await receiver.take(1_234_567)
        await stalled.wait()
        assert await receiver.hears_nothing()
        assert pair.passed(way) == 1_234_567
        proxy.resume()
        await receiver.take((4 << 20) - 1_234_567)


@pytest.mark.parametrize("how", ["wait_for", "group", "task"])
async def test_it_is_exact_however_it_is_waited_for(ends, proxy_with, how):
    async def script(connection):
        if how == "wait_for":
            await asyncio.wait_for(connection.passed(9, "up"), PATIENCE)
        elif how == "group":
            async with asyncio.TaskGroup() as group:
                group.create_task(connection.passed(9, "up"))
                group.create_task(connection.passed(4, "up"))
        else:
            await asyncio.create_task(connection.passed(9, "up"))
        connection.cut()

    async with proxy_with(script) as proxy:
        client = await ends.client(proxy)
        client.write(LETTERS)
        assert await (await ends.server.end()).until_reset() == LETTERS[:9]


async def test_nothing_passes_before_the_first_step_of_a_script(ends, proxy_with):
    async with proxy_with(lambda connection: asyncio.sleep(0, connection.stall())) as proxy:
        pair = await ends.pair(proxy)
        pair.client.write(LETTERS)
        pair.server.write(LETTERS)
        assert await pair.client.hears_nothing()
        assert await pair.server.hears_nothing()
        assert (pair.passed("up"), pair.passed("down")) == (0, 0)


async def test_who_no_longer_waits_is_no_obstacle(pair):
    waiting = asyncio.create_task(pair.connection.passed(5, "up"))
    await asyncio.sleep(0)
    waiting.cancel()
    with pytest.raises(asyncio.CancelledError):
        await waiting
    pair.client.write(LETTERS)
    assert await pair.server.take(26) == LETTERS


@WAYS
async def test_waiting_ends_when_the_direction_does(pair, way):
    sender, _ = pair.ends(way)
    waiting = asyncio.create_task(pair.connection.passed(100, way))
    sender.write(LETTERS)
    sender.writer.write_eof()
    with pytest.raises(ConnectionError, match=r"ended after 26 bytes, and 100 were waited for"):
        await waiting
    assert pair.connection.is_open
    await pair.connection.passed(26, way)
    with pytest.raises(ConnectionError, match=r"ended after 26 bytes, and 27 were"):
        await pair.connection.passed(27, way)
    waiting = asyncio.create_task(pair.connection.passed(100, other(way)))
    await asyncio.sleep(0)
    pair.connection.cut()
    with pytest.raises(ConnectionError, match=r"ended after 0 bytes, and 100 were"):
        await waiting


async def test_every_connection_has_a_script(ends, proxy_with):
    seen = []

    async def script(connection):
        seen.append(connection.number)
        if connection.number == 1:
            await connection.passed(1, "up")
            connection.cut()

    async with proxy_with(script) as proxy:
        first = await ends.pair(proxy)
        second = await ends.pair(proxy)
        proxy.half_open()
        await ends.client(proxy)
        await proxy.wait_accepted(3)
        first.client.write(b"x")
        await first.server.until_reset()
        assert await second.is_whole()
    assert seen == [1, 2, 3]


# errors


async def fails(connection: FlakyConnection) -> None:
    raise LookupError(f"in script {connection.number}")


async def test_an_error_of_a_script_ends_the_block(ends, proxy_with):
    ended_by = None
    with pytest.raises(LookupError, match="in script 1"):
        async with proxy_with(fails) as proxy:
            await ends.client(proxy)
            try:
                await forever(None)
            except asyncio.CancelledError as error:
                ended_by = error
                raise
    assert ended_by is not None
    assert asyncio.current_task().cancelling() == 0
    with pytest.raises(ConnectionRefusedError):
        await ends.client(proxy)


async def test_an_error_where_the_block_is_being_left(ends, proxy_with):
    async def script(connection):
        try:
            await forever(connection)
        finally:
            await fails(connection)

    with pytest.raises(LookupError, match="in script 1"):
        async with proxy_with(script) as proxy:
            await ends.pair(proxy)


@pytest.mark.parametrize("leaving", [False, True])
async def test_several_errors_at_once(ends, proxy_with, leaving):
    fail = asyncio.Event()

    async def script(connection):
        await fail.wait()
        await fails(connection)

    with pytest.raises(ExceptionGroup, match=r"scripts of .* failed") as caught:
        async with proxy_with(script) as proxy:
            await ends.pair(proxy)
            await ends.pair(proxy)
            fail.set()
            # They fail while this turn of the loop waits: it is not told of that yet.
            await (asyncio.sleep(0) if leaving else forever(None))
    assert [str(error) for error in caught.value.exceptions] == ["in script 1", "in script 2"]


async def test_an_error_of_the_block_is_shown_with_that_of_the_script(ends, proxy_with):
    with pytest.raises(LookupError, match="in script") as caught:
        async with proxy_with(fails) as proxy:
            await ends.client(proxy)
            try:
                await forever(None)
            finally:
                raise ValueError("what came of it")
    assert isinstance(caught.value.__context__, ValueError)


async def test_an_error_of_the_block_alone_is_left_as_it_is(ends, proxy_with):
    with pytest.raises(ValueError, match="mine"):
        async with proxy_with(forever) as proxy:
            await ends.pair(proxy)
            raise ValueError("mine")


async def test_a_timeout_around_the_block_is_a_timeout(ends, proxy_with):
    with pytest.raises(TimeoutError):
        async with asyncio.timeout(0.02), proxy_with(forever) as proxy:
            await ends.pair(proxy)
            await forever(None)


@pytest.mark.parametrize("grouped", [False, True])
async def test_the_end_of_a_connection_is_no_error_of_its_script(ends, proxy_with, grouped):
    over = []

    async def script(connection):
        try:
            if not grouped:
                await connection.passed(100, "up")
            async with asyncio.TaskGroup() as group:
                group.create_task(connection.passed(100, "up"))
                group.create_task(connection.passed(100, "down"))
        finally:
            over.append(connection.number)

    async with proxy_with(script) as proxy:
        pair = await ends.pair(proxy)
        pair.client.reset()
        await pair.connection.wait_closed()
        assert await (await ends.pair(proxy)).is_whole()
    assert over == [1, 2]


async def test_another_connection_error_is_one(ends, proxy_with):
    async def script(connection):
        connection.cut()
        raise ConnectionResetError("of something else")

    with pytest.raises(ConnectionResetError, match="of something else"):
        async with proxy_with(script) as proxy:
            await ends.client(proxy)
            await forever(None)


async def test_scripts_end_with_the_proxy(ends, proxy_with):
    ended = []

    async def script(connection):
        try:
            await forever(connection)
        finally:
            ended.append(connection.number)

    async with proxy_with(script) as proxy:
        await ends.pair(proxy)
    assert ended == [1]
