"""The programs in ``examples``, as they are started: processes that meet at a master."""

from __future__ import annotations

import asyncio
import contextlib
import os
import shutil
import signal
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import aiohttp
import pytest

import aioros1
from aioros1.net.hosts import bind_sockets

ROOT = Path(aioros1.__file__).parents[1]
EXAMPLES = ROOT / "examples"
PATIENCE = 20.0

# What a process does, does not depend on the loop of the test that watches it.
pytestmark = [
    pytest.mark.asyncio(loop_factories=["asyncio"]),
    pytest.mark.skipif(os.name != "posix", reason="ends programs by signals"),
]
TESTS = Path(__file__).read_text(encoding="utf-8")


class Program:
    """A process, and what it has printed."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self.process = process
        self.lines: list[str] = []
        self.errors = ""
        self._news = asyncio.Condition()
        self._reading = asyncio.gather(self._read_lines(), self._read_errors())

    @property
    def text(self) -> str:
        return "\n".join(self.lines)

    async def says(self, text: str) -> str:
        """The first line with ``text`` in it, once it is there."""

        def found() -> str | None:
            return next((line for line in self.lines if text in line), None)

        try:
            async with asyncio.timeout(PATIENCE), self._news:
                await self._news.wait_for(lambda: found() or self._reading.done())
        except TimeoutError:
            pass
        line = found()
        assert line is not None, f"no line with {text!r}; output: {self.text}\n{self.errors}"
        return line

    async def ends(self) -> int:
        """Its exit code, when everything it printed was read."""
        async with asyncio.timeout(PATIENCE):
            await self._reading
            return await self.process.wait()

    async def end(self, number: signal.Signals) -> int:
        self.process.send_signal(number)
        return await self.ends()

    async def _read_lines(self) -> None:
        assert self.process.stdout is not None
        async for line in self.process.stdout:
            self.lines.append(line.decode().rstrip("\n"))
            async with self._news:
                self._news.notify_all()
        async with self._news:
            self._news.notify_all()

    async def _read_errors(self) -> None:
        assert self.process.stderr is not None
        self.errors = (await self.process.stderr.read()).decode()


@contextlib.asynccontextmanager
async def example(
    name: str, *words: str, uri: str = "", folder: Path = EXAMPLES
) -> AsyncIterator[Program]:
    environ = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
    environ |= {"PYTHONPATH": str(ROOT), "PYTHONUNBUFFERED": "1", "ROS_MASTER_URI": uri}
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-W", "error", str(folder / f"{name}.py"), *words,
        env=environ, stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    program = Program(process)
    try:
        yield program
    finally:
        if process.returncode is None:
            process.kill()
        await program.ends()


async def test_talker(master, make_node):
    node = await make_node("tester")
    async with (
        node.subscribe("greetings", "std_msgs/String") as sub,
        example("talker", "_rate:=50", "chatter:=greetings", uri=master.uri) as talker,
    ):
        first = await sub.get(timeout=PATIENCE)
        second = await sub.get(timeout=PATIENCE)
        assert first.data.startswith("hello world ")
        assert int(second.data.split()[-1]) == int(first.data.split()[-1]) + 1
        assert await talker.end(signal.SIGINT) == 0
        assert second.data in talker.lines
        assert talker.errors == ""


async def test_talker_without_a_master():
    async with example("talker", uri="http://localhost:1") as talker:
        assert await talker.ends() == 1
        assert "MasterUnreachable" in talker.errors
        assert "localhost:1" in talker.errors


async def test_listener(master, make_node):
    node = await make_node("tester")
    async with (
        node.advertise("chatter", "std_msgs/String") as pub,
        example("listener", uri=master.uri) as listener,
    ):
        await pub.wait_for_subscribers(timeout=PATIENCE)
        pub.publish(data="good morning")
        assert await listener.says("good morning") == "/tester says: good morning"
        assert await listener.end(signal.SIGTERM) == 0
        assert listener.errors == ""


async def test_add_two_ints_server(master, make_node):
    node = await make_node("tester")
    async with example("add_two_ints_server", "__name:=adder", uri=master.uri) as server:
        await server.says("ready: /add_two_ints")
        answer = await node.call("add_two_ints", "roscpp_tutorials/TwoInts", a=2**40, b=-1)
        assert answer.sum == 2**40 - 1
        await (await node.peer("/adder")).shutdown("enough")
        assert await server.ends() == 0
        assert server.lines[1:] == [f"{2**40} + -1 = {2**40 - 1}"]
        assert server.errors == ""


async def test_add_two_ints_client(master, make_node):
    node = await make_node("tester")
    service = node.advertise_service(
        "sum", "roscpp_tutorials/TwoInts", lambda request: {"sum": request.a + request.b}
    )
    words = ("20", "-3", "add_two_ints:=sum")
    async with service, example("add_two_ints_client", *words, uri=master.uri) as client:
        assert await client.ends() == 0
        assert client.lines == ["20 + -3 = 17"]
        assert client.errors == ""


async def test_add_two_ints_client_says_why_there_is_no_answer(master, make_node):
    def refuse(request):
        raise aioros1.ServiceError("out of numbers")

    node = await make_node("tester")
    service = node.advertise_service("add_two_ints", "roscpp_tutorials/TwoInts", refuse)
    async with service, example("add_two_ints_client", uri=master.uri) as client:
        assert await client.ends() == 1
        assert client.errors == "no answer: out of numbers\n"


async def test_parameters(master, make_node):
    node = await make_node("tester")
    async with example("parameters", uri=master.uri) as program:
        await program.says("following /parameters/gains: {'p': 1.0, 'i': 0.1}")
        await node.set_param("/parameters/gains/d", 7)
        line = await program.says("/parameters/gains/d is now 7")
        assert line.endswith("in all: {'p': 1.0, 'i': 0.1, 'd': 7}")
        await node.set_param("/parameters", {"gains": {"p": 3}})
        await program.says("/parameters/gains is now {'p': 3}")
        assert await program.end(signal.SIGINT) == 0
        assert "not there: no value" in program.lines
        assert program.errors == ""


async def test_joint_trajectory_monitor(master, make_node):
    node = await make_node("tester")
    async with (
        node.advertise("joint_path_command", "trajectory_msgs/JointTrajectory") as pub,
        example("joint_trajectory_monitor", uri=master.uri) as monitor,
    ):
        await pub.wait_for_subscribers(timeout=PATIENCE)
        point = pub.message_class.from_dict
        pub.publish(point({
            "header": {"frame_id": "base"},
            "joint_names": ["elbow", "wrist"],
            "points": [
                {"positions": [0.0, 1.0]},
                {"positions": [-0.5, 2.0], "time_from_start": 1},
                {"positions": [0.25, 1.5], "time_from_start": 2.5},
            ],
        }))  # fmt: skip
        pub.publish()
        await monitor.says("no frame: empty")
        assert monitor.lines[1:] == [
            "base: 3 points in 2.50 s",
            "  elbow: +0.000 to +0.250 rad, within -0.500 and +0.250",
            "  wrist: +1.000 to +1.500 rad, within +1.000 and +2.000",
            "no frame: empty, which means: stop",
        ]
        assert await monitor.end(signal.SIGINT) == 0
        assert monitor.errors == ""


async def test_api_tour(master):
    async with example("api_tour", uri=master.uri) as tour:
        assert await tour.ends() == 0, tour.errors
        for line in (
            "latched: 0.1",
            "answered: off",
            "refused: not now, /api_tour",
            "all of it: {'speed': 0.25, 'grip': {'force': 5, 'soft': True}}",
            "deleted: None",
            "its topics: /rosout",
            "it ended: [/api_tour] the tour is over",
            "slept: True",
        ):
            assert line in tour.lines
        assert tour.lines[-1].startswith("RoleUnregistered: ")
        assert tour.errors == ""


async def test_web_app(master, make_node):
    sockets = bind_sockets("localhost")
    port = sockets[0].getsockname()[1]
    for sock in sockets:
        sock.close()
    url = f"http://localhost:{port}/chatter"
    node = await make_node("tester")
    async with (
        node.advertise("chatter", "std_msgs/String") as pub,
        node.subscribe("chatter", "std_msgs/String") as sub,
        aiohttp.ClientSession(timeout=aiohttp.ClientTimeout(PATIENCE)) as session,
        example("web_app", str(port), uri=master.uri) as app,
    ):
        await app.says("Running on")
        async with session.get(url) as response:
            assert response.status == 404

        # Out of the web, into ROS.
        await sub.wait_for_publishers(2, timeout=PATIENCE)
        async with session.post(url, json={"data": "from the web"}) as response:
            assert response.status == 204
        assert (await sub.get(timeout=PATIENCE)).data == "from the web"
        for wrong in ({"text": "?"}, {"data": 5}, [], "?"):
            async with session.post(url, json=wrong) as response:
                assert response.status == 400

        # Out of ROS, into the web.
        async with session.ws_connect(f"{url}/stream") as socket:
            await pub.wait_for_subscribers(2, timeout=PATIENCE)
            received: list[object] = []
            while not received:  # until the subscriber of this socket is there
                pub.publish(data="to the web")
                with contextlib.suppress(TimeoutError):
                    received.append(await socket.receive_json(timeout=0.2))
            assert received == [{"data": "to the web"}]
            async with session.get(url) as response:
                assert await response.json() == {"data": "to the web"}

            # A socket that is open does not keep the application from ending.
            app.process.send_signal(signal.SIGINT)
            while (await socket.receive(timeout=PATIENCE)).type != aiohttp.WSMsgType.CLOSE:
                pass
        assert await app.ends() == 0
        assert app.errors == ""


async def test_demo():
    async with example("demo") as demo:
        assert await demo.ends() == 0, demo.text + demo.errors
        assert demo.errors == ""
        assert "Traceback" not in demo.text
        said = {tuple(part.strip() for part in line.split("|", 1)) for line in demo.lines}
        assert {
            ("talker", "hello world 3"),
            ("adder", "3 + 4 = 7"),
            ("client", "3 + 4 = 7"),
            ("follower", "/parameters/gains/p is now 2.5, in all: {'p': 2.5, 'i': 0.1}"),
            ("demo", "everything came, and everything has ended"),
        } <= said


async def test_demo_says_what_did_not_come(tmp_path):
    folder = shutil.copytree(EXAMPLES, tmp_path / "examples")
    (folder / "add_two_ints_client.py").write_text("raise SystemExit('not today')\n")
    async with example("demo", folder=folder) as demo:
        assert await demo.ends() == 1
        assert demo.errors == "demo: FAILED: client ended before it printed '3 + 4 = 7'\n"
        assert "client | not today" in demo.text


async def test_every_example_is_tested():
    for name in sorted(os.listdir(EXAMPLES)):
        if name.endswith(".py"):
            assert f'example("{name.removesuffix(".py")}"' in TESTS, f"{name} has no test"
