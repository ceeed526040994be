"""One side of the topic benchmark, with rospy: ``pub`` or ``sub``, count, size.

The publisher has no queue: rospy then writes to the socket in ``publish``, which is the
faster of its two ways by far, and loses nothing.
"""

import json
import sys
import threading
import time

import rospy
from std_msgs.msg import String

TOPIC = "benchmark"
IDLE = 3.0  # seconds without a message after which the rest is taken as lost


def publish(count, size):
    pub = rospy.Publisher(TOPIC, String, queue_size=None)
    while not pub.get_num_connections():
        time.sleep(0.01)
    message = String(data="x" * size)
    for _ in range(count):
        pub.publish(message)
    while pub.get_num_connections():
        time.sleep(0.01)


def subscribe(count):
    done = threading.Event()
    state = {"received": 0, "first": 0.0, "last": 0.0}

    def callback(_):
        now = time.perf_counter()
        if not state["received"]:
            state["first"] = now
        state["received"] += 1
        state["last"] = now
        if state["received"] == count:
            done.set()

    rospy.Subscriber(TOPIC, String, callback)
    while not done.wait(0.2):
        if state["received"] and time.perf_counter() - state["last"] > IDLE:
            break
    seconds = state["last"] - state["first"]
    print(json.dumps({"received": state["received"], "seconds": seconds}), flush=True)


if __name__ == "__main__":
    role, count, size = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    rospy.init_node("bench_" + role, disable_signals=True)
    if role == "pub":
        publish(count, size)
    else:
        subscribe(count)
    rospy.signal_shutdown("done")
