"""Programs that are one node: ``aioros1.run``."""

from __future__ import annotations

import asyncio
import signal
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

TALKER = """
import sys, aioros1
async def main(node):
    count = 0
    async with node.advertise("chatter", "std_msgs/String") as pub:
        async for now in node.rate(1000):
            pub.publish(data="x")
            if not count:
                print("ready", node.name, flush=True)
            count += 1
    return count > 0
result = aioros1.run(main, "talker")
print("ended", result, flush=True)
"""

LOGGING = """
import logging, aioros1
async def main(node):
    node.log.info("hello")
    logging.getLogger("app.part").warning("all %s", "w\\u00e4ll")
    logging.getLogger("other").info("nothing to do with it")
aioros1.run(main, "talker", rosout=["app"])
logging.getLogger("app").error("too late")
"""

STUBBORN = """
import asyncio, aioros1
async def main(node):
    print("ready", flush=True)
    try:
        await asyncio.sleep(3600)
    finally:
        print("cancelled", flush=True)
print("ended", aioros1.run(main, "stubborn"), flush=True)
"""


async def start(code: str, master_uri: str, *words: str) -> asyncio.subprocess.Process:
    return await asyncio.create_subprocess_exec(
        *(sys.executable, "-W", "error", "-c", code, *words),
        env={"ROS_MASTER_URI": master_uri, "PYTHONPATH": str(ROOT), "PATH": ""},
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
    )


@pytest.mark.asyncio(loop_factories=["asyncio"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
async def test_a_signal_cancels_main_and_closes_the_node(master, number):
    process = await start(TALKER, master.uri, "__ns:=/robot")
    assert process.stdout is not None
    assert await process.stdout.readline() == b"ready /robot/talker\n"
    process.send_signal(number)
    output, errors = await asyncio.wait_for(process.communicate(), 40)
    assert (output, errors, process.returncode) == (b"ended None\n", b"", 0)


@pytest.mark.asyncio(loop_factories=["asyncio"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
async def test_a_signal_while_the_node_waits_for_its_master(number):
    """One that takes the connection, and never answers."""
    connected = asyncio.get_running_loop().create_future()
    server = await asyncio.start_server(
        lambda reader, writer: connected.set_result(writer), "127.0.0.1", 0
    )
    try:
        port = server.sockets[0].getsockname()[1]
        process = await start(STUBBORN, f"http://127.0.0.1:{port}")
        writer = await asyncio.wait_for(connected, 40)
        process.send_signal(number)
        output, errors = await asyncio.wait_for(process.communicate(), 40)
        assert (output, errors, process.returncode) == (b"ended None\n", b"", 0)
        writer.close()
    finally:
        server.close()


@pytest.mark.asyncio(loop_factories=["asyncio"])
async def test_what_it_logs_is_in_the_file_that_roslaunch_names(master, tmp_path):
    path = tmp_path / "talker-1.log"
    path.write_text("from the last time\n")
    process = await start(LOGGING, master.uri, f"__log:={path}")
    output, errors = await asyncio.wait_for(process.communicate(), 40)
    # On the terminal it is as without a file.
    assert (output, errors.decode(), process.returncode) == (b"", "all wäll\ntoo late\n", 0)
    first, hello, well = path.read_text(encoding="utf-8").splitlines()
    assert first == "from the last time"
    assert hello.startswith("[ros.talker][INFO] ")
    assert hello.endswith(": hello")
    assert well.startswith("[app.part][WARNING] ")
    assert well.endswith(": all wäll")


@pytest.mark.asyncio(loop_factories=["asyncio"])
async def test_a_file_that_cannot_be_written_is_no_reason_to_end(master, tmp_path):
    path = tmp_path / "no" / "such.log"
    process = await start(LOGGING, master.uri, f"__log:={path}")
    _, errors = await asyncio.wait_for(process.communicate(), 40)
    first, *_ = errors.decode().splitlines()
    assert first.startswith(f"__log:={path}: no log is written there: ")
    assert process.returncode == 0
