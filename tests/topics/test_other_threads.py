"""Publishing from a thread that is not the event loop's."""

from __future__ import annotations

import asyncio
import threading

import pytest

from aioros1.msg.std_msgs import String


@pytest.mark.parametrize("method", ["publish", "publish_raw"])
@pytest.mark.parametrize("during_a_burst", [False, True])
async def test_it_is_refused_and_the_publishers_work_afterwards(make_node, method, during_a_burst):
    node = await make_node("node")
    pub = await node.advertise("chatter", String)
    other = await node.advertise("other", String)
    sub = await node.subscribe("chatter", String, queue_size=100)
    await sub.wait_for_publishers(1, timeout=30)
    await pub.wait_for_subscribers(1, timeout=30)
    refused: list[str] = []

    def call() -> None:
        argument = bytes(8) if method == "publish_raw" else String(data="from elsewhere")
        for each in (pub, other):
            for _ in range(40):
                try:
                    getattr(each, method)(argument)
                except RuntimeError as error:
                    refused.append(str(error))

    expected = []
    if during_a_burst:
        expected = [f"before {number}" for number in range(40)]
        for text in expected:
            pub.publish(data=text)
    thread = threading.Thread(target=call, name="worker")
    thread.start()
    thread.join()
    for number in range(40):
        pub.publish(data=f"after {number}")
    expected += [f"after {number}" for number in range(40)]
    async with asyncio.timeout(30):
        assert [(await sub.get()).data for _ in expected] == expected
    assert pub.stats.messages == len(expected)
    assert len(refused) == 80
    expected_error = (
        "publish() was called in thread 'worker', but belongs to the event loop in thread "
        "'MainThread': use loop.call_soon_threadsafe(...) there, or NodeThread.call"
    )
    assert set(refused) == {expected_error}
