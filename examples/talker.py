"""Publishes a greeting on /chatter until it is interrupted.

python examples/talker.py [_rate:=10] [chatter:=another_topic]
"""

import aioros1
from aioros1.msg.std_msgs import String


async def main(node: aioros1.Node) -> None:
    hz = await node.get_param("~rate", 10)
    async with node.advertise("chatter", String) as pub:
        count = 0
        async for _ in node.rate(hz):  # ends with the node
            count += 1
            text = f"hello world {count}"
            print(text)
            pub.publish(data=text)


if __name__ == "__main__":
    aioros1.run(main)
