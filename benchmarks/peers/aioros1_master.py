"""A master of this library on the port given: ``PORT [rosout=0] [uvloop=1]``."""

from __future__ import annotations

import asyncio
import sys

import aioros1


async def main(port: int) -> None:
    rosout = "rosout=0" not in sys.argv
    async with aioros1.Master("localhost", port, rosout=rosout) as master:
        await master.wait_closed()


if __name__ == "__main__":
    if "uvloop=1" in sys.argv:
        import uvloop

        uvloop.run(main(int(sys.argv[1])))
    else:
        asyncio.run(main(int(sys.argv[1])))
