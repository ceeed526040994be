"""Connections to one node, opened and closed, one after the other.

    visitors.py kind=topic|service count=N

The same for every node. A topic's is closed after the headers, a service's after one call.
"""

import os
import socket
import sys
import time
import urllib.parse
import xmlrpc.client

from measures import report_times
from reader import connect, publisher_address, shake_hands

MD5SUM = "09fb03525b03e7ea1fd3992bafd87e16"  # of std_srvs/SetBool
REQUEST = b"\1\0\0\0\1"  # one byte, True
REPLY = 1 + 4 + 7  # of success, the length, and True with "ok"


def service_address(service):
    """Where the provider listens, once it is there."""
    master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
    while True:
        code, _, uri = master.lookupService("/visitors", service)
        if code == 1:
            found = urllib.parse.urlsplit(uri)
            return found.hostname, found.port
        time.sleep(0.02)


def main(options):
    namespace = os.environ["ROS_NAMESPACE"].rstrip("/")
    topic, service = namespace + "/benchmark", namespace + "/flip"
    if options["kind"] == "topic":
        address = publisher_address(topic, namespace + "/host")
    else:
        address = service_address(service)
        fields = ["callerid=/visitor", f"service={service}", f"md5sum={MD5SUM}"]
    times = []
    for number in range(int(options["count"])):
        start = time.perf_counter()
        if options["kind"] == "topic":
            connection = connect(address, topic, number)
        else:
            connection = shake_hands(address, fields)
            connection.sendall(REQUEST)
            reply = connection.recv(REPLY, socket.MSG_WAITALL)
            if len(reply) != REPLY or not reply[0]:
                raise SystemExit(f"not the answer: {reply!r}")
        connection.close()
        times.append(time.perf_counter() - start)
    report_times(times)


if __name__ == "__main__":
    main(dict(word.split("=", 1) for word in sys.argv[1:]))
