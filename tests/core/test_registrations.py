"""What happens to the registrations of a node when some of them fail or are never answered."""

from __future__ import annotations

import asyncio
import contextlib

import pytest

import aioros1
from aioros1.msg.std_msgs import String

from .scripted_master import HANG

QUICK = aioros1.Timeouts(xmlrpc=0.3, close=3)


async def until(holds, seconds=30):
    async with asyncio.timeout(seconds):
        while not await holds():
            await asyncio.sleep(0.01)


async def listed(observer, name):
    """The topics and services that the master lists of a node."""
    state = await observer.master.get_system_state()
    return {topic for part in state for topic, nodes in part.items() if name in nodes}


BAD = ["bad\x01name", "bad\ud800name", "bad\x0cname"]


@pytest.mark.parametrize("bad", BAD)
async def test_a_name_that_cannot_be_sent_spoils_nothing_for_others(make_node, bad):
    observer = await make_node("observer")
    node = await make_node("node", heartbeat=0.02, rosout=False, logger_services=False)
    events = node.events()
    pubs = [await node.advertise(f"/t{number}", String) for number in range(20)]
    for opening in (
        lambda: node.advertise(bad, String),
        lambda: node.subscribe(bad, String),
        lambda: node.advertise_service(bad, "std_srvs/Empty", lambda request: None),
        lambda: node.subscribe_param(bad, default=1),
    ):
        with pytest.raises(ValueError, match="cannot carry"):
            await opening()
    # At registering again, too.
    await observer.set_param("/run_id", "another")
    async with asyncio.timeout(30):
        async for event in events:
            if isinstance(event, aioros1.MasterRestarted):
                break
    assert await listed(observer, "/node") == {pub.name for pub in pubs}
    await node.close()
    assert await listed(observer, "/node") == set()


async def test_an_entry_that_a_new_master_refuses_spoils_nothing_for_others(
    script, make_node, caplog
):
    observer = await make_node("observer")
    node = await make_node("node", heartbeat=0.02, rosout=False, logger_services=False)
    events = node.events()
    for number in range(5):
        await node.advertise(f"/t{number}", String)
    script.script = lambda method, params: (
        RuntimeError("not this one") if params[1:2] == ("/t3",) else None
    )
    await observer.set_param("/run_id", "another")
    async with asyncio.timeout(30):
        async for event in events:
            if isinstance(event, aioros1.MasterRestarted):
                break
    beats = script.asked["getPid"]
    await until(lambda: _true(script.asked["getPid"] > beats + 10))
    # It was said once.
    said = [record for record in caplog.records if "cannot register" in record.getMessage()]
    assert len(said) == 1
    await node.advertise("/t9", String)
    await node.close()
    # It could not be unregistered either.
    assert await listed(observer, "/node") == {"/t3"}


async def _true(value):
    return value


@pytest.mark.parametrize("error", [ValueError, KeyError, OSError])
async def test_whatever_happens_to_one_entry_the_others_are_told(make_node, monkeypatch, error):
    """At registering again, and at closing."""
    observer = await make_node("observer")
    node = await make_node("node", heartbeat=0.02, rosout=False, logger_services=False)
    await node.advertise("/bad", String)
    pubs = [await node.advertise(f"/t{number}", String) for number in range(20)]
    for method in ("register_publisher", "unregister_publisher"):
        original = getattr(aioros1.MasterProxy, method)

        async def fail(self, topic, *params, original=original):
            if topic == "/bad":
                raise error("it cannot be sent")
            return await original(self, topic, *params)

        monkeypatch.setattr(aioros1.MasterProxy, method, fail)
    for number in range(3):
        events = node.events()
        await observer.set_param("/run_id", f"another {number}")
        async with asyncio.timeout(30):
            async for event in events:
                if isinstance(event, aioros1.MasterRestarted):
                    break
    await node.close()
    assert await listed(observer, "/node") == {"/bad"}
    assert len(pubs) == 20


@pytest.mark.parametrize("heartbeat", [None, 0.02])
async def test_a_registration_that_is_never_answered_can_be_made_again(
    script, make_node, heartbeat
):
    observer = await make_node("observer")
    node = await make_node("node", heartbeat=heartbeat, timeouts=QUICK)
    script.script = lambda method, params: (
        HANG if (method, params[1:2]) == ("registerPublisher", ("/t",)) else None
    )
    with pytest.raises(aioros1.MasterUnreachable, match="no answer of the master"):
        await node.advertise("/t", String)
    script.script = lambda method, params: None
    await node.advertise("/t", String)
    assert "/t" in await listed(observer, "/node")
    await node.close()
    assert await listed(observer, "/node") == set()


async def test_requests_without_an_answer_leave_room_for_others(script, make_node):
    observer = await make_node("observer")
    node = await make_node("node", timeouts=QUICK)
    events = node.events()
    script.script = lambda method, params: HANG if "stuck" in str(params[1:2]) else None
    stuck = [
        asyncio.ensure_future(_tried(node.advertise(f"/stuck{number}", String)))
        for number in range(30)
    ]
    await until(lambda: _true(len(script.hanging) >= 6))
    async with asyncio.timeout(30):
        for number in range(10):
            await node.advertise(f"/t{number}", String)
    await asyncio.gather(*stuck)
    async with asyncio.timeout(30):
        await node.advertise("/t", String)
    assert {"/t", "/t9"} <= await listed(observer, "/node")
    await node.close()
    assert await listed(observer, "/node") == set()
    assert not [event async for event in events if isinstance(event, aioros1.MasterLost)]


async def _opened(opening):
    return await opening


@pytest.mark.parametrize("heartbeat", [None, 0.02])
async def test_requests_that_are_obeyed_late_leave_what_is_wanted(script, make_node, heartbeat):
    """However many there are, and whatever was wanted in between."""
    observer = await make_node("observer")
    node = await make_node(
        "node", heartbeat=heartbeat, timeouts=QUICK, rosout=False, logger_services=False
    )
    kept = await node.advertise("/kept", String)
    script.script = lambda method, params: HANG if "egister" in method else None
    for _ in range(2):
        with pytest.raises(aioros1.MasterUnreachable):
            await node.advertise("/given_up", String)
    await kept.close()
    again = asyncio.ensure_future(_opened(node.advertise("/kept", String)))
    await until(lambda: _true(len(script.hanging) >= 4))
    script.script = lambda method, params: None
    script.release()
    with contextlib.suppress(aioros1.MasterUnreachable):
        await again
    if not again.exception():
        await until(lambda: _is(observer, {"/kept"}))
    else:
        await until(lambda: _is(observer, set()))


async def _is(observer, expected):
    return await listed(observer, "/node") == expected


async def _tried(opening):
    with contextlib.suppress(aioros1.MasterUnreachable):
        await opening
