"""The slave APIs of many nodes that subscribe to one topic, and take notice, no more.

    subscribed.py nodes=N topic=NAME

Each has a port of its own, as nodes have. With SIGUSR1 it tells how many notices came, and
begins to count anew.
"""

import asyncio
import os
import signal
import sys
import xmlrpc.client

from measures import report

BODY = xmlrpc.client.dumps(([1, "", 0],), methodresponse=True).encode()
ANSWER = (
    b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n" % len(BODY) + BODY
)


class Slaves:
    notices = 0

    async def serve(self, reader, writer):
        """Requests on one connection, for as long as the master keeps it."""
        try:
            while True:
                head = (await reader.readuntil(b"\r\n\r\n")).lower()
                (length,) = (
                    int(line[15:])
                    for line in head.split(b"\r\n")
                    if line.startswith(b"content-length:")
                )
                await reader.readexactly(length)
                self.notices += 1
                writer.write(ANSWER)
        except (asyncio.IncompleteReadError, ConnectionError):
            pass
        finally:
            writer.close()

    def tell(self):
        report(notices=self.notices)
        self.notices = 0


async def main(options):
    slaves = Slaves()
    master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
    servers = []
    for number in range(int(options["nodes"])):
        server = await asyncio.start_server(slaves.serve, "127.0.0.1", 0)
        servers.append(server)
        uri = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}/"
        topic, kind = options["topic"], "std_msgs/String"
        master.registerSubscriber(f"/subscribed_{number}", topic, kind, uri)
    asyncio.get_running_loop().add_signal_handler(signal.SIGUSR1, slaves.tell)
    report(ready=1)
    await asyncio.Event().wait()


if __name__ == "__main__":
    asyncio.run(main(dict(word.split("=", 1) for word in sys.argv[1:])))
