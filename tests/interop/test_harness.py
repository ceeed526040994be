"""The real programs against each other: what fails here is not the library's fault."""

from __future__ import annotations

import pytest

from . import debian
from .world import World


async def test_rostopic_hears_a_rospy_talker(under_rosmaster: World) -> None:
    topic = under_rosmaster.unique("chatter")
    fields = under_rosmaster.fields(data="number $i")
    talker = await under_rosmaster.rospy_ready("talker", topic, "std_msgs/String", fields)
    await under_rosmaster.wait_who("publishers", topic, {"/rospy_talker"})
    result = await under_rosmaster.run("rostopic", "echo", "-n", "2", topic)
    assert "number " in result.stdout
    await talker.end()
    await under_rosmaster.wait_no_traces("/rospy_talker")


@pytest.mark.parametrize(
    "type_name", ["std_msgs/String", "sensor_msgs/JointState", "nav_msgs/Path", "std_msgs/Empty"]
)
async def test_roscpp_peers_understand_each_other(under_rosmaster: World, type_name: str) -> None:
    topic = under_rosmaster.unique("cpp")
    listener = await under_rosmaster.roscpp_ready("listener", topic, type_name, "__name:=ear")
    await under_rosmaster.roscpp_ready("talker", topic, type_name, "3", "100", "0", "__name:=mouth")
    messages = await listener.wait_values("message", 3)
    assert len(messages) == 3
    assert listener.values("from") == ["/mouth"] * 3


async def test_roscpp_serves_rospy(under_rosmaster: World) -> None:
    service = under_rosmaster.unique("flip")
    await under_rosmaster.roscpp_ready("server", service, "broken")
    client = under_rosmaster.rospy(
        "client", service, "std_srvs/SetBool", '{"data": true}', '{"data": false}'
    )
    await client.wait_values("answer")
    assert client.values("answer") == [{"success": True, "message": "it is on"}]
    (error,) = await client.wait_values("error")
    assert "broken" in error


async def test_rospy_serves_roscpp(under_rosmaster: World) -> None:
    service = under_rosmaster.unique("flip")
    reply = under_rosmaster.fields(success=True, message="done")
    await under_rosmaster.rospy_ready("server", service, "std_srvs/SetBool", "--reply", reply)
    client = under_rosmaster.roscpp("client", service, "2", "1")
    answers = await client.wait_values("answer", 2)
    assert answers == [{"success": True, "message": "done"}] * 2


async def test_parameters_of_rospy_and_roscpp(under_rosmaster: World) -> None:
    base = under_rosmaster.unique("base")
    params = await under_rosmaster.rospy_ready("params")
    params.tell(f'["set", "{base}", {{"int": 3, "float": 0.5, "text": "tä", "list": ["a"]}}]')
    await params.wait_values("result", 1)
    cpp = under_rosmaster.roscpp("params", base)
    await cpp.wait_values("done")
    assert cpp.values("int") == [3]
    params.tell(f'["get", "{base}/from_cpp"]')
    results = await params.wait_values("result", 2)
    assert results[1] == {"x": 1.5, "y": -2.0}


async def test_a_killed_process_says_no_goodbye(under_rosmaster: World) -> None:
    topic = under_rosmaster.unique("chatter")
    listener = await under_rosmaster.rospy_ready("listener", topic, "std_msgs/String")
    await listener.kill()
    assert listener.code == -9
    assert not listener.is_alive
    assert await under_rosmaster.who("subscribers", topic) == {"/rospy_listener"}


@pytest.mark.parametrize("required", [False, True])
async def test_what_is_missing_skips_or_fails(
    monkeypatch: pytest.MonkeyPatch, required: bool
) -> None:
    monkeypatch.setenv("AIOROS1_REQUIRE_INTEROP", "1" if required else "")
    outcome = pytest.fail.Exception if required else pytest.skip.Exception
    with pytest.raises(outcome, match=r"nothing.h is not installed: apt-get install ros-core"):
        debian.require("/usr/include/nothing.h")
