"""A program that blocks: it reads lines from the keyboard, and the node lives in a thread.

python examples/chat.py [chatter:=room]

What you type is published, and what the others say is printed. Ctrl-D ends it.
"""

import sys

from aioros1.contrib.threads import NodeThread
from aioros1.msg.std_msgs import String


def main() -> None:
    with NodeThread("chat", anonymous=True, argv=sys.argv[1:]) as ros:
        pub = ros.run(ros.node.advertise("chatter", String))
        sub = ros.run(ros.node.subscribe("chatter", String))

        def show(event) -> None:  # called in the thread of the node
            speaker = event.header["callerid"]
            if speaker != ros.node.name:
                print(f"{speaker}: {event.message.data}", flush=True)

        ros.deliver(sub.events(), show)
        print("you are", ros.node.name, flush=True)
        for line in sys.stdin:
            ros.call(pub.publish, data=line.rstrip("\n"))
        ros.run(pub.drain(), timeout=1)


if __name__ == "__main__":
    main()
