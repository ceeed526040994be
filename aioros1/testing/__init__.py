"""For tests of programs that use ROS 1: what goes wrong in the field, on purpose."""

from aioros1.testing.flaky_connection import FlakyConnection
from aioros1.testing.flaky_proxy import FlakyProxy
from aioros1.testing.node_proxies import NodeProxies, proxies_before

__all__ = ["FlakyConnection", "FlakyProxy", "NodeProxies", "proxies_before"]
