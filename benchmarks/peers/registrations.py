"""A client that fills a master, and then asks it, on one connection that it keeps.

    registrations.py fill=N count=N      registers N, then measures
    registrations.py churn=TOPIC count=N seconds=S
                                         a publisher of it that comes and goes, N times in S
    registrations.py paced=TOPIC count=N seconds=S
                                         N look-ups in S

The same for every master: ``http.client`` and requests made before the clock runs. Nobody
ever calls the addresses that are registered by ``fill``.
"""

import http.client
import os
import sys
import time
import urllib.parse
import xmlrpc.client

from measures import report, report_times

HEADERS = {"Content-Type": "text/xml"}
ADDRESS = "http://localhost:1/"
TOPICS = 10  # of each node
KINDS = ("registerPublisher",) * 6 + ("registerSubscriber",) * 2 + ("registerService",) * 2
STATE = 5  # times that the state of the whole system is asked for


class Client:
    def __init__(self):
        uri = urllib.parse.urlsplit(os.environ["ROS_MASTER_URI"])
        self.connection = http.client.HTTPConnection(uri.hostname, uri.port)

    def ask(self, body):
        """Seconds until the whole answer is there."""
        start = time.perf_counter()
        self.connection.request("POST", "/RPC2", body, HEADERS)
        answer = self.connection.getresponse().read()
        seconds = time.perf_counter() - start
        if b"<int>1</int>" not in answer and b"<i4>1</i4>" not in answer:
            raise SystemExit(f"refused: {answer!r}")
        return seconds


def body(method, *arguments):
    return xmlrpc.client.dumps(arguments, method).encode()


def registration(number):
    """Of the node and the name with this number; publishers and subscribers do not meet."""
    node, name = f"/node_{number // TOPICS}", f"/space/name_{number}"
    kind = KINDS[number % len(KINDS)]
    if kind == "registerService":
        return body(kind, node, name, "rosrpc://localhost:1", ADDRESS)
    return body(kind, node, name, "std_msgs/String", ADDRESS)


def fill(options):
    number, count = int(options["fill"]), int(options["count"])
    client = Client()
    for i in range(number):
        client.ask(registration(i))
    come = [
        body("registerPublisher", "/visitor", f"/visited_{i}", "std_msgs/String", ADDRESS)
        for i in range(count // 10)
    ]
    go = [
        body("unregisterPublisher", "/visitor", f"/visited_{i}", ADDRESS)
        for i in range(count // 10)
    ]
    changes = [client.ask(request) for pair in zip(come, go, strict=True) for request in pair]
    state = [client.ask(body("getSystemState", "/visitor")) for _ in range(STATE)]
    step = max(1, number // TOPICS // 100)
    nodes = [f"/node_{i}" for i in range(0, max(1, number // TOPICS), step)]
    requests = [body("lookupNode", "/visitor", node) for node in nodes]
    times = [client.ask(requests[i % len(requests)]) for i in range(count)]
    report(changes=len(changes) / sum(changes), state=sorted(state)[STATE // 2] * 1e3)
    report_times(times)


def paced(options, requests):
    """Each at its time; what it takes counts from when it was sent."""
    client = Client()
    seconds, times = float(options["seconds"]), []
    start = time.perf_counter()
    for number, request in enumerate(requests):
        time.sleep(max(0, start + seconds * number / len(requests) - time.perf_counter()))
        times.append(client.ask(request))
    report_times(times)


def main(options):
    if "fill" in options:
        fill(options)
    elif "churn" in options:
        what = ("/visitor", options["churn"])
        come = body("registerPublisher", *what, "std_msgs/String", ADDRESS)
        go = body("unregisterPublisher", *what, ADDRESS)
        paced(options, [come, go] * int(options["count"]))
    else:
        Client().ask(registration(0))
        paced(options, [body("lookupNode", "/visitor", "/node_0")] * int(options["count"]))


if __name__ == "__main__":
    main(dict(word.split("=", 1) for word in sys.argv[1:]))
