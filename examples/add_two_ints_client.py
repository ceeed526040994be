"""Has two whole numbers added by the service /add_two_ints.

python examples/add_two_ints_client.py 3 4 [add_two_ints:=sum]
"""

import sys

import aioros1
from aioros1.names import parse_args
from aioros1.srv.roscpp_tutorials import TwoInts


async def main(node: aioros1.Node) -> str | None:
    # What is left when the words meant for the node, such as `a:=b`, are taken out.
    words = parse_args(sys.argv[1:]).rest
    a, b = (int(word) for word in words or ("3", "4"))
    async with node.service_caller("add_two_ints", TwoInts, timeout=5) as caller:
        try:
            await caller.wait_for_service(timeout=5)
            answer = await caller.call(a=a, b=b)
        except (aioros1.ServiceError, TimeoutError) as error:
            return f"no answer: {error}"
    print(f"{a} + {b} = {answer.sum}")
    return None


if __name__ == "__main__":
    # Nodes of one name replace each other, and of a client there may be several.
    sys.exit(aioros1.run(main, anonymous=True))
