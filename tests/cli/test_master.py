"""``aioros1 master`` as a process."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

import aioros1.cli
from aioros1.cli.serve import plain_options
from aioros1.net.hosts import bind_sockets
from aioros1.xmlrpc.client import XmlRpcClient

ROOT = Path(aioros1.cli.__file__).parents[2]


@contextlib.asynccontextmanager
async def command(*words: str, code: str = "") -> AsyncIterator[asyncio.subprocess.Process]:
    environ = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
    environ["PYTHONPATH"] = str(ROOT)
    program = ["-c", code] if code else ["-m", "aioros1"]
    process = await asyncio.create_subprocess_exec(
        sys.executable, *program, *words,
        env=environ, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    try:
        yield process
    finally:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        await process.communicate()


async def uri_of(process: asyncio.subprocess.Process) -> str:
    assert process.stdout is not None
    line = (await asyncio.wait_for(process.stdout.readline(), 40)).decode()
    variable, _, uri = line.strip().partition("=")
    assert variable == "ROS_MASTER_URI"
    return uri


@pytest.mark.parametrize(("name", "number"), [("master", signal.SIGINT), ("core", signal.SIGTERM)])
async def test_it_serves_until_a_signal(name: str, number: int) -> None:
    async with command(name, "--port", "0", "--host", "localhost") as process:
        uri = await uri_of(process)
        client = XmlRpcClient()
        assert (await client.call(uri, "getPid", "/c"))[2] == process.pid
        await client.close()
        process.send_signal(number)
        _, errors = await asyncio.wait_for(process.communicate(), 40)
        assert (process.returncode, errors) == (0, b"")


async def test_it_serves_until_it_is_asked_to_end() -> None:
    async with command("master", "--port", "0", "--host", "127.0.0.1") as process:
        uri = await uri_of(process)
        client = XmlRpcClient()
        assert await client.call(uri, "shutdown", "/c", "bye") == [1, "shutdown", 0]
        await client.close()
        _, errors = await asyncio.wait_for(process.communicate(), 40)
        assert (process.returncode, errors) == (0, b"")


@pytest.mark.skipif(sys.platform != "linux", reason="needs a second loopback address")
async def test_who_may_connect_and_where_it_listens() -> None:
    words = ("--bind", "127.0.0.1", "--allow", "10.0.0.0/8", "--allow", "127.0.0.1")
    async with command("master", "--port", "0", *words) as process:
        uri = await uri_of(process)
        assert uri.startswith("http://127.0.0.1:")
        client = XmlRpcClient()
        assert (await client.call(uri, "getPid", "/c"))[2] == process.pid
        await client.close()
        port = int(uri.rstrip("/").rsplit(":", 1)[1])
        reader, writer = await asyncio.open_connection(
            "127.0.0.1", port, local_addr=("127.0.0.2", 0)
        )
        assert await asyncio.wait_for(reader.read(), 40) == b""
        writer.close()


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("--allow", "10.0.0.5/8"), b"allow: '10.0.0.5/8' has host bits"),
        (("--allow", "10.0.0.0/8", "--host", "localhost"), b"connects from 127.0.0.1"),
        (("--bind", "eth0"), b"expected a numeric address to listen on, got 'eth0'"),
    ],
)
async def test_options_that_make_no_sense(words: tuple[str, ...], text: bytes) -> None:
    async with command("master", "--port", "0", *words) as process:
        output, errors = await asyncio.wait_for(process.communicate(), 40)
    assert (process.returncode, output) == (1, b"")
    assert errors.startswith(b"aioros1 master: ")
    assert text in errors
    assert b"Traceback" not in errors


async def test_a_port_that_is_taken() -> None:
    (sock,) = bind_sockets("127.0.0.1")
    port = sock.getsockname()[1]
    with sock:
        async with command("master", "--port", str(port), "--host", "127.0.0.1") as process:
            output, errors = await asyncio.wait_for(process.communicate(), 40)
    assert (process.returncode, output) == (1, b"")
    assert errors.decode().startswith(f"aioros1 master: cannot listen on 127.0.0.1:{port}: ")
    assert b"Traceback" not in errors


@pytest.mark.parametrize("missing", ["cyclopts", "rich"])
async def test_without_the_extra_it_says_what_to_install(missing: str) -> None:
    code = (
        f"import sys; sys.modules[{missing!r}] = None\n"
        "from aioros1.cli import main; main(['master'])"
    )
    async with command(code=code) as process:
        output, errors = await asyncio.wait_for(process.communicate(), 40)
    assert (process.returncode, output) == (2, b"")
    assert errors.decode().splitlines() == [
        f'the aioros1 command needs {missing}: pip install "aioros1[cli]"'
    ]


def test_help_and_version(capsys: pytest.CaptureFixture[str]) -> None:
    for words in (["--help"], ["master", "--help"], ["--version"]):
        with contextlib.suppress(SystemExit):
            aioros1.cli.main(words)
        assert capsys.readouterr().out.strip()


async def test_it_does_not_import_what_only_other_commands_need() -> None:
    """That would take as long as everything else, while programs wait for the master."""
    code = """
import atexit, sys
needless = {"cyclopts", "rich"}
atexit.register(lambda: print(sorted(needless & set(sys.modules)), flush=True))
from aioros1.cli import main
main()
"""
    words = ("core", "--port=0", "--host", "127.0.0.1", "--allow", "127.0.0.0/8")
    async with command(*words, code=code) as process:
        await uri_of(process)
        process.send_signal(signal.SIGTERM)
        output, _ = await asyncio.wait_for(process.communicate(), 40)
        assert (process.returncode, output) == (0, b"[]\n")


@pytest.mark.parametrize(
    ("words", "options"),
    [
        ("", {}),
        ("--port 0 --host=h", {"port": 0, "host": "h"}),
        ("--allow a --allow=b --bind 0", {"allow": ("a", "b"), "bind": "0"}),
        ("--help", None),
        ("--port", None),
        ("--port x", None),
        ("--port -1", None),
        ("--host --port", None),
        ("11311", None),
    ],
)
def test_words_that_need_no_more_to_be_read(words: str, options: object) -> None:
    assert plain_options(words.split()) == options
