"""Ends connections for every process that holds them.

A child that was forked, such as a worker of a ``ProcessPoolExecutor``, inherits all sockets.
Closing one here then ends nothing, and the peer keeps its connection. Shutting it down ends it
for all.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import socket
from asyncio import _get_running_loop
from asyncio.trsock import TransportSocket
from typing import Any

__all__ = ["abort", "shut_down"]


def abort(transport: asyncio.WriteTransport) -> None:
    """Close ``transport`` at once. If its event loop is closed, Python drops it anyway."""
    try:
        transport.abort()
    except RuntimeError:
        if _get_running_loop() is not None:
            raise


def shut_down(transport: asyncio.BaseTransport | None) -> None:
    """End the connection of ``transport``, whoever else holds its socket.

    Call this from ``connection_lost()``. What the transport had to send has been given to the
    system by then, which still delivers it.
    """
    sock: Any = None if transport is None else transport.get_extra_info("socket")
    if sock is None:
        return
    with contextlib.suppress(OSError):  # it has ended already
        if isinstance(sock, TransportSocket):
            sock.shutdown(socket.SHUT_RDWR)
        else:  # uvloop's only describe themselves
            with socket.socket(fileno=os.dup(sock.fileno())) as own:
                own.shutdown(socket.SHUT_RDWR)
