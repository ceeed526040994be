"""A node in a thread, for programs that block."""

from __future__ import annotations

import asyncio
import collections
import concurrent.futures
import gc
import os
import queue
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import aioros1
from aioros1.contrib.threads import NodeThread
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

PATIENCE = 30.0
ROOT = Path(aioros1.__file__).parents[1]
pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture(params=["asyncio", "uvloop"])
def make(master_uri: str, request: pytest.FixtureRequest) -> Callable[..., NodeThread]:
    loop_factory = pytest.importorskip(request.param).new_event_loop

    def make(name: str = "threaded", **options: Any) -> NodeThread:
        options = {"master_uri": master_uri, "host": "localhost", "rosout": False} | options
        return NodeThread(name, loop_factory=loop_factory, **options)

    return make


@pytest.fixture
def ros(make: Callable[..., NodeThread]) -> Iterator[NodeThread]:
    with make() as ros:
        yield ros


def other_thread(function: Callable[..., Any], *args: Any) -> concurrent.futures.Future[Any]:
    """What ``function`` gives or raises, in a thread that begins now."""
    future: concurrent.futures.Future[Any] = concurrent.futures.Future()

    def run() -> None:
        try:
            future.set_result(function(*args))
        except BaseException as error:
            future.set_exception(error)

    threading.Thread(target=run, daemon=True).start()
    return future


class Forever:
    """An awaitable function that never ends, and says when it was begun and cancelled."""

    def __init__(self) -> None:
        self.began = threading.Event()
        self.cancelled = threading.Event()

    async def __call__(self) -> None:
        self.began.set()
        try:
            await asyncio.get_running_loop().create_future()
        finally:
            self.cancelled.set()


def chatter(ros: NodeThread, **options: Any) -> tuple[aioros1.Publisher, aioros1.Subscriber]:
    pub = ros.run(ros.node.advertise("chatter", String))
    sub = ros.run(ros.node.subscribe("chatter", String, **options))
    ros.run(pub.wait_for_subscribers(timeout=PATIENCE))
    return pub, sub


def test_topics_and_services(ros):
    pub, sub = chatter(ros)
    ros.call(pub.publish, data="one")
    ros.call(pub.publish, String(data="two"))
    assert ros.run(sub.get(timeout=PATIENCE)) == String(data="one")
    assert ros.call(sub.get, timeout=PATIENCE) == String(data="two")
    with pytest.raises(asyncio.QueueEmpty):
        ros.call(sub.get_nowait)

    ros.run(ros.node.advertise_service("flip", SetBool, lambda request: {"success": True}))
    reply = ros.submit(ros.node.call("flip", SetBool, data=True))
    assert reply.result(timeout=PATIENCE) == SetBool.Response(success=True)


def test_functions_are_called_in_the_thread_of_the_node(ros):
    thread = ros.call(threading.current_thread)
    assert thread is not threading.current_thread()
    assert thread.name == "node /threaded"
    assert ros.call(asyncio.sleep, 0, result="slept") == "slept"


def test_exceptions_are_raised_where_the_call_is(ros):
    async def fail():
        raise LookupError("what?")

    for way in (lambda: ros.run(fail()), lambda: ros.call(fail), ros.submit(fail()).result):
        with pytest.raises(LookupError, match=r"what\?"):
            way()
    with pytest.raises(KeyError):
        ros.run(ros.node.get_param("nothing"))
    with pytest.raises(SystemExit):
        ros.call(sys.exit, 3)
    assert ros.is_open


def test_iterating(ros):
    pub, sub = chatter(ros)
    for number in range(5):
        ros.call(pub.publish, data=str(number))
    received = []
    for message in ros.iterate(sub):
        received.append(message.data)
        if len(received) == 3:
            break
    # What was not taken is still there, and the subscriber is open.
    assert received == ["0", "1", "2"]
    assert next(ros.iterate(sub)).data == "3"
    ros.run(sub.close())
    assert list(ros.iterate(sub)) == []


def test_iterating_what_is_no_role(ros):
    async def count():
        for number in range(3):
            await asyncio.sleep(0)
            yield number
        raise LookupError("enough")

    received = []
    with pytest.raises(LookupError, match="enough"):
        for number in ros.iterate(count()):
            received.append(number)  # noqa: PERF402 - it is the loop that is tested
    assert received == [0, 1, 2]
    times = ros.iterate(ros.node.rate(1000))
    assert next(times) < next(times)


def test_delivering_to_a_queue_and_to_a_function(ros):
    pub, sub = chatter(ros)
    second = ros.run(ros.node.subscribe("chatter", String))
    messages: queue.SimpleQueue[String] = queue.SimpleQueue()
    latest: collections.deque[String] = collections.deque(maxlen=1)
    delivering = ros.deliver(sub, messages.put)
    ros.deliver(second, latest.append)
    ros.run(pub.wait_for_subscribers(1, timeout=PATIENCE))
    for number in range(3):
        ros.call(pub.publish, data=str(number))
    assert [messages.get(timeout=PATIENCE).data for _ in range(3)] == ["0", "1", "2"]

    # Stopped, it leaves messages to who else wants them.
    assert delivering.cancel()
    ros.call(lambda: None)
    ros.call(pub.publish, data="last")
    assert ros.run(sub.get(timeout=PATIENCE)).data == "last"
    assert messages.empty()
    deadline = time.monotonic() + PATIENCE
    while latest[0].data != "last":
        assert time.monotonic() < deadline
    # It ends with what it delivers.
    again = ros.deliver(sub, messages.put)
    ros.run(sub.close())
    assert again.result(timeout=PATIENCE) is None


def test_an_exception_in_a_function_that_gets_messages_closes_the_node(make):
    def burst(message):
        raise LookupError(message.data)

    with pytest.raises(LookupError, match="boom"), make() as ros:
        pub, sub = chatter(ros)
        ros.deliver(sub, burst)
        ros.call(pub.publish, data="boom")
        ros.run(Forever()())  # it is told by ClosedError, and the cause comes out
    assert "the callback" in str(ros.node.close_reason)


def test_an_exception_in_a_function_that_gets_messages_can_be_handled(make):
    errors: queue.SimpleQueue[Exception] = queue.SimpleQueue()
    with make(on_error=errors.put) as ros:
        pub, sub = chatter(ros)
        ros.deliver(sub, lambda message: {}[message.data])
        for key in ("one", "two"):
            ros.call(pub.publish, data=key)
            assert errors.get(timeout=PATIENCE).args == (key,)


def test_timeouts(ros):
    forever = Forever()
    with pytest.raises(TimeoutError, match=r"Forever.__call__ did not end within 0\.01 s"):
        ros.run(forever(), timeout=0.01)
    assert forever.cancelled.is_set()
    with pytest.raises(TimeoutError, match="no message on /silence within"):
        ros.run(ros.node.wait_for_message("silence", timeout=0.01), timeout=PATIENCE)


def test_cancelling_a_future_cancels_what_it_is_for(ros):
    forever = Forever()
    future = ros.submit(forever())
    assert forever.began.wait(PATIENCE)
    assert future.cancel()
    assert forever.cancelled.wait(PATIENCE)
    assert ros.is_open


def test_what_is_cancelled_inside_is_cancelled_outside(ros):
    async def cancel():
        raise asyncio.CancelledError

    with pytest.raises(concurrent.futures.CancelledError):
        ros.run(cancel())
    assert ros.is_open


def test_ctrl_c_ends_a_call_that_waits(ros):
    forever = Forever()

    def interrupt() -> None:
        forever.began.wait(PATIENCE)
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    interrupting = other_thread(interrupt)
    with pytest.raises(KeyboardInterrupt):
        ros.run(forever())
    assert forever.cancelled.wait(PATIENCE)
    interrupting.result(PATIENCE)
    assert ros.call(lambda: "well") == "well"


def test_closing_ends_iterations_and_calls_that_wait(make):
    ros = make().start()
    _, sub = chatter(ros)
    never = Forever()
    waiting = [
        other_thread(ros.run, ros.node.wait_for_message("silence")),
        other_thread(ros.run, never()),
        other_thread(ros.run, never(), 3600),
        ros.submit(never()),
        other_thread(ros.call, sub.get),
    ]
    iterating = other_thread(list, ros.iterate(ros.run(ros.node.subscribe("silence", String))))
    rate = ros.iterate(ros.node.rate(1000))
    next(rate)
    assert never.began.wait(PATIENCE)
    other_thread(ros.close).result(PATIENCE)
    for future in waiting:
        with pytest.raises(aioros1.ClosedError, match="/threaded is clos"):
            future.result(PATIENCE)
    assert iterating.result(PATIENCE) == []
    assert list(rate) == []
    assert not ros.is_open


def test_what_ends_well_when_the_node_is_closed_is_not_cancelled(make):
    async def collect(sub):
        received = [message.data async for message in sub]
        await asyncio.sleep(0.01)  # it may take some time
        return [*received, "the end"]

    ros = make().start()
    pub, sub = chatter(ros)
    collecting = ros.submit(collect(sub))
    ros.call(pub.publish, data="one")
    while sub.stats.messages < 1 or sub.queued:
        ros.call(lambda: None)
    ros.close()
    assert collecting.result(0) == ["one", "the end"]


def test_closing_twice_from_many_threads_and_inside(make):
    ros = make()
    ros.close()  # not started: there is nothing to close
    with ros:
        ros.call(ros.close)
        closing = [other_thread(ros.close) for _ in range(5)]
        for each in closing:
            each.result(PATIENCE)
        ros.close()
    assert ros.node.state == "closed"
    with pytest.raises(RuntimeError, match="started before"):
        ros.start()


def refuses(ros: NodeThread, why: str) -> None:
    never = Forever()
    for use in (
        lambda: ros.run(never()),
        lambda: ros.run(never(), timeout=PATIENCE),
        lambda: ros.call(never),
        lambda: ros.submit(never()),
        lambda: ros.submit(ros.node.advertise("chatter", String)),
        lambda: ros.deliver(ros.node.rate(1), print),
    ):
        with pytest.raises(aioros1.ClosedError, match=why):
            use()
    assert not never.began.is_set()
    gc.collect()  # a coroutine that was never awaited would be warned of


def test_nothing_is_accepted_before_and_after(make):
    ros = make()
    refuses(ros, "node /threaded is new, not open")
    with ros:
        pass
    refuses(ros, r"node /threaded is closed, not open \(closed\)")


def test_a_node_that_somebody_else_ends(make, master_uri):
    ros = make().start()
    waiting = other_thread(ros.run, ros.node.wait_closed())
    with make("killer") as killer:
        peer = killer.run(killer.node.peer("/threaded"))
        killer.run(peer.shutdown("enough"))
    assert "enough" in waiting.result(PATIENCE)
    with pytest.raises(aioros1.ClosedError, match="enough"):
        while True:
            ros.call(lambda: None)
    ros.close()


def test_waiting_for_itself_is_refused(ros):
    async def inside():
        with pytest.raises(RuntimeError, match="would wait for itself"):
            ros.run(asyncio.sleep(0))
        with pytest.raises(RuntimeError, match="would wait for itself"):
            next(ros.iterate(ros.node.rate(1)))
        return await asyncio.wrap_future(ros.submit(asyncio.sleep(0, "submitted")))

    assert ros.run(inside()) == "submitted"


def test_what_cannot_be_awaited_is_refused(ros):
    with pytest.raises(TypeError, match="expected an awaitable, got 5"):
        ros.run(5)


def test_what_the_node_cannot_start_with_is_raised(make, master_uri):
    with pytest.raises(aioros1.InvalidNameError):
        make("no spaces")
    port = int(master_uri.rstrip("/").rsplit(":", 1)[1])
    threads = threading.enumerate()
    with pytest.raises(OSError, match="in use"):
        make(xmlrpc_port=port).start()
    assert threading.enumerate() == threads


def test_it_leaves_nothing_behind(make):
    threads = threading.enumerate()
    for _ in range(3):
        with make() as ros:
            _, sub = chatter(ros)
            ros.deliver(sub, print)
        assert threading.enumerate() == threads
    assert ros.node.roles == ()


def test_many_threads_at_a_time(ros):
    pub, sub = chatter(ros, queue_size=1000)

    def publish(number: int) -> None:
        for each in range(50):
            ros.call(pub.publish, data=f"{number} {each}")
            ros.run(pub.drain())

    publishing = [other_thread(publish, number) for number in range(4)]
    received = collections.defaultdict(list)
    for _ in range(200):
        number, each = next(ros.iterate(sub)).data.split()
        received[number].append(int(each))
    assert received == {str(number): list(range(50)) for number in range(4)}
    for each in publishing:
        each.result(PATIENCE)


def test_closing_while_others_submit(make):
    """Whatever was accepted comes to an end; nobody waits for ever."""
    ros = make().start()

    def submit() -> int:
        count = 0
        try:
            while True:
                ros.run(asyncio.sleep(0))
                count += 1
        except aioros1.ClosedError:
            return count

    submitting = [other_thread(submit) for _ in range(4)]
    ros.call(asyncio.sleep, 0.01)
    ros.close()
    assert all(each.result(PATIENCE) >= 0 for each in submitting)


def run_program(program: str, uri: str, *options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-W", "error", *options, "-X", "dev", "-c", program],
        env={"PYTHONPATH": str(ROOT), "ROS_MASTER_URI": uri},
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
    )


def test_a_program_that_forgets_to_close_it_does_so_on_its_way_out(master_uri):
    program = textwrap.dedent(
        """
        from aioros1.contrib.threads import NodeThread
        ros = NodeThread("forgetful").start()
        ros.run(ros.node.advertise("chatter", "std_msgs/String"))
        """
    )
    result = run_program(program, master_uri)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    with NodeThread("watch", master_uri=master_uri, rosout=False) as ros:
        assert "/chatter" not in ros.run(ros.node.graph.snapshot()).topics


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs os.fork")
def test_a_process_that_was_forked_is_told_that_it_has_no_node(master_uri):
    program = textwrap.dedent(
        """
        import asyncio, os, sys
        import aioros1
        from aioros1.contrib.threads import NodeThread

        with NodeThread("parent", rosout=False) as ros:
            ros.run(ros.node.advertise("chatter", "std_msgs/String"))
            ros._lock.acquire()  # as a thread may that is just submitting something
            pid = os.fork()
            if not pid:
                assert not ros.is_open
                for use in (
                    lambda: ros.run(asyncio.sleep(0)),
                    lambda: ros.call(print),
                    lambda: next(ros.iterate(ros.node.rate(1))),
                ):
                    try:
                        use()
                    except aioros1.ClosedError as error:
                        print(error)
                ros.close()
                with NodeThread("child", rosout=False) as own:
                    print(own.run(own.node.has_param("/run_id")))
                sys.exit(3)
            ros._lock.release()
            assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 3
            print(sorted(ros.run(ros.node.graph.snapshot()).nodes))
        """
    )
    result = run_program(program, master_uri, "-W", "ignore:.*fork:DeprecationWarning")
    told = "node /parent is in the process that this one was forked from; make a new one here"
    assert result.stdout.splitlines() == [told, told, told, "True", "['/parent']"]
    assert (result.returncode, result.stderr) == (0, "")
