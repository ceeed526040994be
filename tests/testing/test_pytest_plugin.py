"""The plugin as its users have it: in a pytest of its own, with tests that are in its files."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import aioros1

ROOT = Path(aioros1.__file__).parents[1]
ASYNCIO = "pytest_asyncio.plugin"
PATIENCE = 150

# What is left on purpose is not waited for as long.
IMPATIENT = """
from aioros1.testing import leaks

leaks._PATIENCE = 0.05
kept = []
"""

# Some of what is a leak can be seen only where the system lists the files of a process.
listed_files = pytest.mark.skipif(not os.path.isdir("/proc/self/fd"), reason="needs /proc")


@pytest.fixture
def run(pytester, monkeypatch):
    """Run pytest with a test file, and exactly the plugins and options given."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.delenv("PYTEST_ADDOPTS", raising=False)

    def run(code, *options, plugins=(ASYNCIO,), mode="auto", **ini):
        if ASYNCIO in plugins:
            ini |= {"asyncio_mode": mode, "asyncio_default_fixture_loop_scope": "function"} | ini
        lines = "".join(f"{key} = {value}\n" for key, value in ini.items())
        pytester.makeini(f"[pytest]\naddopts = --strict-markers\nfilterwarnings = error\n{lines}")
        imports = "import asyncio, os, socket, threading\nimport pytest\nimport aioros1\n"
        pytester.makepyfile(imports + code)
        words = [word for name in plugins for word in ("-p", name)]
        return pytester.runpytest_subprocess(
            "-p", "aioros1.testing.pytest_plugin", *words, *options, timeout=PATIENCE
        )

    return run


EVERY_FIXTURE = """
@pytest.fixture(autouse=True)
def foreign(monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://elsewhere:1/")
    monkeypatch.setenv("ROS_NAMESPACE", "/theirs")
    monkeypatch.setenv("ROS_IP", "192.0.2.1")

@pytest.mark.asyncio
async def test_master(ros_master):
    assert os.environ["ROS_MASTER_URI"] == ros_master.uri
    assert not {"ROS_IP", "ROS_NAMESPACE", "ROS_HOSTNAME"} & set(os.environ)
    async with aioros1.Node("mine", rosout=False, logger_services=False) as node:
        assert node.name == "/mine"
        state = await node.master.get_system_state()
        assert (state.publishers, state.subscribers, state.services) == ({}, {}, {})

@pytest.mark.asyncio
async def test_nodes(ros_node, make_node):
    assert os.environ["ROS_MASTER_URI"] == ros_node.master_uri
    other = await make_node("other", namespace="/there")
    assert (ros_node.name, other.name) == ("/node", "/there/other")
    async with (
        ros_node.advertise("/news", "std_msgs/String", latch=True) as pub,
        other.subscribe("/news", "std_msgs/String") as sub,
    ):
        pub.publish(data="hello")
        assert (await sub.get(timeout=30)).data == "hello"

@pytest.mark.asyncio
async def test_clock(ros_node, ros_clock, no_leaks):
    ticks = []
    ros_node.timer(0.5, ticks.append)
    await ros_clock.advance(2)
    assert [tick.to_sec() for tick in ticks] == [1.5, 2.0, 2.5, 3.0]

@pytest.mark.asyncio
async def test_proxy(ros_master, flaky_proxy, make_node):
    proxy = await flaky_proxy("localhost", ros_master.port, listen_host="localhost")
    node = await make_node("far", master_uri=f"http://localhost:{proxy.port}", heartbeat=None)
    assert proxy.accepted == 1
    proxy.refuse()
    proxy.cut()
    with pytest.raises(aioros1.MasterUnreachable):
        await node.get_param("/rosdistro")
    proxy.accept()
    assert await node.get_param("/rosdistro") == "noetic\\n"

def test_outside():
    assert os.environ["ROS_MASTER_URI"] == "http://elsewhere:1/"
"""


@pytest.mark.parametrize("mode", ["auto", "strict"])
def test_every_fixture(run, mode):
    result = run(EVERY_FIXTURE, mode=mode)
    result.assert_outcomes(passed=5)


def test_one_loop_for_a_module(run):
    result = run(
        """
@pytest.fixture(scope="module")
async def loop():
    return asyncio.get_running_loop()

async def test_one(ros_node, loop):
    assert asyncio.get_running_loop() is loop
    assert await ros_node.get_param("/rosdistro")

async def test_two(ros_node, loop, no_leaks):
    assert asyncio.get_running_loop() is loop
    assert await ros_node.get_param("/rosdistro")
""",
        asyncio_default_fixture_loop_scope="module",
        asyncio_default_test_loop_scope="module",
    )
    result.assert_outcomes(passed=2)


ANYIO = "@pytest.fixture\ndef anyio_backend(): pass\n"
ONE = "async def test_it(ros_node): pass\n"
UNITTEST = """
import unittest

@pytest.mark.usefixtures("ros_node")
class TestIt(unittest.IsolatedAsyncioTestCase):
    async def test_it(self): pass
"""


@pytest.mark.parametrize(
    ("code", "options", "expected"),
    [
        (ONE, {"plugins": ()}, "*they need pytest-asyncio, which is not loaded; pip install *"),
        (ONE, {"plugins": ("no:asyncio",)}, "*they need *, which is *"),
        (ONE, {"mode": "strict"}, "*mark it with @pytest.mark.asyncio or set asyncio_mode = *"),
        ("def test_it(flaky_proxy): pass\n", {}, "*the test has to be run by pytest-asyncio*"),
        (
            "async def test_it(anyio_backend, ros_clock): pass\n" + ANYIO,
            {"mode": "strict"},
            "*has to be run by pytest-asyncio, and anyio runs this test*",
        ),
        (
            '@pytest.mark.asyncio(loop_scope="module")\n' + ONE,
            {},
            "*set asyncio_default_fixture_loop_scope = module",
        ),
        (UNITTEST, {}, "*one of unittest, which *; open aioros1.Master * in asyncSetUp(), *"),
    ],
    ids=["no plugin", "blocked", "no marker", "no coroutine", "anyio", "another loop", "unittest"],
)
def test_where_they_cannot_be_used_they_say_why(run, code, options, expected):
    result = run(code, **options)
    result.stdout.fnmatch_lines([expected])
    result.assert_outcomes(errors=1)


def test_tests_without_ros_need_nothing(run):
    code = "def test_it(): pass\ndef test_files(no_leaks): pass\n"
    run(code, plugins=()).assert_outcomes(passed=2)


def test_loading_it_loads_no_library():
    code = (
        "import sys, pytest\n"
        "before = set(sys.modules)\n"
        "import aioros1.testing.pytest_plugin, aioros1.testing.fixtures\n"
        "print(*sorted(set(sys.modules) - before))"
    )
    printed = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout
    assert printed.split() == [
        "aioros1",
        "aioros1._version",
        "aioros1.testing",
        "aioros1.testing.fixtures",
        "aioros1.testing.pytest_plugin",
    ]


LEAKS = {
    "a task": ("asyncio.create_task(asyncio.sleep(60), name='dawdler')", "*task *'dawdler'*"),
    "a node": (
        "kept.append(await aioros1.Node('lost').start())",
        "*never closed: <Node /lost at http://*, open>",
    ),
    "a master": (
        "kept.append(aioros1.Master(host='localhost', port=0)); await kept[-1].start()",
        "*never closed: <Master at http://localhost:*/, open>",
    ),
    "a transport": (
        "kept.append(await asyncio.open_connection('127.0.0.1', port))",
        "*socket *: AF_INET at ('127.0.0.1', *) connected to ('127.0.0.1', *)",
    ),
    "a server": (
        "kept.append(await asyncio.start_server(print, '127.0.0.1', 0))",
        "*socket *: AF_INET at ('127.0.0.1', *)",
    ),
    "a socket": ("kept.append(socket.socket())", "*socket *: AF_INET at ('0.0.0.0', 0)"),
    "a pipe": ("os.pipe()", "*file *: pipe:*"),
    "a pair": ("kept.append(socket.socketpair())", "*socket *: AF_UNIX *"),
    "a file": ("kept.append(open('left.txt', 'w'))", "*file *left.txt"),
    "a thread": (
        "threading.Thread(target=end.wait, name='weaver', daemon=True).start()",
        "*thread <Thread(weaver, started daemon *",
    ),
}
LEAKING = """
end = threading.Event()

@pytest.fixture(scope="module")
def port():
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]
"""


@listed_files
def test_leaks_are_found_and_named(run):
    tests = [
        f"async def test_{number}(ros_master, port, no_leaks): {code}\n"
        for number, (code, _) in enumerate(LEAKS.values())
    ]
    result = run(IMPATIENT + LEAKING + "".join(tests))
    for number, (_, expected) in enumerate(LEAKS.values()):
        title = f"* ERROR at teardown of test_{number} *"
        result.stdout.fnmatch_lines([title, "left behind by the test:", expected])
    result.assert_outcomes(passed=len(LEAKS), errors=len(LEAKS))


@listed_files
def test_the_option_and_the_marker_say_which_tests_are_checked(run):
    code = """
def leak():
    kept.append(socket.socket())

async def test_every(): leak()

def test_every_plain_one(): leak()

@pytest.mark.no_leaks(False)
async def test_but_this(): leak()

@pytest.mark.no_leaks(check=False)
def test_and_this(): leak()

@pytest.mark.no_leaks
async def test_this_anyway(): leak()

@pytest.mark.no_leaks
def test_this_plain_one(): leak()
"""
    run(IMPATIENT + code, aioros1_check_leaks="true").assert_outcomes(passed=6, errors=4)
    run(IMPATIENT + code).assert_outcomes(passed=6, errors=2)


@listed_files
def test_what_is_shared_or_ends_in_time_is_no_leak(run):
    result = run(
        """
import multiprocessing

@pytest.fixture(scope="module")
def shared():
    end = threading.Event()
    thread = threading.Thread(target=end.wait)
    thread.start()
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]
    end.set()
    thread.join()

@pytest.fixture
async def connection(shared):
    reader, writer = await asyncio.open_connection("127.0.0.1", shared)
    yield
    writer.close()

async def test_it(connection, shared):
    await asyncio.to_thread(threading.current_thread)
    late = threading.Timer(0.05, print)
    late.start()
    asyncio.create_task(asyncio.sleep(60)).cancel()

def test_plain(shared):
    threading.Timer(0.05, print).start()

def test_helpers_of_multiprocessing():
    context = multiprocessing.get_context("forkserver")
    with context.Pool(1) as pool:
        assert pool.apply(abs, (-1,)) == 1
    pool.join()
""",
        aioros1_check_leaks="true",
    )
    result.assert_outcomes(passed=3)


@listed_files
def test_leaks_are_found_in_uvloop_too(run, pytester):
    pytest.importorskip("uvloop")
    pytester.makeconftest(
        """
import uvloop

def pytest_asyncio_loop_factories():
    return {"uvloop": uvloop.new_event_loop}
"""
    )
    result = run(
        IMPATIENT
        + """

async def test_clean(ros_node, no_leaks):
    assert "uvloop" in type(asyncio.get_running_loop()).__module__
    await asyncio.to_thread(threading.current_thread)

async def test_leak(ros_node, no_leaks):
    kept.append(socket.socket())
"""
    )
    result.stdout.fnmatch_lines(["*left behind by the test:", "*socket *: AF_INET *"])
    result.assert_outcomes(passed=2, errors=1)


@listed_files
def test_what_the_first_event_loop_of_uvloop_opens_for_good_is_no_leak(run):
    pytest.importorskip("uvloop")
    result = run(
        """
import uvloop

def test_it(no_leaks):
    uvloop.run(asyncio.sleep(0))

def test_leak(no_leaks):
    uvloop.run(asyncio.sleep(0))
    os.pipe()
"""
    )
    result.stdout.fnmatch_lines(["*left behind by the test:", "*file *: pipe:*"])
    result.assert_outcomes(passed=2, errors=1)


@listed_files
def test_the_standard_streams_are_no_leak_when_a_test_is_interrupted(run):
    result = run(
        """
import signal

async def test_it(ros_node, no_leaks):
    asyncio.get_running_loop().call_later(0.01, signal.raise_signal, signal.SIGINT)
    await ros_node.wait_for_message("silence")
"""
    )
    assert result.ret == pytest.ExitCode.INTERRUPTED
    result.stdout.no_fnmatch_line("*left behind*")
    result.stderr.no_fnmatch_line("*left behind*")


def test_a_script_that_fails_fails_the_test(run):
    result = run(
        """
async def test_it(ros_master, flaky_proxy):
    async def script(connection):
        raise RuntimeError("no such thing")

    proxy = await flaky_proxy("localhost", ros_master.port, script=script)
    await asyncio.open_connection(proxy.host, proxy.port)
    await asyncio.sleep(60)
"""
    )
    result.stdout.fnmatch_lines(["*RuntimeError: no such thing"])
    result.assert_outcomes(failed=1, errors=1)
