"""Run with an installed wheel and nothing else: a message and a call get through."""

from __future__ import annotations

import asyncio
from pathlib import Path

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

PACKAGE = Path(aioros1.__file__).parent

for name in ("py.typed", "__init__.pyi", "idl/_typing.pyi", "msg/std_msgs/__init__.pyi"):
    assert (PACKAGE / name).exists(), f"{name} is not in the wheel"

aioros1.install_importer()
try:
    from std_msgs.msg import String as SameString
finally:
    aioros1.uninstall_importer()
assert SameString is String


async def main() -> None:
    async with (
        aioros1.Master(host="localhost", port=0) as master,
        aioros1.Node("smoke", master_uri=master.uri) as node,
        node.advertise("chatter", String) as pub,
        node.subscribe("chatter") as sub,
        node.advertise_service("flip", SetBool, lambda request: {"success": not request.data}),
    ):
        await pub.wait_for_subscribers(timeout=30)
        pub.publish(data="hello")
        assert await sub.get(timeout=30) == String(data="hello")
        assert (await node.call("flip", SetBool, data=False, timeout=30)).success
    print("aioros1", aioros1.__version__, "works from", aioros1.__file__)


asyncio.run(main())
