"""The node: what a program is in a ROS graph."""

from __future__ import annotations

from aioros1.node.node import Node

__all__ = ["Node"]
