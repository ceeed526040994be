"""How programs of ``aioros1.run`` end: by signals, by the graph, and by what they do themselves.

Each program drives a robot: it publishes "drive", and has to publish "stop" at its end.
"""

from __future__ import annotations

import asyncio
import signal
import subprocess
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

import aioros1

ROOT = Path(__file__).parent.parent
PATIENCE = 60

pytestmark = pytest.mark.asyncio(loop_factories=["asyncio"])

# Where programs differ is below: what main does, and functions that it uses.
PROGRAM = """
import asyncio, sys
import aioros1

{functions}

async def main(node):
    pub = await node.advertise("cmd", "std_msgs/String", queue_size=100)
    sub = await node.subscribe("cmd", "std_msgs/String", {callback}, queue_size=100_000)
    service = await node.advertise_service("service", "std_srvs/Empty", {handler})
    await pub.wait_for_subscribers(2)
    pub.publish(data="drive")
    print("ready", flush=True)
    {body}

print("ended", aioros1.run(main, "robot", loop_factory={loop}, timeouts={timeouts}), flush=True)
"""
UVLOOP = "__import__('uvloop').new_event_loop"


class Program:
    """A process that runs a program, and what it told a listener to do."""

    def __init__(
        self, process: asyncio.subprocess.Process, sub: aioros1.Subscriber, heard: list[str]
    ) -> None:
        self.process = process
        self.heard = heard
        self._sub = sub

    async def ready(self) -> None:
        assert self.process.stdout is not None
        async with asyncio.timeout(PATIENCE):
            assert await self.process.stdout.readline() == b"ready\n", await self.ended()

    async def says(self) -> str:
        assert self.process.stdout is not None
        async with asyncio.timeout(PATIENCE):
            return (await self.process.stdout.readline()).decode().strip()

    async def ended(self) -> tuple[int | None, str, str]:
        """Its exit status, and the rest of what it wrote. It is not in the graph any more."""
        async with asyncio.timeout(PATIENCE):
            output, errors = await self.process.communicate()
            assert "/robot" not in (await self._sub.node.graph.snapshot()).nodes
            while self._sub.connections:
                await asyncio.sleep(0.01)
        return self.process.returncode, output.decode(), errors.decode()


class Programs:
    """Starts programs."""

    def __init__(self, master: aioros1.Master, node: aioros1.Node) -> None:
        self.node = node
        self.sub: aioros1.Subscriber
        self._uri = master.uri
        self._heard: list[str] = []
        self._started: list[asyncio.subprocess.Process] = []

    def hear(self, message: object) -> None:
        self._heard.append(message.data)  # type: ignore[attr-defined]

    async def start(
        self,
        body: str,
        functions: str = "",
        *,
        callback: str = "None",
        handler: str = "lambda request: None",
        loop: str = "None",
        timeouts: str = "aioros1.Timeouts(close=30)",
        stdin: int = asyncio.subprocess.DEVNULL,
    ) -> Program:
        code = PROGRAM.format(
            body=body.strip().replace("\n", "\n    "),
            functions=functions,
            callback=callback,
            handler=handler,
            loop=loop,
            timeouts=timeouts,
        )
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-W", "error", "-c", code),
            env={"ROS_MASTER_URI": self._uri, "PYTHONPATH": str(ROOT), "PATH": ""},
            stdin=stdin,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.PIPE,
        )
        self._started.append(process)
        return Program(process, self.sub, self._heard)

    def end(self) -> None:
        for process in self._started:
            if process.returncode is None:
                process.kill()


@pytest.fixture
async def programs(master: aioros1.Master) -> AsyncIterator[Programs]:
    async with aioros1.Node("listener", master_uri=master.uri, host="localhost") as node:
        made = Programs(master, node)
        made.sub = await node.subscribe("cmd", "std_msgs/String", made.hear)
        try:
            yield made
        finally:
            made.end()


async def end_by(how: str, program: Program, programs: Programs) -> None:
    if how in ("SIGINT", "SIGTERM"):
        program.process.send_signal(getattr(signal, how))
    elif how == "kill":
        await (await programs.node.peer("/robot")).shutdown("user request")
    elif how == "second node":
        async with aioros1.Node(
            "robot", master_uri=programs.node.master_uri, host="localhost", rosout=False
        ) as second:
            await second.advertise("other", "std_msgs/String")
            # It unregisters whatever has its name, so it stays until the first has ended.
            await program.process.wait()


REASONS = {
    "SIGINT": "",
    "SIGTERM": "",
    "kill": "/robot was shut down: [/listener] user request\n",
    "second node": (
        "/robot was shut down: [/master] [/robot] Reason: new node registered with same name\n"
    ),
}

DRIVING = """
try:
    while True:
        pub.publish(data="drive")
        await asyncio.sleep(0.001)
finally:
    pub.publish(data="stop")
"""

CLEANING_UP = """
try:
    await asyncio.Event().wait()
finally:
    await node.call("service", "std_srvs/Empty")
    await node.set_param("last", "here")
    await node.sleep(0.001)
    await pub.send(data="stop")
    await pub.drain()
"""

IN_A_GROUP = """
async def drive():
    try:
        async for now in node.rate(1000):
            pub.publish(data="drive")
        print("its loop has ended")
    finally:
        await asyncio.sleep(0.001)
        pub.publish(data="stop")
        await pub.close()
        pub.publish(data="never")  # a ClosedError, in a group

async def listen():
    async for message in sub:
        pass
    print("its loop has ended")

async with asyncio.TaskGroup() as group:
    group.create_task(drive())
    group.create_task(listen())
    async with asyncio.TaskGroup() as inner:
        inner.create_task(node.sleep(3600))
        inner.create_task(node.wait_for_service("nowhere"))
"""

BY_TIMERS = """
node.timer(0.001, lambda now: pub.publish(data="drive"))
pub.publish_every(0.001, data="drive")

@node.on_shutdown
async def stop():
    await asyncio.sleep(0.01)
    pub.publish(data="stop")

async for message in sub:
    pass
print("its loop has ended")
"""

IN_A_TASK = """
async def drive():
    try:
        while True:
            pub.publish(data="drive")
            await asyncio.sleep(0.001)
    finally:
        await asyncio.sleep(0.01)
        pub.publish(data="stop")

node.create_task(drive())
await node.wait_closed()
"""

IN_A_TASK_OF_ITS_OWN = """
async def drive():
    try:
        while True:
            pub.publish(data="drive")
            await asyncio.sleep(0.001)
    finally:
        await asyncio.sleep(0.01)
        pub.publish(data="stop")
        await pub.close()
        pub.publish(data="never")  # a ClosedError that nobody retrieves

task = asyncio.create_task(drive())
await asyncio.Event().wait()
"""

BEHIND_THE_BACK = """
async def drive():
    while True:
        pub.publish(data="drive")
        await asyncio.sleep(0.001)

@node.on_shutdown
async def stop():
    pub.publish(data="stop")
    await asyncio.sleep(0.05)

task = asyncio.create_task(drive())
await asyncio.Event().wait()
"""


BODIES = {
    "driving": DRIVING,
    "cleaning up": CLEANING_UP,
    "in a group": IN_A_GROUP,
    "by timers": BY_TIMERS,
    "in a task": IN_A_TASK,
    "in a task of its own": IN_A_TASK_OF_ITS_OWN,
    "behind the back": BEHIND_THE_BACK,
}


@pytest.mark.parametrize("how", ["SIGINT", "kill"])
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES.keys())
async def test_main_is_cancelled_while_its_roles_are_open(programs, how, body):
    program = await programs.start(body)
    await program.ready()
    await end_by(how, program, programs)
    assert await program.ended() == (0, "ended None\n", REASONS[how])
    assert program.heard[-1] == "stop"


@pytest.mark.parametrize("how", ["SIGTERM", "second node"])
async def test_whoever_ends_the_node_main_is_cancelled(programs, how):
    """Subscribers may already have left a node that another one replaces."""
    program = await programs.start(DRIVING + "    print(pub.is_open)")
    await program.ready()
    await end_by(how, program, programs)
    assert await program.ended() == (0, "True\nended None\n", REASONS[how])


async def test_a_task_that_main_leaves_behind_ends_while_roles_are_open(programs):
    program = await programs.start(
        IN_A_TASK_OF_ITS_OWN.replace("asyncio.Event().wait()", "asyncio.sleep(0.1)\nreturn 5")
    )
    assert await program.ended() == (0, "ready\nended 5\n", "")
    assert program.heard[-1] == "stop"


@pytest.mark.parametrize("start", ["asyncio.create_task", "node.create_task"])
async def test_a_task_that_does_not_end_does_not_keep_the_program(programs, start):
    program = await programs.start(
        "async def go_on():\n    while True:\n        try:\n            await asyncio.sleep(3600)\n"
        "        except asyncio.CancelledError:\n            pass\n"
        f"task = {start}(go_on(), name='endless')\n"
        "try:\n    await asyncio.sleep(3600)\nfinally:\n    pub.publish(data='stop')",
        timeouts="aioros1.Timeouts(close=0.5)",
    )
    await program.ready()
    await end_by("SIGINT", program, programs)
    status, _, errors = await program.ended()
    assert status == 1
    assert "endless goes on although it was cancelled: left behind" in errors
    assert program.heard[-1] == "stop"


async def test_what_fails_in_a_task_that_is_left_behind_is_shown(programs):
    program = await programs.start(
        "async def fail():\n    try:\n        await asyncio.sleep(3600)\n"
        "    finally:\n        raise ValueError('mine')\n"
        "task = asyncio.create_task(fail(), name='failing')\nawait asyncio.sleep(0)"
    )
    status, _, errors = await program.ended()
    assert status == 0
    assert errors.count("ValueError: mine") == 1
    assert "failing failed while it ended" in errors


async def test_a_thread_that_does_not_end_is_named_after_the_reason(programs):
    """Python waits for it, and nothing can interrupt it."""
    program = await programs.start(
        "try:\n    await asyncio.to_thread(sys.stdin.readline)\n"
        "finally:\n    pub.publish(data='stop')",
        stdin=asyncio.subprocess.PIPE,
    )
    await program.ready()
    await end_by("kill", program, programs)
    assert program.process.stderr is not None
    async with asyncio.timeout(PATIENCE):
        assert (await program.process.stderr.readline()).decode() == REASONS["kill"]
        line = (await program.process.stderr.readline()).decode()
    assert line == "/robot is closed; the program waits for its threads: asyncio_0\n"
    assert program.process.stdin is not None
    program.process.stdin.close()
    assert await program.ended() == (0, "ended None\n", "")
    assert program.heard[-1] == "stop"


async def test_a_forked_process_can_be_terminated(programs):
    program = await programs.start(
        # Python forgets a signal that comes while it forks, so the child says that it is there.
        "import multiprocessing, time\n"
        "context = multiprocessing.get_context('fork')\n"
        "ours, theirs = context.Pipe()\n"
        "def work():\n    theirs.send('ready')\n    time.sleep(3600)\n"
        "process = context.Process(target=work)\n"
        "process.start()\nours.recv()\nprocess.terminate()\n"
        "await asyncio.to_thread(process.join)\n"
        "pub.publish(data='stop')\nreturn process.exitcode"
    )
    assert await program.ended() == (0, "ready\nended -15\n", "")
    assert program.heard[-1] == "stop"


async def test_a_main_that_goes_on_for_a_while_returns_its_result(programs):
    program = await programs.start(
        "try:\n    await asyncio.sleep(3600)\n"
        "except asyncio.CancelledError:\n    await pub.send(data='stop')\nreturn 5"
    )
    await program.ready()
    await end_by("SIGINT", program, programs)
    assert await program.ended() == (0, "ended 5\n", "")
    assert program.heard[-1] == "stop"


@pytest.mark.parametrize("how", ["SIGINT", "kill"])
async def test_a_main_that_does_not_end_does_not_keep_the_program(programs, how):
    program = await programs.start(
        "while True:\n    try:\n        await asyncio.sleep(1)\n"
        "    except asyncio.CancelledError:\n"
        "        if node.is_open:\n            pub.publish(data='stop')",
        timeouts="aioros1.Timeouts(close=0.1)",
    )
    await program.ready()
    await end_by(how, program, programs)
    status, _, errors = await program.ended()
    assert status == 1
    assert "goes on although it was cancelled" in errors
    assert "Traceback" not in errors
    assert program.heard[-1] == "stop"


async def test_a_second_signal_ends_the_time_for_cleaning_up(programs):
    program = await programs.start(
        "node.on_shutdown(lambda: pub.publish(data='stop'))\n"
        "try:\n    await asyncio.sleep(3600)\n"
        "finally:\n    print('cleaning up', flush=True)\n    await asyncio.sleep(3600)",
        timeouts="aioros1.Timeouts(close=3600)",
    )
    await program.ready()
    await end_by("SIGINT", program, programs)
    assert await program.says() == "cleaning up"
    await end_by("SIGINT", program, programs)
    status, output, errors = await program.ended()
    assert (status, output) == (0, "ended None\n")
    assert "has not ended in time: main" in errors
    assert program.heard[-1] == "stop"


@pytest.mark.parametrize("loop", ["None", UVLOOP], ids=["asyncio", "uvloop"])
async def test_signals_end_a_main_that_blocks_the_event_loop(programs, loop):
    if loop == UVLOOP:
        pytest.importorskip("uvloop")
    program = await programs.start(
        "import time\ntry:\n    while True:\n        time.sleep(0.01)\n"
        "finally:\n    pub.publish(data='stop')",
        loop=loop,
    )
    await program.ready()
    while program.process.returncode is None:
        await end_by("SIGINT", program, programs)
        await asyncio.wait({asyncio.create_task(program.process.wait())}, timeout=0.3)
    _, _, errors = await program.ended()
    assert errors.rstrip().endswith("KeyboardInterrupt")
    assert program.heard[-1] == "stop"


# what main raises

RAISING = {
    "at once": "raise ValueError('mine')",
    "in a group": (
        "async def fail(): raise ValueError('mine')\n"
        "async with asyncio.TaskGroup() as group:\n"
        "    group.create_task(fail())\n    group.create_task(node.sleep(3600))"
    ),
    "in a timer": (
        "def fail(now): raise ValueError('mine')\n"
        "node.timer(0.001, fail)\n"
        "await asyncio.sleep(3600)"
    ),
}


@pytest.mark.parametrize("body", RAISING.values(), ids=RAISING.keys())
async def test_an_exception_is_shown_after_everything_is_closed(programs, body):
    body = "try:\n    " + body.replace("\n", "\n    ") + "\nfinally:\n    pub.publish(data='stop')"
    program = await programs.start(body)
    status, output, errors = await program.ended()
    assert (status, output) == (1, "ready\n")
    assert errors.count("ValueError: mine") == 1
    assert program.heard[-1] == "stop"


async def test_an_exception_while_main_ends_is_shown(programs):
    """Without those of closed roles, which are no news."""
    program = await programs.start(
        "async def fail():\n    try:\n        await asyncio.sleep(3600)\n"
        "    finally:\n        raise ValueError('mine')\n"
        "async def close():\n    try:\n        await asyncio.sleep(3600)\n"
        "    finally:\n        await pub.close()\n        pub.publish(data='never')\n"
        "async with asyncio.TaskGroup() as group:\n"
        "    group.create_task(fail())\n    group.create_task(close())"
    )
    await program.ready()
    await end_by("SIGINT", program, programs)
    status, _, errors = await program.ended()
    assert status == 1
    assert errors.count("ValueError: mine") == 1
    assert "ClosedError" not in errors


async def test_a_closed_role_is_an_error_while_nobody_ends_the_node(programs):
    program = await programs.start("await pub.close()\npub.publish(data='never')")
    status, _, errors = await program.ended()
    assert status == 1
    assert "ClosedError: publisher /cmd" in errors


async def test_a_cancellation_that_nobody_asked_for_is_an_error(programs):
    program = await programs.start(
        "other = asyncio.create_task(asyncio.sleep(3600))\nother.cancel()\nawait other"
    )
    status, _, errors = await program.ended()
    assert status == 1
    assert errors.rstrip().endswith("CancelledError")


# sys.exit

EXIT = "def leave(*args): sys.exit(7)\nasync def leave_later(*args): sys.exit(7)"
GROUP = """
async with asyncio.TaskGroup() as group:
    group.create_task(leave_later())
    group.create_task(asyncio.sleep(3600))
"""
CALL = "await node.call('service', 'std_srvs/Empty')"
EXITS: dict[str, tuple[str, dict[str, str]]] = {
    "main": ("sys.exit(7)", {}),
    "group": (GROUP, {}),
    "task": ("node.create_task(leave_later())", {}),
    "timer": ("node.timer(0.001, leave)", {}),
    "async timer": ("node.timer(0.001, leave_later)", {}),
    "callback": ("", {"callback": "leave"}),
    "async callback": ("", {"callback": "leave_later"}),
    "handler": (CALL, {"handler": "leave"}),
    "async handler": (CALL, {"handler": "leave_later"}),
    "on_shutdown": ("node.on_shutdown(leave)\nnode.on_shutdown(leave_later)\nreturn", {}),
}


@pytest.mark.parametrize("loop", ["None", UVLOOP], ids=["asyncio", "uvloop"])
@pytest.mark.parametrize("where", EXITS)
async def test_the_program_exits_as_it_says_after_everything_is_closed(programs, where, loop):
    if loop == UVLOOP:
        pytest.importorskip("uvloop")
    body, options = EXITS[where]
    body += "\nawait asyncio.sleep(3600)"
    program = await programs.start(body, EXIT, loop=loop, **options)
    assert await program.ended() == (7, "ready\n", "")


async def test_a_text_for_sys_exit_is_written(programs):
    program = await programs.start("sys.exit('no robot')")
    assert await program.ended() == (1, "ready\n", "no robot\n")


# main closes the node itself


async def test_a_main_that_closes_its_node_goes_on(programs):
    program = await programs.start("await node.close()\nreturn node.state")
    assert await program.ended() == (0, "ready\nended closed\n", "")


async def test_a_main_that_waits_while_another_task_closes_the_node_is_cancelled(programs):
    program = await programs.start(
        "closing = asyncio.create_task(node.close())\n"
        "try:\n    await asyncio.Event().wait()\nfinally:\n    await pub.send(data='stop')"
    )
    assert await program.ended() == (0, "ready\nended None\n", "")
    assert program.heard[-1] == "stop"


async def test_a_main_that_closes_its_node_while_it_ends_does_not_wait_for_itself(programs):
    program = await programs.start(
        "try:\n    await asyncio.sleep(3600)\nfinally:\n"
        "    await pub.send(data='stop')\n    await asyncio.gather(node.close())",
        timeouts="aioros1.Timeouts(close=3600)",
    )
    await program.ready()
    await end_by("SIGTERM", program, programs)
    assert await program.ended() == (0, "ended None\n", "")
    assert program.heard[-1] == "stop"


# where it cannot be used


def run_python(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        env={"PYTHONPATH": str(ROOT), "PATH": ""},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )


async def test_it_refuses_a_running_loop_and_other_threads():
    async def main(node: aioros1.Node) -> None:
        raise AssertionError

    with pytest.raises(RuntimeError, match=r"starts an event loop, but one is running here"):
        aioros1.run(main)
    with pytest.raises(RuntimeError, match=r"in the main thread: in another one, use .*NodeThread"):
        await asyncio.to_thread(aioros1.run, main)


@pytest.mark.parametrize("main", ["main(None)", "None"])
async def test_it_refuses_what_is_no_coroutine_function(main):
    code = f"import aioros1\nasync def main(node): pass\naioros1.run({main})"
    result = await asyncio.to_thread(run_python, code)
    assert result.returncode == 1
    assert "TypeError: run() takes a coroutine function, `main` and not `main()`" in result.stderr


async def test_it_restores_the_handlers_of_signals(master):
    code = (
        "import aioros1, signal\n"
        "def mine(*args): pass\n"
        "signal.signal(signal.SIGTERM, mine)\n"
        "async def main(node): pass\n"
        f"aioros1.run(main, 'robot', master_uri={master.uri!r})\n"
        "assert signal.getsignal(signal.SIGTERM) is mine\n"
        "assert signal.getsignal(signal.SIGINT) is signal.default_int_handler\n"
    )
    assert (await asyncio.to_thread(run_python, code)).stderr == ""
