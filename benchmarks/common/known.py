"""Everybody who can take part, by the names that ``--only`` knows."""

from __future__ import annotations

from common import contenders, node_contenders
from common.contenders import Find

__all__ = ["CLIENTS", "KEYS", "MASTERS"]

CLIENTS: dict[str, Find] = {
    "aioros1": contenders.asyncio_client,
    "aioros1-uvloop": contenders.uvloop_client,
    "rospy": contenders.rospy_client,
    "roscpp": contenders.roscpp_client,
    "foxglove": node_contenders.foxglove_client,
    "rosnodejs": node_contenders.rosnodejs_client,
    "cros": contenders.cros_client,
    "tcp": contenders.tcp_client,
}
MASTERS: dict[str, Find] = {
    "aioros1": contenders.asyncio_master,
    "aioros1-uvloop": contenders.uvloop_master,
    "rosmaster": contenders.rosmaster,
}
KEYS = tuple({**CLIENTS, **MASTERS})
