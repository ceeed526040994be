"""Sets parameters, reads them back, then prints how they change until it is interrupted.

python examples/parameters.py

Change them from elsewhere, for example with `rosparam set /parameters/gains/p 2.5`.
"""

import aioros1


async def main(node: aioros1.Node) -> None:
    await node.set_param("~gains", {"p": 1.0, "i": 0.1})
    print("set:", await node.get_param("~gains"))
    print("one of them:", await node.get_param("~gains/p"))
    print("not there:", await node.get_param("~gains/d", "no value"))

    async with node.subscribe_param("~gains") as gains:
        print(f"following {gains.name}: {gains.value}")
        async for update in gains:
            # The key is the one that was set: this one, or one below it.
            print(f"{update.key} is now {update.value}, in all: {gains.value}")


if __name__ == "__main__":
    aioros1.run(main)
