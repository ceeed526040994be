"""The programs in ``examples``, as they are started: processes that meet at a master."""

from __future__ import annotations

import ast
import asyncio
import contextlib
import inspect
import json
import os
import runpy
import shutil
import signal
import sys
from asyncio.subprocess import DEVNULL, PIPE
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import aiohttp
import pytest

import aioros1
from aioros1.net.hosts import bind_sockets

ROOT = Path(aioros1.__file__).parents[1]
EXAMPLES = ROOT / "examples"
PATIENCE = 40.0

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

    async def logs(self, text: str) -> None:
        """Wait for ``text`` on the standard error."""
        async with asyncio.timeout(PATIENCE), self._news:
            await self._news.wait_for(lambda: text in self.errors or self._reading.done())
        assert text in self.errors, f"no {text!r} in: {self.errors}"

    async def ends(self, patience: float = PATIENCE) -> int:
        """Its exit code, when everything it printed was read."""
        async with asyncio.timeout(patience):
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
        async for line in self.process.stderr:
            self.errors += line.decode()
            async with self._news:
                self._news.notify_all()


@contextlib.asynccontextmanager
async def example(
    name: str, *words: str, uri: str = "", folder: Path = EXAMPLES, stdin: int = DEVNULL
) -> AsyncIterator[Program]:
    environ = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
    environ |= {"PYTHONPATH": str(ROOT), "PYTHONUNBUFFERED": "1", "ROS_MASTER_URI": uri}
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-W", "error", str(folder / f"{name}.py"), *words,
        env=environ, stdin=stdin, stdout=PIPE, stderr=PIPE,
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
        await talker.logs("waiting for a master")
        assert "localhost:1" in talker.errors
        assert await talker.end(signal.SIGINT) == 0


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
        assert server.errors == "/adder was shut down: [/tester] enough\n"


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


def free_port() -> int:
    sockets = bind_sockets("localhost")
    port: int = sockets[0].getsockname()[1]
    for sock in sockets:
        sock.close()
    return port


async def calls_add_two_ints(session: aiohttp.ClientSession, url: str, node: aioros1.Node) -> None:
    """What a web application does that calls the service for its browsers."""
    async with session.post(url, json={"a": 1, "b": 2}) as response:
        assert response.status == 502
        assert "add_two_ints" in await response.text()
    adder = node.advertise_service(
        "add_two_ints", "roscpp_tutorials/TwoInts", lambda request: {"sum": request.a + request.b}
    )
    async with adder:
        async with session.post(url, json={"a": 1, "b": 2}) as response:
            assert await response.json() == {"sum": 3}
        for wrong in ({"a": "x"}, {"c": 1}, [], "?"):
            async with session.post(url, json=wrong) as response:
                assert response.status == 400


async def streamed(socket: aiohttp.ClientWebSocketResponse, pub: aioros1.Publisher) -> object:
    """What comes to a browser, once the subscriber of its socket is there."""
    while True:
        pub.publish(data="to the web")
        with contextlib.suppress(TimeoutError):
            return await socket.receive_json(timeout=0.2)


async def test_web_app(master, make_node):
    port = free_port()
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

        await calls_add_two_ints(session, f"http://localhost:{port}/sum", node)

        # Out of ROS, into the web.
        async with session.ws_connect(f"{url}/stream") as socket:
            await pub.wait_for_subscribers(2, timeout=PATIENCE)
            assert await streamed(socket, pub) == {"data": "to the web"}
            async with session.get(url) as response:
                assert await response.json() == {"data": "to the web"}

            # A socket that is open does not keep the application from ending.
            app.process.send_signal(signal.SIGINT)
            while (await socket.receive(timeout=PATIENCE)).type != aiohttp.WSMsgType.CLOSE:
                pass
        assert await app.ends() == 0
        assert "Traceback" not in app.errors


async def test_web_app_ends_its_streams_when_somebody_ends_its_node(master, make_node):
    port = free_port()
    node = await make_node("tester")
    async with (
        node.advertise("chatter", "std_msgs/String") as pub,
        aiohttp.ClientSession(timeout=aiohttp.ClientTimeout(PATIENCE)) as session,
        example("web_app", str(port), uri=master.uri) as app,
    ):
        await app.says("Running on")
        async with session.ws_connect(f"http://localhost:{port}/chatter/stream") as socket:
            await streamed(socket, pub)
            await (await node.peer("/web_app")).shutdown("enough")
            while (await socket.receive(timeout=PATIENCE)).type != aiohttp.WSMsgType.CLOSE:
                pass
        assert await app.end(signal.SIGINT) == 0
        assert app.errors == ""


async def test_starlette_app(master, make_node):
    port = free_port()
    url = f"http://localhost:{port}"
    node = await make_node("tester")
    async with (
        node.advertise("chatter", "std_msgs/String") as pub,
        node.subscribe("chatter", "std_msgs/String") as sub,
        aiohttp.ClientSession(timeout=aiohttp.ClientTimeout(PATIENCE)) as session,
        example("starlette_app", str(port), uri=master.uri) as app,
    ):
        await app.logs("Uvicorn running on")

        # Out of the web, into ROS.
        await sub.wait_for_publishers(2, timeout=PATIENCE)
        async with session.post(f"{url}/chatter", json={"data": "from the web"}) as response:
            assert response.status == 204
        assert (await sub.get(timeout=PATIENCE)).data == "from the web"
        async with session.post(f"{url}/chatter", json={"text": "?"}) as response:
            assert response.status == 400
        await calls_add_two_ints(session, f"{url}/sum", node)

        # Out of ROS, into the web.
        async with session.get(f"{url}/chatter/stream") as response:
            assert await response.content.readline() == b": now\n"
            assert await response.content.readline() == b"\n"
            await pub.wait_for_subscribers(2, timeout=PATIENCE)
            pub.publish(data="to the web")
            assert await response.content.readline() == b'data: {"data": "to the web"}\n'
        async with session.get(f"{url}/health") as response:
            assert await response.json() == {"node": "/starlette_app", "state": "open"}

        # Somebody ends the node, and the web is told.
        await (await node.peer("/starlette_app")).shutdown("enough")
        while True:
            async with session.get(f"{url}/health") as response:
                if response.status == 503:
                    break
        assert await app.end(signal.SIGINT) == 0
        assert "Traceback" not in app.errors


async def test_chat(master, make_node):
    node = await make_node("tester")
    async with (
        node.advertise("room", "std_msgs/String") as pub,
        node.subscribe("room", "std_msgs/String") as sub,
        example("chat", "chatter:=room", uri=master.uri, stdin=PIPE) as chat,
    ):
        name = (await chat.says("you are /chat_")).split()[-1]
        assert chat.process.stdin is not None
        await pub.wait_for_subscribers(2, timeout=PATIENCE)
        await sub.wait_for_publishers(2, timeout=PATIENCE)
        pub.publish(data="is anybody there?")
        await chat.says("/tester: is anybody there?")
        await sub.get(timeout=PATIENCE)  # it is here too
        chat.process.stdin.write(b"yes\n")
        assert (await sub.get(timeout=PATIENCE)).data == "yes"
        chat.process.stdin.close()
        assert await chat.ends() == 0
        assert chat.lines == [f"you are {name}", "/tester: is anybody there?"]
        assert chat.errors == ""


async def test_chat_that_is_interrupted(master, make_node):
    node = await make_node("tester")
    async with example("chat", uri=master.uri, stdin=PIPE) as chat:
        await chat.says("you are /chat_")
        assert await chat.end(signal.SIGINT) == -signal.SIGINT
        assert "KeyboardInterrupt" in chat.errors
        # It has taken its leave of the master.
        assert (await node.graph.snapshot()).nodes == frozenset()


async def test_monitor_tui(master, make_node):
    from textual.widgets import DataTable, Static

    monitor = runpy.run_path(str(EXAMPLES / "monitor_tui.py"))["Monitor"]
    node = await make_node("tester")
    async with (
        node.advertise("chatter", "std_msgs/String") as chatter,
        node.advertise("count", "std_msgs/Int32") as count,
    ):
        app = monitor(["chatter", "count"], master_uri=master.uri, host="localhost", rosout=False)
        async with app.run_test() as pilot, asyncio.timeout(PATIENCE):
            await chatter.wait_for_subscribers()
            await count.wait_for_subscribers()
            chatter.publish(data="[hello]")
            count.publish(data=5)
            count.publish(data=7)
            table, text = app.query_one(DataTable), app.query_one("#message", Static)

            def shows(topic: str, *cells: str) -> bool:
                return table.get_row(topic)[1:3] == list(cells)

            while not shows("/chatter", "std_msgs/String", "1"):
                await pilot.pause()
            while not shows("/count", "std_msgs/Int32", "2"):
                await pilot.pause()
            assert "[hello]" in str(text.visual)
            await pilot.press("down")
            await pilot.pause()
            assert "data: 7" in str(text.visual)
            await pilot.press("q")
        assert app.return_code == 0
        # Leaving the screen has cancelled the worker, and that has closed the node.
        await node.graph.wait_for(lambda graph: set(graph.nodes) == {"/tester"}, timeout=PATIENCE)


async def test_monitor_tui_without_a_master():
    async with example("monitor_tui", "chatter", uri="http://localhost:1") as monitor:
        assert await monitor.ends() == 1
        assert "MasterUnreachable" in monitor.text + monitor.errors


async def test_notebook():
    """The cells one after the other in one loop, as Jupyter runs them."""
    notebook = json.loads((EXAMPLES / "notebook.ipynb").read_text(encoding="utf-8"))
    names: dict[str, Any] = {}
    results = [
        await run_cell("".join(cell["source"]), names)
        for cell in notebook["cells"]
        if cell["cell_type"] == "code"
    ]
    assert ["hello 0", "hello 1"] in results
    assert True in results
    assert not names["node"].is_open
    assert not names["master"].is_open


async def run_cell(source: str, names: dict[str, Any]) -> Any:
    """What a cell shows: the value of its last line, if that is an expression."""
    *body, last = ast.parse(source).body
    parts: list[ast.Module | ast.Expression] = [ast.Module(body, [])]
    parts.append(
        ast.Expression(last.value) if isinstance(last, ast.Expr) else ast.Module([last], [])
    )
    result = None
    for part in parts:
        mode = "eval" if isinstance(part, ast.Expression) else "exec"
        result = eval(compile(part, "cell", mode, flags=ast.PyCF_ALLOW_TOP_LEVEL_AWAIT), names)
        if inspect.iscoroutine(result):
            result = await result
    return result


@pytest.fixture
def patient(tmp_path):
    """The examples, of which the demo waits for the others on a busy machine, too."""
    folder = Path(shutil.copytree(EXAMPLES, tmp_path / "examples"))
    text = (folder / "demo.py").read_text()
    assert "\nPATIENCE = 10.0\n" in text
    (folder / "demo.py").write_text(text.replace("\nPATIENCE = 10.0\n", "\nPATIENCE = 60.0\n"))
    return folder


async def test_demo(patient):
    async with example("demo", folder=patient) as demo:
        assert await demo.ends(200) == 0, demo.text + demo.errors
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


async def test_demo_says_what_did_not_come(patient):
    (patient / "add_two_ints_client.py").write_text("raise SystemExit('not today')\n")
    async with example("demo", folder=patient) as demo:
        assert await demo.ends(200) == 1
        assert demo.errors == "demo: FAILED: client ended before it printed '3 + 4 = 7'\n"
        assert "client | not today" in demo.text


async def test_every_example_is_tested():
    for name in sorted(os.listdir(EXAMPLES)):
        if name != "__pycache__":
            tests = (f'example("{name.removesuffix(".py")}"', f'EXAMPLES / "{name}"')
            assert any(test in TESTS for test in tests), f"{name} has no test"
