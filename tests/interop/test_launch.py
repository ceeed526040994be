"""A script of ours, started by roslaunch with the arguments it gives to every node."""

from __future__ import annotations

import stat
import sys
from pathlib import Path

from .processes import until
from .world import World, free_port

LAUNCH = """\
<launch>
  <param name="greeting" value="hello"/>
  <group ns="robot">
    <node pkg="launched" type="script.py" name="renamed" output="screen">
      <param name="count" value="3"/>
      <remap from="chatter" to="/elsewhere"/>
    </node>
  </group>
</launch>
"""

SCRIPT = """\
#!{python}
import sys
sys.path.insert(0, {root!r})
import aioros1

async def main(node):
    count = await node.get_param("~count")
    greeting = await node.get_param("/greeting")
    async with node.advertise("chatter", "std_msgs/String", latch=True) as pub:
        pub.publish(data=f"{{node.name}} {{count}} {{greeting}}")
        print("published", flush=True)
        await node.wait_closed()

aioros1.run(main, "original")
print("ended well", flush=True)
"""


async def test_a_launched_script(tmp_path: Path) -> None:
    import aioros1

    package = tmp_path / "packages" / "launched"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package><name>launched</name><version>1.0.0</version><description>-</description>"
        "<maintainer email='a@b.c'>a</maintainer><license>BSD</license></package>"
    )
    (package / "some.launch").write_text(LAUNCH)
    script = package / "script.py"
    root = str(Path(aioros1.__file__).parent.parent)
    script.write_text(SCRIPT.format(python=sys.executable, root=root))
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    port = free_port()
    world = World("roslaunch", f"http://localhost:{port}", tmp_path)
    env = {"ROS_PACKAGE_PATH": f"{package.parent}:/usr/share"}
    launch = world.start("roslaunch", "-p", str(port), "launched", "some.launch", env=env)
    try:
        await launch.wait_text("published", timeout=40)
        result = await world.run("rostopic", "echo", "-n", "1", "/elsewhere")
        assert "/robot/renamed 3 hello" in result.stdout
        assert await world.who("publishers", "/elsewhere") == {"/robot/renamed"}
        # rosnode kill, and not a signal: it ends as a whole and with exit code 0.
        await world.run("rosnode", "kill", "/robot/renamed")
        await launch.wait_text("ended well")
        await launch.wait_text("process has finished cleanly")
        await until(lambda: "/robot/renamed" in launch.report(), what="its name in the log")
    finally:
        from .processes import end_all

        await end_all(world.processes)
