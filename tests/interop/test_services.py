"""Services between our nodes and those of rospy and roscpp."""

from __future__ import annotations

import json
from typing import Any

import pytest

from .processes import Process, until
from .world import World

SET_BOOL = "std_srvs/SetBool"
CAMERA = "sensor_msgs/SetCameraInfo"
TRUE, FALSE = '{"data": true}', '{"data": false}'


async def flip(request: Any) -> dict[str, Any]:
    if not request.data:
        raise ValueError("no way to switch it off")
    return {"success": True, "message": "it is on"}


async def server(world: World, client: str, service: str, *, error: str = "") -> Process:
    """A SetBool of another library. With ``error``, data=false fails; rospy always fails."""
    if client == "roscpp":
        return await world.roscpp_ready("server", service, error)
    reply = world.fields(success=True, message="it is on")
    failure = ("--error", error) if error else ()
    return await world.rospy_ready("server", service, SET_BOOL, "--reply", reply, *failure)


# Our provider


async def test_rospy_calls_us(under_each: World) -> None:
    world = under_each
    service = world.unique("flip")
    async with world.node("ours") as node, node.advertise_service(service, SET_BOOL, flip):
        client = world.rospy("client", service, SET_BOOL, TRUE, FALSE, TRUE)
        await client.wait_values("done")
        assert client.values("answer") == [{"success": True, "message": "it is on"}] * 2
        assert client.values("kind") == ["ServiceException"]
        assert "no way to switch it off" in client.values("error")[0]


async def test_rospy_calls_us_on_one_connection(under_rosmaster: World) -> None:
    world = under_rosmaster
    service = world.unique("flip")
    async with (
        world.node("ours") as node,
        node.advertise_service(service, SET_BOOL, flip) as provider,
    ):
        client = world.rospy(
            "client", service, SET_BOOL, TRUE, FALSE, TRUE, "--persistent", "--step"
        )
        await client.wait_values("ready")
        client.tell("")
        await client.wait_values("answer", 1)
        (connection,) = provider.connections
        client.tell("")
        # The text of the failure arrives, and the connection goes on.
        assert "no way to switch it off" in (await client.wait_values("error", 1))[0]
        assert provider.connections == (connection,)
        client.tell("")
        await client.wait_values("answer", 2)
        await client.wait_values("done")
        await until(lambda: not provider.connections, what="the connection to be closed")


@pytest.mark.parametrize("persistent", [False, True], ids=["plain", "persistent"])
async def test_roscpp_calls_us(under_each: World, persistent: bool) -> None:
    world = under_each
    service = world.unique("flip")
    async with (
        world.node("ours") as node,
        node.advertise_service(service, SET_BOOL, flip) as provider,
    ):
        client = world.roscpp("client", service, "4", "1" if persistent else "0")
        await client.wait_values("done")
        assert client.values("answer") == [{"success": True, "message": "it is on"}] * 2
        # A failed call leaves roscpp's persistent client usable.
        assert client.values("failed") == ["valid", "valid"]
        assert provider.stats.messages == 4
        assert provider.stats.errors == 2
        await until(lambda: not provider.connections, what="all connections to be closed")


async def test_roscpp_prints_the_text_of_our_failure(under_rosmaster: World) -> None:
    world = under_rosmaster
    service = world.unique("flip")
    async with world.node("ours") as node, node.advertise_service(service, SET_BOOL, flip):
        client = world.roscpp("client", service, "2", "0")
        await client.wait_text("no way to switch it off")


async def test_our_answers_may_be_deferred_and_overtake(under_rosmaster: World) -> None:
    """Two callers wait at once; the second is answered first."""
    world = under_rosmaster
    service = world.unique("flip")
    async with (
        world.node("ours") as node,
        node.advertise_service(service, SET_BOOL) as provider,
    ):
        first = world.rospy("client", service, SET_BOOL, TRUE, "--name", "first")
        one = await anext(aiter(provider))
        second = world.rospy("client", service, SET_BOOL, FALSE, "--name", "second")
        two = await anext(aiter(provider))
        assert (one.request.data, two.request.data) == (True, False)
        await two.fail("not this one")
        assert "not this one" in (await second.wait_values("error"))[0]
        assert first.values("answer") == []
        await one.reply(success=True, message="late")
        assert await first.wait_values("answer") == [{"success": True, "message": "late"}]


async def test_rospy_means_another_type_than_we(under_rosmaster: World) -> None:
    world = under_rosmaster
    service = world.unique("flip")
    async with (
        world.node("ours") as node,
        node.advertise_service(service, SET_BOOL, flip) as provider,
    ):
        client = world.rospy("client", service, "std_srvs/Trigger", "{}")
        (error,) = await client.wait_values("error")
        assert "md5sum" in error
        assert provider.stats.messages == 0
        good = world.rospy("client", service, SET_BOOL, TRUE, "--name", "good")
        await good.wait_values("answer")


async def test_nested_types_both_ways_with_roscpp(under_each: World) -> None:
    import aioros1

    world = under_each
    ours, theirs = world.unique("camera"), world.unique("camera")

    def answer(request: Any) -> dict[str, Any]:
        info = request.camera_info
        text = f"{info.header.frame_id} {list(info.D)} {sum(info.K)} {info.roi.width}"
        return {"success": True, "status_message": text}

    async with (
        world.node("ours") as node,
        node.advertise_service(ours, CAMERA, answer),
    ):
        client = world.roscpp("camera_client", ours, "__name:=client")
        assert await client.wait_values("status") == ["lens [0.5, -0.25] 1.0 640"]

        await world.roscpp_ready("camera_server", theirs, "__name:=server")
        info = {
            "header": {"frame_id": "lens"},
            "D": [1.5],
            "K": [float(i) for i in range(9)],
            "roi": {"width": 3, "do_rectify": True},
        }
        request = aioros1.load_srv(CAMERA).Request.from_dict({"camera_info": info})
        reply = await node.call(theirs, CAMERA, request, timeout=10)
        assert reply.success is True
        seen = {"frame_id": "lens", "D": [1.5], "K": list(range(9)), "width": 3}
        assert json.loads(reply.status_message) == seen


# Our caller


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_we_call(under_each: World, client: str) -> None:
    world = under_each
    service = world.unique("flip")
    async with world.node("ours") as node:
        process = await server(world, client, service)
        await node.wait_for_service(service, timeout=15)
        reply = await node.call(service, SET_BOOL, timeout=10, data=True)
        assert (reply.success, reply.message) == (True, "it is on")
        async with node.service_caller(service, SET_BOOL) as caller:
            assert await caller.is_available()
            assert (await caller(data=True, timeout=10)).success is True
            assert caller.connections == ()
        expected = {"data": True} if client == "rospy" else True
        assert process.values("request") == [expected, expected]


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_we_call_without_knowing_the_type(under_each: World, client: str) -> None:
    """The provider is asked as rosservice asks it, and does not take that for a call."""
    world = under_each
    service = world.unique("flip")
    process = await server(world, client, service)
    async with world.node("ours") as node:
        assert await node.service_type(service) == SET_BOOL
        reply = await node.call(service, timeout=10, data=True)
        assert (reply.success, reply.message) == (True, "it is on")
        async with node.service_caller(service, persistent=True) as caller:
            assert caller.type == SET_BOOL
            assert [(await caller(data=True, timeout=10)).success for _ in range(2)] == [True, True]
        expected = {"data": True} if client == "rospy" else True
        assert process.values("request") == [expected] * 3
        # Nested types, and those of which every node has some.
        owner = {"rospy": "/rospy_server", "roscpp": "/roscpp_peer"}[client]
        loggers = (await node.call(f"{owner}/get_loggers", timeout=10)).loggers
        assert {type(entry)._type for entry in loggers} == {"roscpp/Logger"}


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_their_type_is_not_known_here(under_rosmaster: World, client: str) -> None:
    import aioros1

    world = under_rosmaster
    service = world.unique("flip")
    await server(world, client, service)
    empty = aioros1.MessageStore(parent=None)
    async with world.node("ours", store=empty, rosout=False, logger_services=False) as node:
        with pytest.raises(aioros1.MessageNotFoundError) as caught:
            await node.call(service, timeout=10, data=True)
        owner = {"rospy": "/rospy_server", "roscpp": "/roscpp_peer"}[client]
        for part in (f"service {service} of {owner} has type {SET_BOOL}", "searched: no directory"):
            assert part in str(caught.value)


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_we_call_on_one_connection(under_rosmaster: World, client: str) -> None:
    world = under_rosmaster
    service = world.unique("flip")
    await server(world, client, service)
    async with (
        world.node("ours") as node,
        node.service_caller(service, SET_BOOL, persistent=True) as caller,
    ):
        await caller.call(data=True, timeout=10)
        (connection,) = caller.connections
        for _ in range(20):
            assert (await caller.call(data=True, timeout=10)).success is True
        assert caller.connections == (connection,)
        # Requests that are sent without waiting are answered one after the other.
        pending = [caller.send_request(data=True, timeout=10) for _ in range(5)]
        assert [(await reply).success for reply in pending] == [True] * 5
        assert caller.connections == (connection,)


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
@pytest.mark.parametrize("persistent", [False, True], ids=["plain", "persistent"])
async def test_the_text_of_their_failure(
    under_rosmaster: World, client: str, persistent: bool
) -> None:
    import aioros1

    world = under_rosmaster
    service = world.unique("flip")
    await server(world, client, service, error="the valve is stuck")
    async with (
        world.node("ours") as node,
        node.service_caller(service, SET_BOOL, persistent=persistent) as caller,
    ):
        for _ in range(2):
            with pytest.raises(aioros1.ServiceError, match="the valve is stuck") as caught:
                await caller.call(data=False, timeout=10)
            assert not isinstance(caught.value, aioros1.ServiceUnavailable)
            assert "the valve is stuck" in caught.value.text
        if client == "roscpp":
            assert (await caller.call(data=True, timeout=10)).success is True


async def test_a_roscpp_server_that_returns_false(under_rosmaster: World) -> None:
    """There is no text in such an answer."""
    import aioros1

    world = under_rosmaster
    service = world.unique("flip")
    await server(world, "roscpp", service, error="false")
    async with world.node("ours") as node:
        with pytest.raises(aioros1.ServiceError) as caught:
            await node.call(service, SET_BOOL, timeout=10, data=False)
        assert not isinstance(caught.value, aioros1.ServiceUnavailable)
        assert caught.value.text == ""


async def test_a_rospy_server_that_returns_nothing(under_rosmaster: World) -> None:
    import aioros1

    world = under_rosmaster
    service = world.unique("flip")
    await world.rospy_ready("server", service, SET_BOOL, "--none")
    async with world.node("ours") as node:
        with pytest.raises(aioros1.ServiceError, match="None"):
            await node.call(service, SET_BOOL, timeout=10, data=True)


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_they_mean_another_type_than_we(under_rosmaster: World, client: str) -> None:
    import aioros1

    world = under_rosmaster
    service = world.unique("flip")
    await server(world, client, service)
    async with world.node("ours") as node:
        with pytest.raises(aioros1.HandshakeError, match="md5sum"):
            await node.call(service, "std_srvs/Trigger", timeout=10)
        assert (await node.call(service, SET_BOOL, timeout=10, data=True)).success is True


@pytest.mark.parametrize("client", ["rospy", "roscpp"])
async def test_the_loggers_of_their_nodes(under_rosmaster: World, client: str) -> None:
    """Every node of theirs tells them, with a nested answer."""
    world = under_rosmaster
    await server(world, client, world.unique("flip"))
    name, logger = {
        "rospy": ("/rospy_server", "rosout"),
        "roscpp": ("/roscpp_peer", "ros.roscpp"),
    }[client]
    async with world.node("ours") as node:
        reply = await node.call(f"{name}/get_loggers", "roscpp/GetLoggers", timeout=10)
        assert logger in {entry.name for entry in reply.loggers}
        assert {type(entry)._type for entry in reply.loggers} == {"roscpp/Logger"}
        if client == "rospy":  # Debian's roscpp crashes when it is told a level, whoever does
            level = {"logger": logger, "level": "ERROR"}
            await node.call(f"{name}/set_logger_level", "roscpp/SetLoggerLevel", level, timeout=10)
            reply = await node.call(f"{name}/get_loggers", "roscpp/GetLoggers", timeout=10)
            assert {entry.name: entry.level for entry in reply.loggers}[logger] == "ERROR"


async def test_rospy_calls_the_logger_services_of_our_node(under_rosmaster: World) -> None:
    world = under_rosmaster
    async with world.node("ours_logging") as node:
        getter = ("client", f"{node.name}/get_loggers", "roscpp/GetLoggers", "{}")
        (answer,) = await world.rospy(*getter).wait_values("answer")
        (logger,) = answer["loggers"]
        for level in ("debug", "error"):
            request = world.fields(logger=logger["name"], level=level)
            setter = world.rospy(
                "client", f"{node.name}/set_logger_level", "roscpp/SetLoggerLevel", request
            )
            assert await setter.wait_values("answer") == [{}]
            (answer,) = await world.rospy(*getter).wait_values("answer")
            assert answer["loggers"] == [{"name": logger["name"], "level": level}]


async def test_no_provider(under_each: World) -> None:
    import aioros1

    world = under_each
    service = world.unique("nobody")
    async with world.node("ours") as node:
        with pytest.raises(aioros1.ServiceNotFound):
            await node.call(service, SET_BOOL, timeout=10, data=True)
        with pytest.raises(TimeoutError):
            await node.wait_for_service(service, timeout=0.2)
