"""Adds two whole numbers for whoever asks, until it is interrupted.

python examples/add_two_ints_server.py [add_two_ints:=sum]
"""

import aioros1
from aioros1.srv.roscpp_tutorials import TwoInts


async def add(request: TwoInts.Request) -> TwoInts.Response:
    total = request.a + request.b
    print(f"{request.a} + {request.b} = {total}")
    return TwoInts.Response(sum=total)


async def main(node: aioros1.Node) -> None:
    async with node.advertise_service("add_two_ints", TwoInts, add) as service:
        print(f"ready: {service.name}")
        await node.wait_closed()


if __name__ == "__main__":
    aioros1.run(main)
