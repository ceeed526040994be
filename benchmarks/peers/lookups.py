"""Clients that ask a master for a node, each on a connection it keeps.

    lookups.py clients=N count=N

The same for every master: ``http.client`` and a request made once. Each client is a process,
and ``count`` is the number of look-ups of all of them.
"""

import http.client
import multiprocessing
import os
import sys
import time
import urllib.parse
import xmlrpc.client

from measures import report_times

NODE = "/benchmark_node"


def ask(address, count, barrier, results):
    body = xmlrpc.client.dumps(("/benchmark", NODE), "lookupNode").encode()
    headers = {"Content-Type": "text/xml"}
    connection = http.client.HTTPConnection(*address)
    times = []
    for turn in range(count + 1):
        start = time.perf_counter()
        connection.request("POST", "/RPC2", body, headers)
        answer = connection.getresponse().read()
        times.append(time.perf_counter() - start)
        if not turn:  # the first one connects; it is not counted
            if b"http://localhost:1/" not in answer:
                raise SystemExit(f"not the answer: {answer!r}")
            barrier.wait()
    barrier.wait()
    results.put(times[1:])


def main(options):
    clients, count = int(options["clients"]), int(options["count"])
    uri = urllib.parse.urlsplit(os.environ["ROS_MASTER_URI"])
    master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
    # Registered for good: nobody ever calls that address.
    master.registerPublisher(NODE, "/benchmark", "std_msgs/String", "http://localhost:1/")
    fork = multiprocessing.get_context("fork")
    barrier, results = fork.Barrier(clients + 1), fork.SimpleQueue()
    arguments = ((uri.hostname, uri.port), count // clients, barrier, results)
    processes = [fork.Process(target=ask, args=arguments) for _ in range(clients)]
    for process in processes:
        process.start()
    barrier.wait(60)
    start = time.perf_counter()
    barrier.wait(300)
    seconds = time.perf_counter() - start
    times = [time for _ in processes for time in results.get()]
    for process in processes:
        process.join()
    report_times(times, seconds)


if __name__ == "__main__":
    main(dict(word.split("=", 1) for word in sys.argv[1:]))
