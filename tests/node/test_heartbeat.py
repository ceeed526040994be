"""A master that goes away, comes back, or is another one."""

from __future__ import annotations

import asyncio

import aioros1
from aioros1.msg.std_msgs import String


async def next_of(events, kind):
    async with asyncio.timeout(10):
        async for event in events:
            if isinstance(event, kind):
                return event
    raise AssertionError(f"no {kind.__name__}")


async def test_everything_is_registered_again_at_a_restarted_master():
    async with aioros1.Master(host="localhost", port=0, rosout=False) as old:
        port = old.port
        node = aioros1.Node("survivor", master_uri=old.uri, host="localhost", heartbeat=0.02)
        await node.start()
        events = node.events()
        pub = await node.advertise("chatter", String)
        sub = await node.subscribe("chatter", String)
        await node.advertise_service("flip", "std_srvs/SetBool", lambda request: None)
        psub = await node.subscribe_param("/gain", default=1)
        await pub.wait_for_subscribers(timeout=30)
    lost = await next_of(events, aioros1.MasterLost)
    assert lost.uri == node.master_uri
    pub.publish(data="topics go on flowing")
    assert (await sub.get(timeout=30)).data == "topics go on flowing"
    async with aioros1.Master(
        host="localhost", port=port, rosout=False, params={"/gain": 2}
    ) as new:
        restarted = await next_of(events, aioros1.MasterRestarted)
        assert restarted.run_id == new.run_id == node.run_id
        state = await node.master.get_system_state()
        assert state.publishers["/chatter"] == state.subscribers["/chatter"] == ["/survivor"]
        assert state.services["/flip"] == ["/survivor"]
        assert await psub.wait_for(lambda value: value == 2, timeout=30) == 2
        async with aioros1.Node("other", master_uri=new.uri, host="localhost") as other:
            await other.set_param("/gain", 3)
            assert await psub.wait_for(lambda value: value == 3, timeout=30) == 3
        await node.close()
        assert not any(await_state := await system_state(new.uri)), await_state


async def system_state(uri):
    async with aioros1.Node(
        "looker", master_uri=uri, host="localhost", rosout=False, logger_services=False
    ) as node:
        return await node.master.get_system_state()


async def test_a_master_that_was_replaced_without_a_gap_is_noticed(monkeypatch, make_node):
    node = await make_node("node", heartbeat=0.02)
    events = node.events()
    await node.advertise("chatter", String)
    # Another run id is all that tells a master that was replaced between two beats.
    await node.set_param("/run_id", "another")
    assert (await next_of(events, aioros1.MasterRestarted)).run_id == "another"


async def test_a_node_that_was_started_before_its_master_greets_it_later():
    async with aioros1.Master(host="localhost", port=0, rosout=False) as reserved:
        port = reserved.port
    uri = f"http://localhost:{port}"
    async with aioros1.Node("early", master_uri=uri, host="localhost", argv=["_x:=1"]) as node:
        waiting = asyncio.create_task(node.wait_for_master(timeout=10))
        async with aioros1.Master(host="localhost", port=port, rosout=False) as master:
            await waiting
            await aioros1.wait_for_master(uri, timeout=30)
            assert node.run_id == master.run_id
            async with asyncio.timeout(10):
                while not await node.has_param("~x"):
                    await asyncio.sleep(0.01)


async def test_no_heartbeat_if_none_is_wanted(make_node):
    node = await make_node("node", heartbeat=None)
    assert not [task for task in asyncio.all_tasks() if "heartbeat" in task.get_name()]
    assert node.is_open


async def test_publishers_that_a_new_master_does_not_know_stay_connected(monkeypatch):
    """rospy and roscpp never register again; what they publish may come rarely."""
    monkeypatch.setattr("aioros1.topics.subscription._GRACE", 0.01)
    async with aioros1.Master(host="localhost", port=0, rosout=False) as old:
        port = old.port
        options = {"master_uri": old.uri, "host": "localhost"}
        publisher = aioros1.Node("publisher", heartbeat=None, **options)
        subscriber = aioros1.Node("subscriber", heartbeat=0.02, **options)
        await publisher.start()
        await subscriber.start()
        pub = await publisher.advertise("map", String)
        sub = await subscriber.subscribe("map", String)
        await pub.wait_for_subscribers(timeout=30)
        events = subscriber.events()
    async with aioros1.Master(host="localhost", port=port, rosout=False) as new:
        await next_of(events, aioros1.MasterRestarted)
        # Another publisher makes the master tell of all that it knows.
        async with (
            aioros1.Node("another", master_uri=new.uri, host="localhost") as another,
            another.advertise("map", String) as other,
        ):
            await other.wait_for_subscribers(timeout=30)
        async with asyncio.timeout(30):
            while sub.publisher_count != 1:  # the other one has left
                await asyncio.sleep(0.01)
        pub.publish(data="still here")
        assert (await sub.get(timeout=30)).data == "still here"
        # Once the new master knows it, its list counts again.
        await publisher.master.register_publisher(pub.name, pub.type, publisher.uri)
        await publisher.master.unregister_publisher(pub.name, publisher.uri)
        async with asyncio.timeout(30):
            while sub.publisher_count:
                await asyncio.sleep(0.01)
        await subscriber.close()
        await publisher.close()
