"""Whatever a service handler raises: its caller gets an answer, and the node goes on."""

from __future__ import annotations

import asyncio

import pytest

import aioros1
from aioros1.srv.std_srvs import SetBool

PATIENCE = 30


class Fatal(BaseException):
    pass


class Speechless(Exception):
    def __str__(self):
        raise ValueError("nothing to say")

    __repr__ = __str__


class Mute(BaseException):
    __str__ = __repr__ = Speechless.__str__


class Surrogate(Exception):
    def __str__(self):
        return "no text: \ud800"


async def await_what_somebody_cancels():
    other = asyncio.create_task(asyncio.sleep(3600))
    asyncio.get_running_loop().call_soon(other.cancel)
    await other


ERRORS = {
    "ValueError": (lambda: ValueError("no"), "no"),
    "without a text": (ValueError, "ValueError"),
    "text fails": (Speechless, "Speechless"),
    "no text of UTF-8": (Surrogate, r"no text: \\ud800"),
    "ServiceError": (lambda: aioros1.ServiceError(5), "5"),  # type: ignore[arg-type]
    "BaseException": (lambda: Fatal("no"), "Fatal was raised: no"),
    "BaseException whose text fails": (Mute, "Mute was raised: Mute"),
    "CancelledError": (lambda: asyncio.CancelledError("no"), "CancelledError was raised: no"),
    "GeneratorExit": (GeneratorExit, "GeneratorExit was raised"),
    "a group": (lambda: BaseExceptionGroup("many", [Fatal("no")]), "many"),
}


@pytest.mark.parametrize(("error", "text"), ERRORS.values(), ids=ERRORS.keys())
@pytest.mark.parametrize("options", [{}, {"raw": True}, {"max_concurrency": 1}], ids=str)
@pytest.mark.parametrize("is_async", [False, True])
async def test_the_caller_gets_its_text(make_node, caplog, error, text, options, is_async):
    node = await make_node()  # with on_error="raise"

    def handler(request):
        raise error()

    async def async_handler(request):
        await asyncio.sleep(0)
        raise error()

    chosen = async_handler if is_async else handler
    async with (
        node.advertise_service("flip", SetBool, chosen, **options) as provider,
        node.service_caller("flip", SetBool, persistent=True, timeout=PATIENCE) as caller,
    ):
        for _ in range(2):  # over the same connection
            with pytest.raises(aioros1.ServiceError, match=text) as caught:
                await caller.call(data=True)
            assert type(caught.value) is aioros1.ServiceError
        assert provider.stats.errors == 2
    assert node.is_open
    is_told = error().__class__ is aioros1.ServiceError  # which is the answer, and no error
    assert is_told or "service /flip" in caplog.text


@pytest.mark.parametrize("persistent", [False, True])
async def test_a_cancellation_that_was_not_ours_is_answered_and_reported(make_node, persistent):
    errors = []
    node = await make_node(on_error=errors.append)

    async def handler(request):
        await await_what_somebody_cancels()

    async with (
        node.advertise_service("flip", SetBool, handler),
        node.service_caller("flip", SetBool, persistent=persistent, timeout=PATIENCE) as caller,
    ):
        with pytest.raises(aioros1.ServiceError, match="CancelledError was raised"):
            await caller.call(data=True)
    assert isinstance(errors[0].__cause__, asyncio.CancelledError)


async def test_a_handler_may_return_what_somebody_cancels(make_node):
    node = await make_node()

    def handler(request):
        future = asyncio.get_running_loop().create_future()
        future.cancel()
        return future

    async with node.advertise_service("flip", SetBool, handler):
        with pytest.raises(aioros1.ServiceError, match="CancelledError was raised"):
            await node.call("flip", SetBool, timeout=PATIENCE)


async def test_a_handler_is_cancelled_when_the_time_of_its_node_is_over(make_node, caplog):
    node = await make_node(timeouts=aioros1.Timeouts(close=0.05))
    begun, seen = asyncio.Event(), []

    async def handler(request):
        begun.set()
        try:
            await asyncio.sleep(3600)
        except asyncio.CancelledError:
            seen.append("cancelled")
            raise

    await node.advertise_service("flip", SetBool, handler)
    other = await make_node("other")
    calling = asyncio.create_task(other.call("flip", SetBool))
    await asyncio.wait_for(begun.wait(), PATIENCE)
    await asyncio.wait_for(node.close(), PATIENCE)
    with pytest.raises(aioros1.ServiceError):
        await calling
    assert seen == ["cancelled"]
    assert "has not ended in time: a service handler" in caplog.text


async def test_a_handler_that_runs_when_the_node_ends_can_use_its_roles(make_node):
    node, other = await make_node(), await make_node("other")
    pub = await node.advertise("cmd", "std_msgs/String")
    sub = await other.subscribe("cmd", "std_msgs/String")
    await pub.wait_for_subscribers(timeout=PATIENCE)
    begun, may_go_on = asyncio.Event(), asyncio.Event()

    async def handler(request):
        begun.set()
        await may_go_on.wait()
        await node.set_param("handled", True)
        await pub.send(data="handled")
        return {"message": "handled"}

    await node.advertise_service("flip", SetBool, handler)
    calling = asyncio.create_task(other.call("flip", SetBool, timeout=PATIENCE))
    await asyncio.wait_for(begun.wait(), PATIENCE)
    closing = asyncio.create_task(node.close())
    for _ in range(10):
        await asyncio.sleep(0)
    may_go_on.set()
    assert (await calling).message == "handled"
    assert (await sub.get(timeout=PATIENCE)).data == "handled"
    await closing
