"""Our types and those that Debian's ROS has: the same definitions, the same md5sums."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from . import debian
from .processes import Process
from .world import World

SHARE = Path("/usr/share")
ON_DISK = ("sensor_msgs/JointState", "sensor_msgs/CameraInfo", "geometry_msgs/TwistStamped")


def bundle() -> Path:
    """Where the definitions are that come with the library."""
    import aioros1

    package = Path(aioros1.__file__).parent
    packed = package / "share" / "msg"
    return packed if packed.is_dir() else package.parent / "share" / "msg"


def bundled(kind: str) -> list[str]:
    """The types whose definitions come with the library."""
    return sorted(f"{path.parts[-3]}/{path.stem}" for path in bundle().glob(f"*/{kind}/*.{kind}"))


def load(store: Any, kind: str, name: str) -> Any:
    return store.load_msg(name) if kind == "msg" else store.load_srv(name)


@pytest.fixture
async def theirs(under_rosmaster: World) -> dict[tuple[str, str], dict[str, Any]]:
    """By kind and type: what Debian's Python says of every bundled type it has."""
    arguments = [f"{kind}:{name}" for kind in ("msg", "srv") for name in bundled(kind)]
    process: Process = under_rosmaster.rospy("definitions", *arguments)
    await process.wait_values("done")
    return {(r["kind"], r["type"]): r for r in process.records if "type" in r}


async def test_every_md5sum(theirs: dict[tuple[str, str], dict[str, Any]]) -> None:
    """Of the definitions that come with the library, and of those found on this system."""
    import aioros1

    expected = {key: entry["md5"] for key, entry in theirs.items()}
    own = aioros1.MessageStore([bundle()], parent=None)
    assert {key: load(own, *key)._md5sum for key in theirs} == expected
    assert {key: load(aioros1, *key)._md5sum for key in theirs} == expected
    # All of std_msgs, sensor_msgs and geometry_msgs at the least.
    assert len(theirs) > 80


async def test_every_full_text_of_theirs_is_understood(
    theirs: dict[tuple[str, str], dict[str, Any]],
) -> None:
    """The text that their publishers send makes the same type again."""
    import aioros1

    wrong = {}
    for (kind, name), entry in theirs.items():
        if kind == "msg":
            store = aioros1.MessageStore()
            cls = store.add_definition(name, entry["text"]) or store.load_msg(name)
            if cls._md5sum != entry["md5"]:
                wrong[name] = cls._md5sum
    assert wrong == {}


async def test_every_full_text_of_ours_holds_the_same_types_as_theirs(
    theirs: dict[tuple[str, str], dict[str, Any]],
) -> None:
    """Programs that know no type but what the text says depend on the `MSG:` lines."""
    import aioros1

    def parts(text: str) -> list[str]:
        return [line for line in text.splitlines() if line.startswith("MSG: ")]

    for (kind, name), entry in theirs.items():
        if kind == "msg":
            assert sorted(parts(aioros1.load_msg(name)._full_text)) == sorted(parts(entry["text"]))


@pytest.mark.parametrize(
    ("tool", "name"),
    [
        ("rosmsg", "sensor_msgs/JointState"),
        ("rosmsg", "geometry_msgs/PoseWithCovarianceStamped"),
        ("rossrv", "std_srvs/SetBool"),
        ("rossrv", "sensor_msgs/SetCameraInfo"),
    ],
)
async def test_the_md5_that_the_tools_print(under_rosmaster: World, tool: str, name: str) -> None:
    import aioros1

    kind = "msg" if tool == "rosmsg" else "srv"
    result = await under_rosmaster.run(tool, "md5", name)
    assert result.stdout.strip() == load(aioros1, kind, name)._md5sum


async def test_definitions_of_the_package_path_go_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """With ROS_PACKAGE_PATH set as on a ROS system, its files make the same types."""
    import aioros1

    debian.require("/usr/share/sensor_msgs/msg/JointState.msg")
    own = aioros1.MessageStore([bundle()], parent=None)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(SHARE))
    store = aioros1.MessageStore()
    assert store.find("sensor_msgs/JointState") == SHARE / "sensor_msgs/msg/JointState.msg"
    there = aioros1.MessageStore([SHARE], parent=None)
    assert {name: there.load_msg(name)._md5sum for name in ON_DISK} == {
        name: own.load_msg(name)._md5sum for name in ON_DISK
    }


async def test_bytes_of_rospy_are_the_bytes_we_make(under_rosmaster: World) -> None:
    """A message serialised by rospy is byte for byte what ours makes of it."""
    import aioros1

    world = under_rosmaster
    topic = world.unique("bytes")
    fields = world.fields(
        header={"frame_id": "map", "stamp": {"secs": 1, "nsecs": 2}},
        pose={"position": {"x": 0.1, "y": -0.0}, "orientation": {"w": 1.0}},
    )
    async with (
        world.node("ours") as node,
        node.subscribe(topic, "geometry_msgs/PoseStamped") as sub,
    ):
        world.rospy("talker", topic, "geometry_msgs/PoseStamped", fields, "--count", "1")
        async with asyncio.timeout(15):
            async for event in sub.events():
                cls = aioros1.load_msg("geometry_msgs/PoseStamped")
                assert event.message.to_bytes() == bytes(event.raw)
                assert cls.from_bytes(event.raw) == event.message
                break
