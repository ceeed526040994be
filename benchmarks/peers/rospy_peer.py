"""One side of a benchmark, with rospy: ``MODE name=value ...``, as every peer here.

Publishers have no queue: rospy then writes to the socket in ``publish``, which is the
faster of its two ways by far, and loses nothing. What comes back is answered where it
arrives, in the callback, which spares rospy the way to another thread.
"""

import gc
import signal
import sys
import threading
import time
from itertools import chain, repeat

import rospy
from geometry_msgs.msg import TransformStamped
from measures import cpu, report, report_times
from sensor_msgs.msg import Image, JointState, PointCloud2
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse

TOPIC = "benchmark"
IDLE = 3.0  # seconds without a message after which the rest is taken as lost
TYPES = {cls.__name__: cls for cls in (Image, JointState, PointCloud2, String, TransformStamped)}


def make_message(options):
    kind, size = options["kind"], int(options.get("size", 0))
    message = TYPES[kind]()
    if kind == "String":
        message.data = "x" * size
    elif kind == "JointState":
        message.header.frame_id = "base_link"
        message.name = [f"joint_{i}" for i in range(6)]
        message.position = message.velocity = message.effort = [0.5] * 6
    elif kind == "TransformStamped":
        message.header.frame_id, message.child_frame_id = "odom", "base_link"
        message.transform.rotation.w = 1.0
    else:
        message.header.frame_id = "camera"
        message.data = bytes(size)
    return message


def topics(options, number=1):
    """The topic, ``number`` times; or those that ``topics=N`` asks for."""
    many = int(options.get("topics", 0))
    return [f"{TOPIC}_{i}" for i in range(many)] if many else [TOPIC] * number


def pub(options):
    message = make_message(options)
    count, rate = int(options["count"]), int(options.get("rate", 0))
    start = time.perf_counter()
    pubs = [rospy.Publisher(topic, type(message), queue_size=None) for topic in topics(options)]
    setup = time.perf_counter() - start
    for pub in pubs:
        while pub.get_num_connections() < int(options.get("links", 1)):
            time.sleep(0.01)
    used, start = cpu(), time.perf_counter()
    if rate:
        pace = rospy.Rate(rate)
        for _ in range(count):
            pubs[0].publish(message)
            pace.sleep()
    else:
        for pub in chain.from_iterable(repeat(pubs, count)):
            pub.publish(message)
    used, seconds = cpu() - used, time.perf_counter() - start
    for pub in pubs:
        while pub.get_num_connections():
            time.sleep(0.01)
    report(cpu=used, seconds=seconds, setup=setup)


def sub(options):
    names = topics(options, int(options.get("subscribers", 1)))
    total = int(options["count"]) * len(names)
    done = threading.Event()
    state = {"received": 0, "first": 0.0, "last": 0.0, "used": 0.0}

    def callback(_):
        now = time.perf_counter()
        if not state["received"]:
            state["first"] = now
            state["used"] = cpu()
        state["received"] += 1
        state["last"] = now
        if state["received"] == total:
            done.set()

    start = time.perf_counter()
    for topic in names:
        rospy.Subscriber(topic, TYPES[options["kind"]], callback)
    setup = time.perf_counter() - start
    report(ready=1)
    while not done.wait(0.2):
        if state["received"] and time.perf_counter() - state["last"] > IDLE:
            break
    report(
        received=state["received"],
        seconds=state["last"] - state["first"],
        cpu=cpu() - state["used"],
        setup=setup,
    )


def ping(options):
    message = make_message(options)
    count = int(options["count"])
    done = threading.Event()
    times = []
    state = {"start": 0.0}

    def callback(_):
        now = time.perf_counter()
        times.append(now - state["start"])
        if len(times) == count + count // 10:
            done.set()
            return
        state["start"] = time.perf_counter()
        pub.publish(message)

    pub = rospy.Publisher("ping", type(message), queue_size=None, tcp_nodelay=True)
    sub = rospy.Subscriber("pong", type(message), callback, tcp_nodelay=True)
    while not (pub.get_num_connections() and sub.get_num_connections()):
        time.sleep(0.01)
    time.sleep(0.2)  # so that the other side has seen both connections as well
    state["start"] = time.perf_counter()
    pub.publish(message)
    done.wait()
    report_times(times[count // 10 :])


def pong(options):
    cls = TYPES[options["kind"]]
    pub = rospy.Publisher("pong", cls, queue_size=None, tcp_nodelay=True)
    rospy.Subscriber("ping", cls, pub.publish, tcp_nodelay=True)
    threading.Event().wait()


def serve(options):
    rospy.Service("flip", SetBool, lambda request: SetBoolResponse(request.data, "ok"))
    threading.Event().wait()


def call(options):
    count = int(options["count"])
    times = []
    rospy.wait_for_service("flip")
    proxy = rospy.ServiceProxy("flip", SetBool, persistent=options["persistent"] == "1")
    for _ in range(count + count // 10):
        start = time.perf_counter()
        reply = proxy(True)
        times.append(time.perf_counter() - start)
    assert reply.success
    report_times(times[count // 10 :])


def idle(options):
    rospy.Publisher("out", String, queue_size=10)
    rospy.Subscriber("in", String)
    report(ready=1)
    threading.Event().wait()


def host(_):
    """There for others to connect to; a message now and then shows which are gone."""
    rospy.Service("flip", SetBool, lambda request: SetBoolResponse(request.data, "ok"))
    pub = rospy.Publisher(TOPIC, String, queue_size=None)

    def tell(*_):
        gc.collect()
        report(objects=len(gc.get_objects()))

    signal.signal(signal.SIGUSR1, tell)
    report(ready=1)
    pace = rospy.Rate(10)
    while True:
        pub.publish("x")
        pace.sleep()


MODES = {mode.__name__: mode for mode in (pub, sub, ping, pong, serve, call, idle, host)}

if __name__ == "__main__":
    rospy.init_node(sys.argv[1], disable_signals=True)
    MODES[sys.argv[1]](dict(word.split("=", 1) for word in sys.argv[2:]))
    rospy.signal_shutdown("done")
