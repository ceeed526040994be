"""The rosservice tool with our services."""

from __future__ import annotations

from typing import Any

from .world import World

SET_BOOL = "std_srvs/SetBool"


def flip(request: Any) -> dict[str, Any]:
    if not request.data:
        raise ValueError("no way to switch it off")
    return {"success": True, "message": "it is on"}


async def test_list_find_and_node(under_each: World) -> None:
    world = under_each
    service = world.unique("flip")
    async with world.node("ours") as node, node.advertise_service(service, SET_BOOL, flip):
        assert service in (await world.run("rosservice", "list")).stdout.split()
        found = (await world.run("rosservice", "find", SET_BOOL)).stdout.split()
        assert service in found
        assert (await world.run("rosservice", "node", service)).stdout.strip() == "/ours"


async def test_type_info_args_and_uri(under_each: World) -> None:
    world = under_each
    service = world.unique("flip")
    async with (
        world.node("ours") as node,
        node.advertise_service(service, SET_BOOL, flip) as provider,
    ):
        assert (await world.run("rosservice", "type", service)).stdout.strip() == SET_BOOL
        uri = (await world.run("rosservice", "uri", service)).stdout.strip()
        assert uri == await node.master.lookup_service(service)
        assert uri.startswith("rosrpc://localhost:")
        info = (await world.run("rosservice", "info", service)).stdout.splitlines()
        assert info == ["Node: /ours", f"URI: {uri}", f"Type: {SET_BOOL}", "Args: data"]
        assert (await world.run("rosservice", "args", service)).stdout.strip() == "data"
        # Probing is not calling.
        assert provider.stats.messages == 0


async def test_call(under_each: World) -> None:
    world = under_each
    service = world.unique("flip")
    async with world.node("ours") as node, node.advertise_service(service, SET_BOOL, flip):
        result = await world.run("rosservice", "call", service, "data: true")
        assert result.stdout.splitlines() == ["success: True", 'message: "it is on"']
        failed = await world.run("rosservice", "call", service, "data: false", code=2)
        assert "no way to switch it off" in failed.text


async def test_call_of_a_nested_type(under_rosmaster: World) -> None:
    world = under_rosmaster
    service = world.unique("camera")

    async def answer(request: Any) -> dict[str, Any]:
        info = request.camera_info
        return {"success": True, "status_message": f"{info.header.frame_id} {list(info.D)}"}

    async with (
        world.node("ours") as node,
        node.advertise_service(service, "sensor_msgs/SetCameraInfo", answer),
    ):
        request = "{camera_info: {header: {frame_id: lens}, D: [0.5]}}"
        text = (await world.run("rosservice", "call", service, request)).stdout
        assert 'status_message: "lens [0.5]"' in text


async def test_a_service_that_is_gone(under_rosmaster: World) -> None:
    world = under_rosmaster
    service = world.unique("flip")
    async with world.node("ours") as node:
        async with node.advertise_service(service, SET_BOOL, flip):
            pass
        failed = await world.run("rosservice", "call", service, "data: true", code=None)
        assert failed.code != 0
        assert "not available" in failed.text
