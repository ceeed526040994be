"""The node ``/rosout``: it relays what every node logs on ``/rosout`` to ``/rosout_agg``.

Log viewers subscribe to ``/rosout_agg``, so they need one connection instead of one to every
node. roscore starts a program for this; here it is a node in the master's event loop.
"""

from __future__ import annotations

from collections.abc import Collection

from aioros1.node import Node
from aioros1.options import Limits

__all__ = ["RosoutAggregator"]


class RosoutAggregator:
    """Relays log messages, without decoding them, until it is closed."""

    def __init__(
        self,
        master_uri: str,
        host: str,
        *,
        bind: str | None = None,
        allow: Collection[str] | None = None,
        limits: Limits = Limits(),  # noqa: B008 - frozen
    ) -> None:
        self._node = Node(
            "rosout",
            master_uri=master_uri,
            host=host,
            bind=bind,
            allow=allow,
            limits=limits,
            rosout=False,
            logger_services=False,
        )

    async def start(self) -> None:
        """Start the relay; returns when the topics are registered."""
        await self._node.start()
        publisher = await self._node.advertise("/rosout_agg", "rosgraph_msgs/Log", queue_size=1000)
        # A plain callback, without a queue: one read may bring more messages than fit in any.
        await self._node.subscribe("/rosout", "rosgraph_msgs/Log", publisher.publish_raw, raw=True)

    async def close(self) -> None:
        await self._node.close()
