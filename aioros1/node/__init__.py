"""The node: a program's presence in a ROS graph."""

from __future__ import annotations

from aioros1.node.node import Node

__all__ = ["Node"]
