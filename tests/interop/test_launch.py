"""Scripts of ours, started by roslaunch from a package, as it starts every node."""

from __future__ import annotations

import contextlib
import json
import signal
import stat
import sys
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest

import aioros1

from .processes import Process, until
from .world import World, free_port

PACKAGE = """\
<package><name>launched</name><version>1.0.0</version><description>-</description>
<maintainer email='a@b.c'>a</maintainer><license>BSD</license></package>
"""

# What every script begins with. It says what it is in a line of JSON, in a file of its own:
# roslaunch shows what a node prints, or writes it to a log, as the launch file says.
HEAD = f"""\
#!{sys.executable}
import asyncio, json, os, sys
sys.path.insert(0, {str(Path(aioros1.__file__).parent.parent)!r})
import aioros1

def tell(**values):
    with open(os.environ["LAUNCHED_LOG"], "a") as log:
        print(json.dumps({{"pid": os.getpid(), **values}}), file=log, flush=True)
"""

SCRIPTS = {
    "talker.py": """
async def main(node):
    async with (
        node.advertise("chatter", "std_msgs/String", latch=True) as pub,
        node.advertise_service("~flip", "std_srvs/Empty", lambda request: None) as provider,
    ):
        pub.publish(data=node.name)
        print("said hello", flush=True)
        node.log.info("hello from %s", node.name)
        tell(
            name=node.name, topic=pub.name, service=provider.name, argv=sys.argv[1:],
            private=await node.get_param("~", None),
            greeting=await node.get_param("/greeting", None),
            shared=await node.get_param("shared", None), namespace=node.namespace,
        )
        await node.wait_closed()

aioros1.run(main, "talker")
tell(ended=True)
""",
    "dies.py": """
async def main(node):
    tell(name=node.name)
    sys.exit(int(await node.get_param("~code")))

aioros1.run(main, "dies")
""",
    "wrong.py": """
async def main(node):
    pass

aioros1.run(main, "wrong")
""",
}


class Launch:
    """roslaunch with one file, and what the scripts have told."""

    def __init__(self, world: World, process: Process, log: Path) -> None:
        self.world = world
        self.process = process
        self._log = log

    @property
    def told(self) -> list[dict[str, Any]]:
        complete = self._log.read_text().rpartition("\n")[0] if self._log.exists() else ""
        return [json.loads(line) for line in complete.splitlines()]

    async def wait_told(self, key: str, count: int = 1) -> list[dict[str, Any]]:
        def found() -> list[dict[str, Any]] | None:
            rows = [row for row in self.told if key in row]
            return rows if len(rows) >= count else None

        what = f"{count} that tell {key!r}"
        rows: list[dict[str, Any]] = await until(
            found, what=lambda: f"{what}: {self.told} {self.process.report()}", timeout=40
        )
        return rows

    async def stop(self) -> None:
        """As Ctrl-C in the terminal does it. Everything ends well, and by itself."""
        self.process.signal(signal.SIGINT)
        result = await self.process.wait(timeout=25)
        assert result.code == 0, self.process.report()
        assert "escalating" not in result.text, self.process.report()


def log_of(row: dict[str, Any]) -> str:
    """What is in the file that roslaunch has named."""
    (path,) = (word for word in row["argv"] if word.startswith("__log:="))
    return Path(path.removeprefix("__log:=")).read_text()


@contextlib.asynccontextmanager
async def launched(
    folder: Path, body: str, *words: str, master: str | None = None
) -> AsyncIterator[Launch]:
    """Start a launch file; it brings a master with it unless ``master`` is one."""
    from .processes import end_all

    package = folder / "packages" / "launched"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text(PACKAGE)
    (package / "some.launch").write_text(f"<launch>\n{body}\n</launch>\n")
    (package / "robot.yaml").write_text("speed: 1.5\nwheels: [left, right]\nlimits: {high: 7}\n")
    for name, code in SCRIPTS.items():
        script = package / "scripts" / name
        script.write_text(HEAD + code)
        script.chmod(script.stat().st_mode | stat.S_IXUSR)
    port = free_port()
    world = World("roslaunch", master or f"http://localhost:{port}", folder)
    log = folder / "told.jsonl"
    env = {"ROS_PACKAGE_PATH": f"{package.parent}:/usr/share", "LAUNCHED_LOG": str(log)}
    which = () if master else ("-p", str(port))
    try:
        yield Launch(
            world, world.start("roslaunch", *which, "launched", "some.launch", *words, env=env), log
        )
    finally:
        await end_all(world.processes)


async def test_names_remappings_and_parameters(tmp_path: Path) -> None:
    body = """
      <arg name="who"/>
      <param name="greeting" value="hello"/>
      <rosparam command="load" file="$(find launched)/robot.yaml" ns="robot/$(arg who)/settings"/>
      <group ns="robot">
        <param name="shared" value="true"/>
        <remap from="chatter" to="/elsewhere"/>
        <node pkg="launched" type="talker.py" name="$(arg who)"
              output="screen" args="one _x:=[1] -v">
          <param name="count" value="3"/>
          <param name="text" value="3" type="str"/>
          <rosparam>{list: [1, 2.5, yes], inner: {deep: text}}</rosparam>
          <remap from="~flip" to="turn"/>
        </node>
      </group>
      <node pkg="launched" type="talker.py" name="plain" ns="outer/inner"/>
      <node pkg="launched" type="talker.py" name="$(anon any)"/>
    """
    async with launched(tmp_path, body, "who:=renamed") as launch:
        rows = {row["name"]: row for row in await launch.wait_told("name", 3)}
        row = rows.pop("/robot/renamed")
        assert (row["topic"], row["service"]) == ("/elsewhere", "/robot/turn")
        inner = {"list": [1, 2.5, True], "inner": {"deep": "text"}}
        assert row["private"] == {
            "count": 3,
            "text": "3",
            "x": [1],
            **inner,
            "settings": {"speed": 1.5, "wheels": ["left", "right"], "limits": {"high": 7}},
        }
        assert (row["greeting"], row["shared"]) == ("hello", True)
        assert {word.partition(":=")[0] for word in row["argv"]} >= {"one", "-v", "__name", "__log"}
        plain = rows.pop("/outer/inner/plain")
        assert plain["topic"] == "/outer/inner/chatter"
        assert (plain["namespace"], plain["private"]) == ("/outer/inner", None)
        (anonymous,) = rows.values()
        assert anonymous["name"].startswith("/any_")

        world = launch.world
        result = await world.run("rostopic", "echo", "-n", "1", "/elsewhere")
        assert "/robot/renamed" in result.stdout
        # output="screen" of the one shows what it prints, and that of the others is in logs.
        await launch.process.wait_text("said hello")
        assert launch.process.stdout.count("said hello") == 1
        await world.run("rosservice", "call", "/robot/turn")
        await launch.stop()
        assert len(await launch.wait_told("ended", 3)) == 3
        # Where roslaunch tells people to look.
        logged = log_of(row)
        assert "[ros.robot.renamed][INFO] " in logged
        assert logged.count("hello from /robot/renamed\n") == 1


async def test_it_is_stopped_and_leaves_nothing_at_the_master(
    tmp_path: Path, our_master: aioros1.Master
) -> None:
    body = """
      <node pkg="launched" type="talker.py" name="one"/>
      <node pkg="launched" type="talker.py" name="two"/>
    """
    async with launched(tmp_path, body, master=our_master.uri) as launch:
        await launch.wait_told("name", 2)
        assert await launch.world.who("publishers", "/chatter") == {"/one", "/two"}
        await launch.stop()
        # Not only at last: it had told the master before its process ended.
        assert await launch.world.traces("/one") == []
        assert await launch.world.traces("/two") == []
        assert len(await launch.wait_told("ended", 2)) == 2


async def test_rosnode_kill_ends_one(tmp_path: Path) -> None:
    body = """
      <node pkg="launched" type="talker.py" name="one"/>
      <node pkg="launched" type="talker.py" name="two"/>
    """
    async with launched(tmp_path, body) as launch:
        await launch.wait_told("name", 2)
        await launch.world.run("rosnode", "kill", "/one")
        await launch.process.wait_text("one-.*process has finished cleanly")
        assert await launch.world.traces("/one") == []
        assert await launch.world.who("publishers", "/chatter") == {"/two"}
        await launch.stop()


async def test_respawn_starts_it_again(tmp_path: Path) -> None:
    body = '<node pkg="launched" type="talker.py" name="one" respawn="true"/>'
    async with launched(tmp_path, body) as launch:
        (first,) = await launch.wait_told("name")
        await launch.world.run("rosnode", "kill", "/one")
        _, second = await launch.wait_told("name", 2)
        assert second["name"] == first["name"]
        assert second["pid"] != first["pid"]
        await launch.world.wait_who("publishers", "/chatter", {"/one"})
        await launch.stop()


@pytest.mark.parametrize("code", [0, 3])
async def test_the_end_of_a_required_one_ends_all(tmp_path: Path, code: int) -> None:
    body = f"""
      <node pkg="launched" type="talker.py" name="one"/>
      <node pkg="launched" type="dies.py" name="two" required="true">
        <param name="code" value="{code}"/>
      </node>
    """
    async with launched(tmp_path, body) as launch:
        await launch.process.wait(timeout=40)
        text = launch.process.stdout + launch.process.stderr
        assert "REQUIRED process [two-" in text
        assert ("exit code 3" in text) is (code == 3)
        if any(row.get("name") == "/one" for row in launch.told):
            await launch.wait_told("ended")


async def test_a_launch_prefix(tmp_path: Path) -> None:
    """What comes first starts the script, as a debugger or ``nice`` would."""
    body = """
      <node pkg="launched" type="talker.py" name="one" launch-prefix="env SOME=thing nice -n 5">
        <env name="ROS_NAMESPACE" value="by_environment"/>
      </node>
    """
    async with launched(tmp_path, body) as launch:
        (row,) = await launch.wait_told("name")
        assert b"SOME=thing" in _environment(row["pid"])
        # roslaunch says the namespace by a variable, and a launch file may set that.
        assert row["name"] == "/by_environment/one"
        await launch.stop()
        await launch.wait_told("ended")


async def test_an_address_that_nobody_knows_is_said_on_the_screen(tmp_path: Path) -> None:
    body = """
      <node pkg="launched" type="talker.py" name="one" output="screen">
        <env name="ROS_HOSTNAME" value="no-such-host.invalid"/>
      </node>
    """
    async with launched(tmp_path, body) as launch:
        await launch.process.wait_text(
            "^ROS_HOSTNAME=no-such-host.invalid: 'no-such-host.invalid' cannot be looked up here",
            timeout=40,
        )
        await launch.wait_told("name")
        await launch.stop()
        await launch.wait_told("ended")


async def test_two_launches_of_one_name(tmp_path: Path, our_master: aioros1.Master) -> None:
    """The master tells the first node to end, and the second one stays."""
    body = '<node pkg="launched" type="talker.py" name="one" output="screen"/>'
    async with launched(tmp_path / "first", body, master=our_master.uri) as first:
        await first.wait_told("name")
        async with launched(tmp_path / "second", body, master=our_master.uri) as second:
            await second.wait_told("name")
            await first.wait_told("ended")
            await first.process.wait_text("one-.*process has finished cleanly", running=False)
            assert await second.world.who("publishers", "/chatter") == {"/one"}
            await second.stop()
        assert await first.world.traces("/one") == []


async def test_what_is_wrong_is_said_on_the_screen(tmp_path: Path) -> None:
    body = '<node pkg="launched" type="wrong.py" name="one" output="screen" args="_list:=[1,"/>'
    async with launched(tmp_path, body) as launch:
        await launch.process.wait_text(
            r"ValueError: _list:=\[1,: expected a value in YAML", timeout=40
        )
        await launch.process.wait_text("process has died .*exit code 1")


def _environment(pid: int) -> list[bytes]:
    return Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
