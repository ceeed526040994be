"""What is kept for each event loop: not shared, not outliving it, and not for other threads."""

from __future__ import annotations

import asyncio
import gc
import threading
import weakref
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

import pytest

from aioros1.connection import ConnectionInfo
from aioros1.net.loop_state import LoopState, loop_state
from aioros1.net.tcpros import connect, connection_info, take_over
from aioros1.net.topic_links import IncomingLink, Received
from aioros1.options import Timeouts
from aioros1.wire.frames import frame_parts
from aioros1.wire.handshake import TopicOffer

MakeLoop = Callable[[], asyncio.AbstractEventLoop]


@pytest.fixture(params=["asyncio", "uvloop"])
def make_loop(request: pytest.FixtureRequest) -> MakeLoop:
    made: MakeLoop = pytest.importorskip(request.param).new_event_loop
    return made


async def state_of_this_loop() -> LoopState:
    return loop_state()


def run(loop: asyncio.AbstractEventLoop) -> LoopState:
    return loop.run_until_complete(state_of_this_loop())


# one for each loop


async def test_it_is_one_object_for_all_in_a_loop() -> None:
    state = loop_state()
    assert await asyncio.create_task(state_of_this_loop()) is state
    assert state.receive_buffer is state.receive_buffer
    assert state.loop is asyncio.get_running_loop()


def test_there_is_none_without_a_loop() -> None:
    with pytest.raises(RuntimeError, match="no running event loop"):
        loop_state()


def test_a_new_loop_has_a_new_state(make_loop: MakeLoop) -> None:
    tokens = set()
    for _ in range(20):  # their memory, and so their id(), is used again
        loop = make_loop()
        tokens.add(run(loop).token)
        loop.close()
        del loop
        gc.collect(0)
    assert len(tokens) == 20


def test_everything_goes_with_the_loop(make_loop: MakeLoop) -> None:
    class Listener:
        def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
            self.loop = loop

    async def use() -> list[weakref.ref[Any]]:
        state = loop_state()
        listener: Any = Listener(state.loop)
        state.listeners["key"] = listener
        state.coalescer.collect()
        state.coalescer.call_at_end(partial(id, listener))
        return [weakref.ref(each) for each in (state, state.receive_buffer, listener)]

    loop = make_loop()
    left = loop.run_until_complete(use())  # the end of the iteration never comes
    loop.close()
    left.append(weakref.ref(loop))
    del loop
    gc.collect()
    assert [each() for each in left] == [None] * 4


MESSAGES, SIZE, BURST = 4000, 3000, 80


async def send_and_receive(letter: bytes) -> tuple[int, set[bytes]]:
    """Messages full of ``letter`` over a connection; how many came, and all bytes in them."""
    count = 0
    seen: set[bytes] = set()
    done = asyncio.Event()

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        frame = frame_parts(letter * SIZE, join=1 << 20)
        assert isinstance(frame, bytes)
        for _ in range(0, MESSAGES, BURST):
            writer.write(frame * BURST)
            await writer.drain()
        await done.wait()
        writer.close()

    def deliver(frames: list[Received]) -> None:
        nonlocal count
        count += len(frames)
        for batch, start, stop in frames:
            body = bytes(batch.data[start:stop])
            if body.strip(letter):
                seen.update(body[i : i + 1] for i in range(len(body)))
        if count >= MESSAGES:
            done.set()

    server = await asyncio.start_server(serve, "127.0.0.1", 0)
    async with server:
        port = server.sockets[0].getsockname()[1]
        stream = await connect("127.0.0.1", port, Timeouts())
        info: ConnectionInfo = connection_info(stream, "/chatter", "i", "/x", {})
        link = IncomingLink(
            stream,
            info,
            TopicOffer("/chatter", "std_msgs/String", "*", "", False),
            deliver,
            done.set,
            lambda: 0,
            loop_state().receive_buffer,
            max_bytes=1 << 20,
        )
        rest = await take_over(stream, link)
        if rest:
            link.block_received(rest)
        await done.wait()
        link.abort()
    return count, seen


def test_loops_in_two_threads_do_not_mix_what_they_receive(make_loop: MakeLoop) -> None:
    both = threading.Barrier(2)

    def live(letter: bytes) -> tuple[int, set[bytes]]:
        with asyncio.Runner(loop_factory=make_loop) as runner:
            both.wait(30)
            return runner.run(send_and_receive(letter))

    with ThreadPoolExecutor(2) as pool:
        results = list(pool.map(live, (b"a", b"b"), timeout=60))
    assert results == [(MESSAGES, set())] * 2


# whose thread


def in_thread(name: str, function: Callable[[], object]) -> BaseException | None:
    """What ``function`` raises in a thread of its own."""
    errors: list[BaseException | None] = []

    def call() -> None:
        try:
            function()
        except BaseException as error:
            errors.append(error)
        else:
            errors.append(None)

    thread = threading.Thread(target=call, name=name)
    thread.start()
    thread.join()
    return errors[0]


async def test_another_thread_is_told_what_to_do() -> None:
    state = loop_state()
    state.check_thread("publish()")
    error = in_thread("worker", lambda: state.check_thread("publish()"))
    assert isinstance(error, RuntimeError)
    assert str(error) == (
        "publish() was called in thread 'worker', but belongs to the event loop in thread "
        "'MainThread': use loop.call_soon_threadsafe(...) there, or NodeThread.call"
    )


async def test_a_thread_with_a_loop_of_its_own_is_another_thread() -> None:
    state = loop_state()

    async def check() -> None:
        state.check_thread("publish()")

    error = in_thread("worker", lambda: asyncio.run(check()))
    assert isinstance(error, RuntimeError)


def test_a_loop_may_go_on_in_another_thread(make_loop: MakeLoop) -> None:
    loop = make_loop()
    state = run(loop)
    state.check_thread("while nobody runs the loop")

    async def live() -> None:
        state.check_thread("where the loop runs now")
        await asyncio.to_thread(lambda: entered.set() or leave.wait(30))

    entered, leave = threading.Event(), threading.Event()
    thread = threading.Thread(target=loop.run_until_complete, args=(live(),), name="second")
    thread.start()
    try:
        assert entered.wait(30)
        with pytest.raises(RuntimeError, match="belongs to the event loop in"):
            state.check_thread("where it ran before")
    finally:
        leave.set()
        thread.join()
        loop.close()


def test_a_loop_whose_thread_has_ended_belongs_to_no_other() -> None:
    loop = asyncio.new_event_loop()
    with ThreadPoolExecutor(1) as pool:
        state = pool.submit(run, loop).result(30)
    with pytest.raises(RuntimeError, match=r"the event loop in thread '\d+ \(ended\)'"):
        state.check_thread("publish()")
    loop.close()
