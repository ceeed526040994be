"""Codecs and stores used from several threads at once."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Barrier, Thread
from typing import Any

import pytest

from aioros1.idl import Message, MessageStore
from aioros1.idl.codec import codec_of

STRINGS = "string[] names\n"
JOINT_STATE = (
    "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nstring unit\n"
)


@pytest.fixture(autouse=True)
def frequent_switches() -> Iterator[None]:
    """Let Python switch between threads as often as it can."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def in_threads(*functions: Callable[[], Any]) -> list[Any]:
    """Run each function in a thread of its own, all at once; gives their results."""
    results: dict[int, Any] = {}
    errors: list[BaseException] = []
    barrier = Barrier(len(functions))

    def run(number: int, function: Callable[[], Any]) -> None:
        try:
            barrier.wait()
            results[number] = function()
        except BaseException as error:
            errors.append(error)

    threads = [Thread(target=run, args=each) for each in enumerate(functions)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]
    return [results[number] for number in range(len(functions))]


def make(text: str) -> type[Any]:
    """A new class, whose codec nobody has used."""
    store = MessageStore()
    store.add_text("p/T", text)
    return store.load_msg("p/T")


def strings(letter: str) -> list[str]:
    return [letter * 4] * 3


class TestCodecs:
    def test_lists_of_strings_are_decoded_to_those_of_the_message(self) -> None:
        cls = make(STRINGS)
        # Through a view nothing is remembered; `escape` remembers by itself.
        decode = codec_of(cls).decode

        def work(letter: str) -> Callable[[], None]:
            data = cls(names=strings(letter)).to_bytes()
            expected = strings(letter)

            def run() -> None:
                for _ in range(20_000):
                    assert decode(data, 0, len(data)).names == expected

            return run

        in_threads(*map(work, "abc"))

    def test_a_list_is_compared_while_another_thread_encodes(self) -> None:
        cls = make(STRINGS)
        remembered, other = cls(names=["a"]), cls(names=["b"])
        expected = remembered.to_bytes()

        class Switching(str):
            """A string at whose comparison another thread gets its turn."""

            def __eq__(self, value: object) -> bool:
                in_threads(other.to_bytes)
                return str(self) == value

            __hash__ = str.__hash__

        assert cls(names=[Switching("a")]).to_bytes() == expected

    def test_a_list_is_changed_while_it_is_encoded(self) -> None:
        """What is sent of it may be either; what is sent of other messages may not."""
        cls = make(STRINGS)

        class Changing(bytes):
            """A string at whose encoding another thread gets its turn."""

            def __bytes__(self) -> bytes:
                names[:] = ["b"]
                return b"a"

        names: list[Any] = [Changing(b"a")]
        assert cls(names=names).to_bytes() == b"\1\0\0\0\1\0\0\0a"
        assert cls(names=["b"]).to_bytes() == b"\1\0\0\0\1\0\0\0b"

    def test_text_that_is_not_utf_8(self) -> None:
        cls = make(STRINGS)

        def work(byte: bytes) -> Callable[[], None]:
            data = cls(names=[byte * 4] * 3).to_bytes()
            expected = cls(names=[(byte * 4).decode("utf-8", "surrogateescape")] * 3)

            def run() -> None:
                for _ in range(5_000):
                    assert cls.from_bytes(data) == expected

            return run

        in_threads(*map(work, (b"\xfd", b"\xfe", b"\xff")))

    def test_layouts_that_are_learned(self) -> None:
        """Messages of one size and of different layouts, learned, mistaken and given up."""
        cls = make(JOINT_STATE)

        def work(letter: str, joints: int) -> Callable[[], None]:
            message = cls(
                name=[letter * 4] * joints,
                position=[0.5] * joints,
                velocity=[joints] * joints,
                unit=letter * (200 - 24 * joints),
            )
            data = message.to_bytes()
            decode = codec_of(cls).decode

            def run() -> None:
                for _ in range(3_000):
                    assert decode(data, 0, len(data)) == message

            return run

        in_threads(work("a", 2), work("b", 2), work("c", 3))

    @pytest.mark.parametrize(
        "use",
        [
            lambda cls, data: cls(names=["x"]).to_bytes() == data,
            lambda cls, data: cls.from_bytes(data) == cls(names=["x"]),
            lambda cls, data: cls.from_bytes(data, views=True) == cls(names=["x"]),
            lambda cls, data: codec_of(cls).frame(cls(names=["x"]))[4:] == data,
            lambda cls, data: codec_of(cls).decode(data, 0, len(data)) == cls(names=["x"]),
            lambda cls, data: cls(names=("\udc80",)).to_bytes()[8:] == b"\x80",
            lambda cls, data: cls.from_bytes(data[:-1] + b"\x80").names == ["\udc80"],
            lambda cls, data: "string[] names" in cls._full_text,
        ],
    )
    def test_the_first_use_of_a_class(self, use: Callable[[type[Message], bytes], bool]) -> None:
        data = b"\1\0\0\0\1\0\0\0x"
        for _ in range(5):
            cls = make(STRINGS)
            assert all(in_threads(*[lambda cls=cls: use(cls, data)] * 4))


DEFINITIONS = {
    "p/Inner": "string[] names\n",
    "p/Outer": "Inner[] a\nInner b\n",
    "p/Call": "Outer a\n---\nOuter b\n",
    "p/Do": "Outer a\n---\nOuter b\n---\nInner c\n",
}


def store_of() -> MessageStore:
    store = MessageStore()
    for type_, text in DEFINITIONS.items():
        store.add_text(type_, text)
    return store


class TestStores:
    @pytest.mark.parametrize(
        "load",
        [
            lambda store: store.load_msg("p/Outer"),
            lambda store: store.load_srv("p/Call"),
            lambda store: store.load_action("p/Do"),
            lambda store: store.add_definition("p/New", "int32 x\n"),
        ],
    )
    def test_a_type_has_one_class(self, load: Callable[[MessageStore], Any]) -> None:
        for _ in range(10):
            store = store_of()
            first, *others = in_threads(*[lambda store=store: load(store)] * 4)
            assert all(other is first for other in others)
            assert load(store) is first

    def test_a_store_and_its_children_have_the_same_class(self) -> None:
        for _ in range(10):
            parent = store_of()
            stores = [parent, *(MessageStore(parent=parent) for _ in range(3))]
            loads = [lambda store=store: store.load_msg("p/Outer") for store in stores]
            first, *others = in_threads(*loads)
            assert all(other is first for other in others)

    def test_the_classes_inside_are_those_that_a_load_gives(self) -> None:
        for _ in range(10):
            store = store_of()
            outer, inner = in_threads(
                lambda store=store: store.load_msg("p/Outer"),
                lambda store=store: store.load_msg("p/Inner"),
            )
            assert type(outer().b) is inner

    def test_foreign_services_and_actions_have_one_class(self) -> None:
        other = store_of()
        call, do = other.load_srv("p/Call"), other.load_action("p/Do")
        names = ("_type", "_md5sum", "_request_class", "_response_class")
        foreign = type("Call", (), {name: getattr(call, name) for name in names})
        for _ in range(10):
            store = MessageStore(parent=None)
            services = in_threads(*[lambda s=store: s.resolve_srv(foreign)] * 3)
            assert len(set(services)) == 1
            actions = in_threads(*[lambda s=store: s.resolve_action(do.Action)] * 3)
            assert len(set(actions)) == 1

    def test_looking_while_another_adds(self) -> None:
        store = MessageStore(parent=None)
        store.add_text("p/Outer", "int32 x\n")
        done = False

        def add() -> None:
            nonlocal done
            try:
                for number in range(1_000):
                    store.add_text(f"p/T{number}", "int32 x\n", kind="msg")
            finally:
                done = True

        def look() -> None:
            while not done:
                assert "p/Outer" in store.types("p")
                assert "p" in store.packages()

        in_threads(add, look, look)

    def test_there_is_one_default_store(self) -> None:
        script = (
            "import sys; sys.setswitchinterval(1e-6)\n"
            "from threading import Barrier, Thread\n"
            "from aioros1.idl import default_store\n"
            "start, found = Barrier(8), []\n"
            "def run():\n"
            "    start.wait()\n"
            "    found.append(default_store())\n"
            "threads = [Thread(target=run) for _ in range(8)]\n"
            "for thread in threads: thread.start()\n"
            "for thread in threads: thread.join()\n"
            "assert len(set(map(id, found))) == 1, found\n"
        )
        subprocess.run([sys.executable, "-c", script], check=True, cwd=Path(__file__).parents[2])
