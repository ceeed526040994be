"""Classes that users derive from message and service classes, as the types of roles."""

from __future__ import annotations

import itertools

import pytest

import aioros1

PATIENCE = 30


@pytest.fixture(params=[False, True], ids=["unused", "used"])
def store(request):
    """Whose classes have, or have not, been used before others are derived from them."""
    store = aioros1.MessageStore()
    store.add_text("words_msgs/Word", "string data")
    store.add_text("words_msgs/Say", "words_msgs/Word word\n---\nwords_msgs/Word answer")
    if request.param:
        word, say = store.load_msg("words_msgs/Word"), store.load_srv("words_msgs/Say")
        for cls in (word, say.Request, say.Response):
            cls.from_bytes(cls().to_bytes())
    return store


async def test_topics(make_node, store):
    node = await make_node(store=store)
    word = store.load_msg("words_msgs/Word")

    class MyWord(word):
        def shout(self):
            return self.data.upper()

    class MyOwnWord(MyWord):
        __slots__ = ("times",)

    for sent, taken in itertools.product((word, MyWord, MyOwnWord, "words_msgs/Word"), repeat=2):
        async with node.advertise("words", sent) as pub, node.subscribe("words", taken) as sub:
            await pub.wait_for_subscribers(timeout=PATIENCE)
            pub.publish(data="hi")
            messages = [word(data="hi"), MyWord(data="hi"), MyOwnWord(data="hi"), {"data": "hi"}]
            for message in messages:
                await pub.send(message)
            for _ in range(1 + len(messages)):
                got = await sub.get(timeout=PATIENCE)
                assert type(got) is (word if isinstance(taken, str) else taken)
                assert got == word(data="hi")
                if isinstance(got, MyWord):
                    assert got.shout() == "HI"


async def test_services(make_node, store):
    node = await make_node(store=store)
    word, say = store.load_msg("words_msgs/Word"), store.load_srv("words_msgs/Say")

    class MyWord(word):
        pass

    class MyRequest(say.Request):
        pass

    class MyResponse(say.Response):
        pass

    class MySay(say):
        pass

    answers = iter(
        itertools.cycle(
            [
                say.Response(answer=MyWord(data="ho")),
                MyResponse(answer=word(data="ho")),
                {"answer": MyWord(data="ho")},
            ]
        )
    )
    for provided, called in itertools.product((say, MySay), repeat=2):
        async with (
            node.advertise_service("say", provided, lambda request: next(answers)),
            node.service_caller("say", called, persistent=True, timeout=PATIENCE) as caller,
        ):
            for request in (say.Request(), MyRequest(word=MyWord(data="hi"))):
                for _ in range(3):
                    reply = await caller.call(request)
                    assert reply == say.Response(answer=word(data="ho"))
            assert (await caller.call(word=MyWord(data="hi"))).answer.data == "ho"
