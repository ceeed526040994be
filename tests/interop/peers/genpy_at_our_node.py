"""genpy's classes and messages at our node, master and all in one process.

Runs in the Python of the tests, with Debian's modules behind its own.
"""

import asyncio

import genpy
from geometry_msgs.msg import Point, PoseStamped
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse

import aioros1


async def main():
    async with (
        aioros1.Master(host="localhost", port=0) as master,
        aioros1.Node("both", master_uri=master.uri) as node,
        node.advertise("pose", PoseStamped) as pub,
        node.subscribe("pose", PoseStamped) as sub,
    ):
        assert pub.type == sub.type == "geometry_msgs/PoseStamped"
        assert pub.md5sum == sub.md5sum == PoseStamped._md5sum
        await pub.wait_for_subscribers(timeout=10)
        theirs = PoseStamped()
        theirs.header.stamp = genpy.Time(1, 2)
        theirs.pose.position.x = 1.5
        pub.publish(theirs)
        assert await sub.get(timeout=10) == theirs
        # Theirs as fields of ours, and from ours to theirs.
        pub.publish(header=theirs.header, pose={"position": Point(1, 2, 3)})
        ours = await sub.get(timeout=10)
        assert isinstance(ours, aioros1.load_msg("geometry_msgs/PoseStamped"))
        assert ours.pose.position == Point(1, 2, 3)
        assert ours.header.stamp == aioros1.Time(1, 2)
        assert PoseStamped().deserialize(ours.to_bytes()).pose.position.z == 3.0

        def flip(request):
            return SetBoolResponse(not request.data, "theirs")

        async with (
            node.advertise_service("flip", SetBool, flip),
            node.service_caller("flip", SetBool) as caller,
        ):
            assert caller.md5sum == SetBool._md5sum
            reply = await caller.call(SetBoolRequest(True), timeout=10)
            assert reply == SetBoolResponse(False, "theirs")
            reply = await node.call("flip", SetBool, SetBoolRequest(False), timeout=10)
            assert reply.success is True


if __name__ == "__main__":
    asyncio.run(main())
    print("done")
