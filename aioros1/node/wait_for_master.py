"""Waiting for a master without a node."""

from __future__ import annotations

import asyncio

from aioros1._public import public
from aioros1.errors import MasterError
from aioros1.node.identity import master_uri_of
from aioros1.waiting import deadline
from aioros1.xmlrpc.client import XmlRpcClient
from aioros1.xmlrpc.master_proxy import MasterProxy, identify

__all__ = ["wait_for_master"]


@public
async def wait_for_master(uri: str | None = None, *, timeout: float | None = None) -> None:
    """Wait until a master answers at ``uri`` (``ROS_MASTER_URI`` by default).

    Raises :class:`TimeoutError` after ``timeout`` seconds, and :class:`ValueError` for
    an invalid URI.
    """
    uri = master_uri_of(uri)
    client = XmlRpcClient()
    try:
        master = MasterProxy(client, uri, "/aioros1")
        async with deadline(timeout, f"no master at {uri}") as limit:
            while True:
                try:
                    await identify(master)
                except MasterError as error:
                    limit.why = error.in_short
                else:
                    return
                await asyncio.sleep(0.1)
    finally:
        await client.close()
