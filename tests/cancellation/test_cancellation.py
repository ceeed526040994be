"""Every awaitable of the library, cancelled at every place where it suspends.

Each case is run again and again: cancelled at once where it suspends, just when the result
is there, by a time limit, after so many turns of the loop, and once more while it cleans up.
After each attempt nothing is left over, and the master has what the open roles say.
"""

from __future__ import annotations

import asyncio
import contextlib
import itertools
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass
from typing import Any

import pytest

import aioros1
from aioros1.msg.std_msgs import String
from aioros1.srv.std_srvs import SetBool

from .harness import WAYS, Attempt, attempts
from .world import World, flip, new_world

Act = Callable[[World], Awaitable[Any]]


@dataclass(frozen=True)
class Case:
    act: Act
    """What is cancelled."""
    after: Callable[[World, Attempt], Awaitable[None]] | None = None
    """What is to be done and true after each attempt, before the graph is looked at."""
    before: Callable[[World], Awaitable[None]] | None = None
    """What is done before each attempt."""
    around: Callable[[World], contextlib.AbstractAsyncContextManager[Any]] | None = None
    """What is there during all attempts."""
    options: tuple[tuple[str, Any], ...] = ()


CASES: dict[str, Case] = {}


def case(
    name: str, *, after: Any = None, before: Any = None, around: Any = None, **options: Any
) -> Callable[[Act], Act]:
    def note(act: Act) -> Act:
        CASES[name] = Case(act, after, before, around, tuple(options.items()))
        return act

    return note


async def close_result(world: World, attempt: Attempt) -> None:
    if attempt.is_done:
        await attempt.result.close()


def soon(function: Callable[[], object], turns: int = 3) -> None:
    """Call ``function`` a few turns of the loop later."""
    loop = asyncio.get_running_loop()
    if turns:
        loop.call_soon(soon, function, turns - 1)
    else:
        function()


# ------------------------------------------------------------------ opening and closing

OPENINGS: dict[str, Callable[[aioros1.Node], Any]] = {
    "advertise": lambda node: node.advertise("fresh", String),
    "advertise again": lambda node: node.advertise("out", String),
    "advertise what is subscribed": lambda node: node.advertise("wanted", String, latch=True),
    "subscribe": lambda node: node.subscribe("fresh", String),
    "subscribe again": lambda node: node.subscribe("in", String),
    "subscribe what is published": lambda node: node.subscribe("offered"),
    "advertise_service": lambda node: node.advertise_service("fresh", SetBool, flip),
    "service_caller": lambda node: node.service_caller("flip", SetBool),
    "service_caller of any type": lambda node: node.service_caller("flip"),
    "subscribe_param": lambda node: node.subscribe_param("/fresh/param"),
    "subscribe_param again": lambda node: node.subscribe_param("/followed"),
}


@contextlib.asynccontextmanager
async def company(world: World) -> AsyncIterator[None]:
    """Others who connect as soon as there is something to connect to."""
    async with (
        world.other.subscribe("wanted", String),
        world.other.advertise("offered", String, latch=True) as pub,
    ):
        pub.publish(data="hello")
        yield


def add_opening(name: str, opening: Callable[[aioros1.Node], Any]) -> None:
    around = company if "what is" in name else None

    @case(name, after=close_result, around=around)
    def open_(world: World) -> Any:
        return opening(world.node)

    @case(f"async with {name}", around=around)
    async def enter(world: World) -> None:
        async with opening(world.node) as role:
            assert role.is_open
            await asyncio.sleep(0)

    async def one(world: World) -> None:
        world.thing = await opening(world.node)

    async def closed(world: World, attempt: Attempt) -> None:
        if world.thing.is_open:  # cancelled before it has begun
            await world.thing.close()

    @case(f"close, after {name}", before=one, after=closed, around=around)
    async def close(world: World) -> None:
        await world.thing.close()


for name, opening in OPENINGS.items():
    add_opening(name, opening)


# ------------------------------------------------------------------ services


@case("node.call")
async def call(world: World) -> None:
    assert (await world.node.call("flip", SetBool, data=True)).success


async def persistent_still_works(world: World, attempt: Attempt) -> None:
    for data in (False, True):
        assert (await world.caller.call(data=data, timeout=30)).success is data


@case("caller.call, persistent", after=persistent_still_works)
async def call_persistent(world: World) -> None:
    # The other answer than the next call's.
    assert (await world.caller.call(data=True)).success


@case("caller.call, persistent, with a time limit", after=persistent_still_works)
async def call_in_time(world: World) -> None:
    assert (await world.caller.call(data=True, timeout=30)).success


@case("caller.call, two at a time", after=persistent_still_works)
async def call_both(world: World) -> None:
    async with asyncio.TaskGroup() as group:
        calls = [group.create_task(world.caller.call(data=data)) for data in (True, False, True)]
    assert [task.result().success for task in calls] == [True, False, True]


@case("caller.send_request")
def send_request(world: World) -> Any:
    return world.caller.send_request(data=True)


@contextlib.asynccontextmanager
async def single(world: World) -> AsyncIterator[None]:
    async with world.node.service_caller("flip", SetBool) as world.thing:
        yield


@case("caller.call", around=single)
async def call_once(world: World) -> None:
    assert (await world.thing.call(data=True, timeout=30)).success


@case("caller()", around=single)
async def call_it(world: World) -> None:
    assert (await world.thing(data=True)).success


@case("caller.is_available", around=single)
async def is_available(world: World) -> None:
    assert await world.thing.is_available()


@case("caller.wait_for_service", around=single)
async def caller_waits(world: World) -> None:
    await world.thing.wait_for_service(timeout=30)


@case("node.wait_for_service")
async def wait_for_service(world: World) -> None:
    await world.node.wait_for_service("flip", timeout=30)


@contextlib.asynccontextmanager
async def deferring(world: World) -> AsyncIterator[None]:
    async with world.node.advertise_service("later", SetBool) as world.thing:
        yield


async def answer_what_waits(world: World, attempt: Attempt) -> None:
    """The call that a cancelled iteration did not take is there for the next."""
    call = attempt.result if attempt.is_done else await anext(world.thing)
    await call.reply(success=True)
    assert (await world.calling).success


async def call_later(world: World) -> None:
    world.calling = asyncio.create_task(world.other.call("later", SetBool, timeout=30))


@case("anext(provider)", around=deferring, before=call_later, after=answer_what_waits)
def next_call(world: World) -> Any:
    return anext(world.thing)


async def take_call(world: World) -> None:
    await call_later(world)
    world.call = await anext(world.thing)


async def answered(world: World, attempt: Attempt) -> None:
    if not attempt.is_done:  # it does not suspend: it was cancelled before it began
        await world.call.fail("no")
    with contextlib.suppress(aioros1.ServiceError):
        await world.calling


@case("call.reply", around=deferring, before=take_call, after=answered)
def reply(world: World) -> Any:
    return world.call.reply(success=True)


@case("call.fail", around=deferring, before=take_call, after=answered)
def fail(world: World) -> Any:
    return world.call.fail("no")


# ------------------------------------------------------------------ topics


async def publish_soon(world: World) -> None:
    world.number = str(next(world.numbers))
    soon(lambda: world.their_pub.publish(data=world.number))


def takes_one() -> Any:
    async def nothing_is_lost(world: World, attempt: Attempt) -> None:
        taken = attempt.result if attempt.is_done else await world.sub.get(timeout=30)
        assert getattr(taken, "message", taken).data == world.number
        assert world.sub.queued == 0

    return {"before": publish_soon, "after": nothing_is_lost}


@case("sub.get", **takes_one())
def get(world: World) -> Any:
    return world.sub.get()


@case("sub.get, with a time limit", **takes_one())
def get_in_time(world: World) -> Any:
    return world.sub.get(timeout=30)


@case("anext(sub)", **takes_one())
def next_message(world: World) -> Any:
    return anext(world.sub)


@case("anext(sub.events())", **takes_one())
def next_event(world: World) -> Any:
    return anext(world.sub.events())


@contextlib.asynccontextmanager
async def latched(world: World) -> AsyncIterator[None]:
    async with world.other.advertise("latched", String, latch=True) as pub:
        pub.publish(data="there")
        yield


@case("node.wait_for_message", around=latched)
async def wait_for_message(world: World) -> None:
    assert (await world.node.wait_for_message("latched", timeout=30)).data == "there"


@contextlib.asynccontextmanager
async def lonely(world: World) -> AsyncIterator[None]:
    async with (
        world.node.advertise("lonely", String) as world.thing,
        world.node.subscribe("lone", String) as world.lone,
    ):
        world.joined = contextlib.AsyncExitStack()
        yield


async def join(world: World) -> None:
    """The other node will be there soon."""

    async def come() -> None:
        await world.joined.enter_async_context(world.other.subscribe("lonely", String))
        await world.joined.enter_async_context(world.other.advertise("lone", String))

    world.coming = asyncio.create_task(come())


async def leave(world: World, attempt: Attempt) -> None:
    await world.coming
    await world.joined.aclose()
    while world.thing.subscriber_count or world.lone.publisher_count:
        await asyncio.sleep(0)


@case("pub.wait_for_subscribers", around=lonely, before=join, after=leave)
def wait_for_subscribers(world: World) -> Any:
    return world.thing.wait_for_subscribers(timeout=30)


@case("sub.wait_for_publishers", around=lonely, before=join, after=leave)
def wait_for_publishers(world: World) -> Any:
    return world.lone.wait_for_publishers(timeout=30)


@contextlib.asynccontextmanager
async def pressure(world: World) -> AsyncIterator[None]:
    """A subscriber that takes a message now and then, and a publisher that must wait for it."""
    async with (
        world.node.advertise("big", String, queue_size=1, overflow="block") as pub,
        world.other.subscribe("big", String, queue_size=1, overflow="block") as world.taker,
    ):
        world.thing = pub
        await pub.wait_for_subscribers(timeout=30)
        yield


async def fill(world: World) -> None:
    world.sent = []
    with contextlib.suppress(asyncio.QueueFull):
        for number in itertools.count():
            world.thing.publish(data=f"{number:06}" + "." * 500_000)
            world.sent.append(number)

    async def take() -> list[int]:
        taken = []
        while len(taken) < len(world.sent):
            taken.append(int((await world.taker.get(timeout=30)).data[:6]))
        return taken

    world.taking = asyncio.create_task(take())


async def what_was_sent_came(world: World, attempt: Attempt) -> None:
    """What a cancelled ``send`` was to send was not published."""
    assert await world.taking == world.sent
    if attempt.is_done:
        assert (await world.taker.get(timeout=30)).data.startswith("000999")
    await world.thing.send(data="001000")
    assert (await world.taker.get(timeout=30)).data == "001000"


@case("pub.send, when there is no room", around=pressure, before=fill, after=what_was_sent_came)
def send(world: World) -> Any:
    return world.thing.send(data="000999" + "." * 500_000)


async def all_came(world: World, attempt: Attempt) -> None:
    assert await world.taking == world.sent


@case("pub.drain", around=pressure, before=fill, after=all_came)
def drain(world: World) -> Any:
    return world.thing.drain(timeout=30)


async def not_twice(world: World, attempt: Attempt) -> None:
    expected = [world.number] if attempt.is_done else []
    await world.pub.send(data="last")
    got = []
    while (data := (await world.their_sub.get(timeout=30)).data) != "last":
        got.append(data)
    assert got == expected


async def a_long_turn(world: World) -> None:
    world.number = str(next(world.numbers))
    await asyncio.sleep(0)
    world.lengthen_turn()


@case("pub.send, at the end of a long turn", before=a_long_turn, after=not_twice)
async def send_in_turn(world: World) -> None:
    world.lengthen_turn()
    await world.pub.send(data=world.number)


# ------------------------------------------------------------------ parameters


async def param_is_one_of_two(world: World, attempt: Attempt) -> None:
    """Where a change may have arrived: everybody agrees, and the next one is the last."""
    await world.node.set_param("/other", 1)  # behind whatever is on its way
    value = await world.other.get_param("/followed", {})
    assert world.psub.value == (0 if value == {} else value)  # its default
    if attempt.is_done:
        assert value == world.value
    await world.node.set_param("/followed", -1)
    assert await world.other.get_param("/followed") == world.psub.value == -1


async def new_value(world: World) -> None:
    world.value = next(world.numbers)


async def no_value(world: World) -> None:
    world.value = {}
    await world.node.set_param("/followed", 1)


@case("node.set_param", before=new_value, after=param_is_one_of_two)
def set_param(world: World) -> Any:
    return world.node.set_param("/followed", world.value)


@case("node.delete_param", before=no_value, after=param_is_one_of_two)
def delete_param(world: World) -> Any:
    return world.node.delete_param("/followed")


@case("node.get_param")
def get_param(world: World) -> Any:
    return world.node.get_param("/run_id")


@case("node.has_param")
def has_param(world: World) -> Any:
    return world.node.has_param("/run_id")


@case("node.search_param")
def search_param(world: World) -> Any:
    return world.node.search_param("run_id")


@case("node.get_param_names")
def get_param_names(world: World) -> Any:
    return world.node.get_param_names()


async def close_cached(world: World, attempt: Attempt) -> None:
    for role in world.node.roles:
        if role.name.startswith("/cached"):
            await role.close()


@case("node.get_param_cached", before=new_value, after=close_cached)
def get_param_cached(world: World) -> Any:
    return world.node.get_param_cached(f"/cached{world.value}", 0)


async def change_soon(world: World) -> None:
    await world.no_updates_left()
    world.value = next(world.numbers)
    soon(lambda: world.tell_of_param(world.value))


async def update_is_kept(world: World, attempt: Attempt) -> None:
    update = attempt.result if attempt.is_done else await anext(world.psub)
    assert update == aioros1.ParamUpdate("/followed", world.value)


@case("anext(psub)", before=change_soon, after=update_is_kept)
def next_update(world: World) -> Any:
    return anext(world.psub)


async def update_is_not_taken(world: World, attempt: Attempt) -> None:
    assert (await anext(world.psub)).value == world.value


@case("psub.wait_for", before=change_soon, after=update_is_not_taken)
def param_wait_for(world: World) -> Any:
    return world.psub.wait_for(lambda value: value == world.value, timeout=30)


# ------------------------------------------------------------------ time, graph, other nodes


@case("node.sleep")
def sleep(world: World) -> Any:
    return world.node.sleep(0.001)


@contextlib.asynccontextmanager
async def ticking(world: World) -> AsyncIterator[None]:
    world.thing = world.node.rate(1000)
    yield
    first = await anext(world.thing)
    assert await anext(world.thing) > first


@case("anext(rate)", around=ticking)
def tick(world: World) -> Any:
    return anext(world.thing)


@contextlib.asynccontextmanager
async def watching(world: World) -> AsyncIterator[None]:
    world.thing = world.node.graph.changes(poll=0.001)
    first = asyncio.create_task(anext(world.thing))
    while not first.done():  # it may look for the first time only after some changes
        async with world.other.advertise("first", String):
            await world.node.graph.snapshot()
    await first
    yield


async def change_graph(world: World) -> None:
    world.role = await world.other.advertise(f"change{next(world.numbers)}", String)


async def change_is_seen(world: World, attempt: Attempt) -> None:
    edge = ("publisher", world.role.name, "/other")
    change = attempt.result if attempt.is_done else await anext(world.thing)
    assert edge in change.added
    await world.role.close()
    assert edge in (await anext(world.thing)).removed


@case("anext(graph.changes())", around=watching, before=change_graph, after=change_is_seen)
def next_change(world: World) -> Any:
    return anext(world.thing)


@case("graph.snapshot")
def snapshot(world: World) -> Any:
    return world.node.graph.snapshot()


@case("graph.wait_for")
def graph_wait_for(world: World) -> Any:
    return world.node.graph.wait_for(lambda graph: "/in" in graph.topics, timeout=30)


@contextlib.asynccontextmanager
async def listening(world: World) -> AsyncIterator[None]:
    world.thing = world.node.events()
    yield


async def event_soon(world: World) -> None:
    world.value = aioros1.MasterLost("somewhere", str(next(world.numbers)))
    soon(lambda: world.tell_of_event(world.value))


async def event_is_kept(world: World, attempt: Attempt) -> None:
    event = attempt.result
    while not isinstance(event, aioros1.MasterLost):
        event = await anext(world.thing)
    assert event == world.value


@case("anext(node.events())", around=listening, before=event_soon, after=event_is_kept)
def next_node_event(world: World) -> Any:
    return anext(world.thing)


@case("node.wait_for_master")
def wait_for_master(world: World) -> Any:
    return world.node.wait_for_master(timeout=30)


@case("aioros1.wait_for_master")
def wait_for_any_master(world: World) -> Any:
    return aioros1.wait_for_master(world.master.uri, timeout=30)


@case("node.peer")
def peer(world: World) -> Any:
    return world.node.peer("/other")


ASKING = {
    "lookup_node": ("/other",),
    "lookup_service": ("/flip",),
    "get_published_topics": (),
    "get_topic_types": (),
    "get_system_state": (),
    "get_uri": (),
    "get_pid": (),
    "ping": (),
}
PEER_ASKING = (
    *("get_bus_stats", "get_bus_info", "get_master_uri", "get_pid", "get_subscriptions"),
    *("get_publications", "ping"),
)


def add_asking(method: str, arguments: tuple[Any, ...]) -> None:
    @case(f"master.{method}")
    def ask(world: World) -> Any:
        return getattr(world.node.master, method)(*arguments)


def add_peer_asking(method: str) -> None:
    @contextlib.asynccontextmanager
    async def with_peer(world: World) -> AsyncIterator[None]:
        world.thing = await world.node.peer("/other")
        yield

    @case(f"peer.{method}", around=with_peer)
    def ask(world: World) -> Any:
        return getattr(world.thing, method)()


for method, arguments in ASKING.items():
    add_asking(method, arguments)
for method in PEER_ASKING:
    add_peer_asking(method)

for transport in ("unix", "intraprocess"):
    for name in ("subscribe what is published", "advertise what is subscribed"):
        known = CASES[f"async with {name}"]
        CASES[f"async with {name}, {transport}"] = Case(
            known.act, around=known.around, options=(("local_transports", (transport,)),)
        )


@pytest.mark.parametrize("name", CASES)
async def test_it_can_be_cancelled_anywhere(name: str) -> None:
    chosen = CASES[name]
    async with new_world(**dict(chosen.options)) as world, contextlib.AsyncExitStack() as stack:
        if chosen.around is not None:
            await stack.enter_async_context(chosen.around(world))
        await world.remember()
        for way in WAYS:
            async for attempt in attempts(way, chosen.act, world, chosen.before):
                try:
                    if chosen.after is not None:
                        await chosen.after(world, attempt)
                    await world.check()
                except BaseException as error:
                    error.add_note(f"after it was cut: {attempt.cut}")
                    raise
