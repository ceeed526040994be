"""A walk through the library: everything a program can ask of a node, once.

python examples/api_tour.py

It talks to itself through a master, prints what it sees, and ends.
"""

import asyncio

import aioros1
from aioros1.msg.geometry_msgs import Twist, Vector3
from aioros1.srv.std_srvs import SetBool


def title(text: str) -> None:
    print(f"\n{text}\n{'-' * len(text)}")


async def topics(node: aioros1.Node) -> None:
    title("Topics")
    async with (
        node.advertise("cmd_vel", Twist, latch=True) as pub,
        node.subscribe("cmd_vel", "geometry_msgs/Twist") as sub,  # a class or a name
    ):
        await pub.wait_for_subscribers(timeout=5)
        pub.publish(linear=Vector3(x=0.5))  # or a Twist, or {"linear": {"x": 0.5}}
        message = await sub.get(timeout=5)
        print("received:", message)

        message.angular.z = 0.1
        await pub.send(message)  # waits until every subscriber has room
        await pub.drain(timeout=5)  # and until the operating system has taken it
        event = await anext(sub.events())
        print(f"from {event.header['callerid']}, {len(event.raw)} bytes")

        async with node.subscribe("cmd_vel") as anything:  # of whatever type
            print("latched:", (await anything.get(timeout=5)).angular.z)
        print("counted:", pub.stats, sub.stats)


async def services(node: aioros1.Node) -> None:
    title("Services")

    async def switch(request: SetBool.Request) -> dict:
        if request.data and not node.is_open:
            raise aioros1.ServiceError("too late")
        return {"success": True, "message": "on" if request.data else "off"}

    async with (
        node.advertise_service("switch", SetBool, switch),
        node.service_caller("switch", SetBool, persistent=True, timeout=5) as caller,
    ):
        print("available:", await caller.is_available())
        print("answered:", (await caller.call(data=True)).message)
        pending = caller.send_request(data=False)  # a task: other work can be done now
        print("answered:", (await pending).message)

    # Without a handler the calls are iterated, and answered when their time has come.
    async with node.advertise_service("later", SetBool) as provider:
        pending = asyncio.create_task(node.call("later", SetBool, data=True, timeout=5))
        call = await anext(provider)
        await call.fail(f"not now, {call.caller_id}")
        try:
            await pending
        except aioros1.ServiceError as error:
            print("refused:", error.text)


async def parameters(node: aioros1.Node) -> None:
    title("Parameters")
    await node.set_param("arm/speed", 0.25)
    async with node.subscribe_param("arm", default=None) as arm:
        await node.set_param("arm/grip", {"force": 5, "soft": True})
        print("update:", await anext(arm))
        print("all of it:", arm.value)
        print("found:", await node.search_param("arm"), "in", await node.get_param_names())
        await node.delete_param("arm")
        print("deleted:", await arm.wait_for(lambda value: value is None, timeout=5))


async def graph(node: aioros1.Node) -> None:
    title("Master, graph and peers")
    print("master:", await node.master.get_uri(), f"in {await node.master.ping() * 1e3:.1f} ms")
    snapshot = await node.graph.snapshot()
    print("nodes:", ", ".join(sorted(snapshot.nodes)))
    print("topics:", ", ".join(sorted(snapshot.topics)))

    async with aioros1.Node("other", master_uri=node.master_uri, heartbeat=None) as other:
        await node.graph.wait_for(lambda graph: other.name in graph.nodes, timeout=5)
        peer = await node.peer("/other")
        print("peer:", peer.uri, "has pid", await peer.get_pid())
        print("its topics:", ", ".join(topic.name for topic in await peer.get_publications()))
        await peer.shutdown("the tour is over")
        print("it ended:", await other.wait_closed())


async def main(node: aioros1.Node) -> None:
    title("Node")
    print(f"{node.name} at {node.uri}, topics and services at {node.tcpros_address}")
    print("`scan` and `~rate` mean", node.resolve_name("scan"), "and", node.resolve_name("~rate"))
    node.log.info("this goes to /rosout, and to the handlers of logging if there are any")
    events = node.events()  # from now on

    for part in (topics, services, parameters, graph):
        await part(node)

    title("Time")
    started = node.now()
    await node.sleep(0.1)
    print("slept:", (node.now() - started).to_sec() >= 0.1)

    title("What has happened, in events")
    await node.close()  # `run` would do it; the iteration ends with the node
    counts: dict[str, int] = {}
    async for event in events:
        kind = type(event).__name__
        counts[kind] = counts.get(kind, 0) + 1
    for kind in sorted(counts):
        print(f"{kind}: {counts[kind]}")


if __name__ == "__main__":
    aioros1.run(main)
