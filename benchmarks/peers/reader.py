"""Any number of connections to a publisher, which count what comes and do nothing with it.

    reader.py links=N count=N size=BYTES

The subscriber of the fan-out benchmark: the same for every publisher, so that only these
differ. Its frames are all of one size, so counting bytes is counting messages.
"""

import os
import selectors
import socket
import sys
import time
import xmlrpc.client

from measures import cpu, report

MD5SUM = "992ce8a1687cec8c8bd883ec73ca41d1"  # of std_msgs/String
IDLE = 3.0  # seconds without a byte after which the rest is taken as lost
CHUNK = 1 << 18


def publisher_address(topic, node):
    """Where the publisher listens, once it is there."""
    master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
    while True:
        code, _, uri = master.lookupNode("/reader", node)
        if code == 1:
            peer = xmlrpc.client.ServerProxy(uri)
            code, _, offer = peer.requestTopic("/reader", topic, [["TCPROS"]])
            if code == 1 and offer:
                return offer[1], offer[2]
        time.sleep(0.02)


def shake_hands(address, fields):
    """A connection to a node, when both headers have gone."""
    body = b"".join(len(field).to_bytes(4, "little") + field.encode() for field in fields)
    connection = socket.create_connection(address)
    connection.sendall(len(body).to_bytes(4, "little") + body)
    size = int.from_bytes(connection.recv(4, socket.MSG_WAITALL), "little")
    answer = connection.recv(size, socket.MSG_WAITALL)
    if b"md5sum=" not in answer:
        raise SystemExit(f"no connection: {answer!r}")
    return connection


def connect(address, topic, number):
    fields = [
        f"callerid=/reader_{number}",
        f"topic={topic}",
        f"md5sum={MD5SUM}",
        "type=std_msgs/String",
        "message_definition=string data\n",
        "tcp_nodelay=0",
    ]
    return shake_hands(address, fields)


def main(options):
    links, count = int(options["links"]), int(options["count"])
    frame = 8 + int(options["size"])
    namespace = os.environ["ROS_NAMESPACE"].rstrip("/")
    address = publisher_address(namespace + "/benchmark", namespace + "/pub")
    selector = selectors.DefaultSelector()
    for number in range(links):
        connection = connect(address, namespace + "/benchmark", number)
        selector.register(connection, selectors.EVENT_READ)
    buffer = bytearray(CHUNK)
    total, missing = 0, links * count * frame
    first = last = used = 0.0
    while missing:
        ready = selector.select(IDLE if total else None)
        if not ready:
            break
        if not total:
            first, used = time.perf_counter(), cpu()
        for key, _ in ready:
            got = key.fileobj.recv_into(buffer)
            total += got
            missing -= got
            if not got:
                selector.unregister(key.fileobj)
        last = time.perf_counter()
        if not selector.get_map():
            break
    report(received=total // frame, seconds=last - first, cpu=cpu() - used)


if __name__ == "__main__":
    main(dict(word.split("=", 1) for word in sys.argv[1:]))
