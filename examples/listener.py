"""Prints what is published on /chatter, and by whom, until it is interrupted.

python examples/listener.py [chatter:=another_topic]
"""

import aioros1
from aioros1.msg.std_msgs import String


async def main(node: aioros1.Node) -> None:
    async with node.subscribe("chatter", String) as sub:
        async for event in sub.events():
            print(f"{event.header['callerid']} says: {event.message.data}")


if __name__ == "__main__":
    aioros1.run(main)
