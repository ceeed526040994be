"""Every type of Debian's definition packages: ours and genpy's are the same, byte for byte.

Ours are made here from the definition files, genpy's are the classes that Debian packages,
in a process of Debian's Python. Values travel between the two in the neutral form of
``peers/neutral.py``. A failure names the type, the seed and the first field that differs.
"""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from aioros1.errors import SerializationError
from aioros1.idl import MessageStore
from aioros1.idl.paths import KINDS, bundle
from aioros1.time import Duration, Time

from . import debian
from .peers import neutral

SHARE = Path("/usr/share")
PEER = Path(__file__).parent / "peers" / "genpy_types.py"
SEEDS = ["low", "high", "odd 1", "odd 2", "odd 3", *(f"random {n}" for n in range(1, 6))]

# Where Debian has the definitions of a package; its classes are in python3-<package>.
DEFINITIONS = {
    "actionlib": "libactionlib-dev",
    "actionlib_msgs": "ros-actionlib-msgs",
    "bond": "libbond-dev",
    "diagnostic_msgs": "ros-diagnostic-msgs",
    "dynamic_reconfigure": "libdynamic-reconfigure-config-init-mutex-dev",
    "geometry_msgs": "ros-geometry-msgs",
    "map_msgs": "ros-map-msgs",
    "move_base_msgs": "ros-move-base-msgs",
    "nav_msgs": "ros-nav-msgs",
    "nodelet": "libnodelet-dev",
    "opencv_apps": "ros-opencv-apps",
    "pcl_msgs": "ros-pcl-msgs",
    "roscpp": "ros-roscpp-msg",
    "rosgraph_msgs": "ros-rosgraph-msgs",
    "sensor_msgs": "ros-sensor-msgs",
    "shape_msgs": "ros-shape-msgs",
    "std_msgs": "ros-std-msgs",
    "std_srvs": "ros-std-srvs",
    "stereo_msgs": "ros-stereo-msgs",
    "tf": "libtf-dev",
    "tf2_msgs": "ros-tf2-msgs",
    "topic_tools": "ros-topic-tools-srvs",
    "trajectory_msgs": "ros-trajectory-msgs",
    "visualization_msgs": "ros-visualization-msgs",
}

FOUND = [path for kind in KINDS for path in SHARE.glob(f"*/{kind}/*.{kind}")]
PACKAGES = sorted({*DEFINITIONS, *(path.parent.parent.name for path in FOUND)})
ACTIONS = [
    "actionlib/Test",
    "actionlib/TestRequest",
    "actionlib/TwoInts",
    "move_base_msgs/MoveBase",
    "nav_msgs/GetMap",
    "tf2_msgs/LookupTransform",
]

Ask = Callable[..., Any]


@pytest.fixture(scope="module")
def genpy(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Ask]:
    """Asks Debian's genpy a question of ``peers/genpy_types.py``."""
    debian.require_python("genpy", "genmsg")
    folder = tmp_path_factory.mktemp("genpy")
    with (
        (folder / "stderr").open("w+") as errors,
        subprocess.Popen(
            [debian.PYTHON, str(PEER)],
            env=debian.environment("http://localhost:1", folder),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
        ) as process,
    ):
        assert process.stdin is not None
        assert process.stdout is not None

        def ask(*question: Any) -> Any:
            print(json.dumps(question), file=process.stdin, flush=True)
            line = process.stdout.readline()
            assert line, (folder / "stderr").read_text()
            answer = json.loads(line)
            assert "error" not in answer, (question, answer)
            return answer

        yield ask


@pytest.fixture(params=PACKAGES)
def package(request: pytest.FixtureRequest) -> str:
    """Each package that Debian has definitions of, and any other that is installed."""
    name: str = request.param
    require(name)
    return name


def require(package: str) -> None:
    debian.require_definitions(
        package, DEFINITIONS.get(package, f"ros-{package.replace('_', '-')}")
    )
    debian.require_python(package)


@cache
def installed() -> MessageStore:
    """What finds Debian's files, and nothing else."""
    return MessageStore([SHARE], parent=None)


@cache
def bundled() -> MessageStore:
    return MessageStore([bundle()], parent=None)


@cache
def classes(store: MessageStore, package: str) -> dict[str, Any]:
    """All message classes of a package by types, those of its services and actions included."""
    found = {name: store.load_msg(name) for name in store.types(package)}
    for name in store.types(package, "srv"):
        service = store.load_srv(name)
        found |= {cls._type: cls for cls in (service.Request, service.Response)}
    for name in store.types(package, "action"):
        action = store.load_action(name)
        found |= {f"{name}{suffix}": getattr(action, suffix) for suffix in action._spec.messages}
    return found


def class_of(cls: Any) -> Callable[[str], Any]:
    """The classes of the types inside ``cls``, and of times, by name."""
    known: dict[str, Any] = {"time": Time, "duration": Duration}

    def visit(one: Any) -> None:
        known[one._type] = one
        for nested in one._nested.values():
            visit(nested)

    visit(cls)
    return known.__getitem__


def describe(cls: Any) -> dict[str, Any]:
    """What the peer says of a class, of ours."""
    names = [constant.name for constant in cls._constants]
    values = {name: getattr(cls, name) for name in names}
    return {
        "kind": "msg",
        "md5sum": cls._md5sum,
        "full_text": cls._full_text,
        "slots": list(cls.__slots__),
        "slot_types": list(cls._slot_types),
        "has_header": cls._has_header,
        "constants": {
            name: [type(value).__name__, value.hex() if isinstance(value, float) else value]
            for name, value in values.items()
        },
        "defaults": neutral.show(cls()),
        "zero": cls().to_bytes().hex(),
    }


def none_of(differences: Iterable[str]) -> None:
    found = list(differences)
    assert not found, "\n".join([f"{len(found)} differences", *found[:20]])


def same_types(theirs: dict[str, Any], store: MessageStore, types: list[str]) -> None:
    wrong = []
    for name in types:
        expected = dict(theirs[name])
        if expected["kind"] == "srv":
            service = store.load_srv(name)
            messages = [service._request_class._type, service._response_class._type]
            ours = {"kind": "srv", "md5sum": service._md5sum, "messages": messages}
        else:
            package = name.partition("/")[0]
            ours = describe(classes(store, package)[name])
            if store is not installed():
                # The same definitions, but other words in the comments.
                for text in (ours, expected):
                    text["full_text"] = sections(text["full_text"])
        wrong.append(neutral.difference(ours, expected, name))
    none_of(filter(None, wrong))


def sections(full_text: str) -> list[str]:
    return sorted(line for line in full_text.splitlines() if line.startswith("MSG: "))


# -- definitions -----------------------------------------------------------------------


def test_types_from_the_files_of_debian(genpy: Ask, package: str) -> None:
    """MD5 sums, texts, fields, constants with their kinds, defaults and their octets."""
    theirs = genpy("types", package)
    store = installed()
    assert theirs.keys() == {*classes(store, package), *store.types(package, "srv")}
    same_types(theirs, store, list(theirs))


@pytest.mark.parametrize("name", sorted(DEFINITIONS.keys() & set(bundled().packages())))
def test_types_from_the_bundle(genpy: Ask, name: str) -> None:
    """The same for the definitions that come with the library."""
    debian.require_python(name)
    theirs = genpy("types", name)
    store = bundled()
    assert theirs.keys() == {*classes(store, name), *store.types(name, "srv")}
    same_types(theirs, store, list(theirs))


def test_the_full_text_of_genpy_makes_the_same_type(genpy: Ask, package: str) -> None:
    """What their publishers send with a connection is all that is needed."""
    wrong = []
    for name, theirs in genpy("types", package).items():
        if theirs["kind"] == "msg":
            cls = MessageStore(parent=None).add_definition(name, theirs["full_text"])
            wrong.append(neutral.difference(describe(cls), theirs, name))
    none_of(filter(None, wrong))


@pytest.mark.parametrize("name", ACTIONS)
def test_messages_of_actions(genpy: Ask, name: str, tmp_path: Path) -> None:
    """Made from the .action file alone, they are those that genaction wrote files for."""
    package, _, base = name.partition("/")
    require(package)
    (tmp_path / package / "action").mkdir(parents=True)
    file = f"{package}/action/{base}.action"
    (tmp_path / file).write_bytes((SHARE / file).read_bytes())
    store = MessageStore([tmp_path], parent=installed())
    made = classes(store, package)
    types = [f"{name}{suffix}" for suffix in store.load_action(name)._spec.messages]
    assert len(types) == 7
    assert not any(made[type_] is classes(installed(), package)[type_] for type_ in types)
    # genaction puts a comment at the top of the files it writes; other texts are not compared.
    same_types(genpy("types", package), store, types)


# -- octets ----------------------------------------------------------------------------


def test_our_messages_at_genpy(genpy: Ask, package: str) -> None:
    """Encoded here, decoded by genpy: the same values, which it encodes to the same octets."""
    wrong = []
    for name, cls in classes(installed(), package).items():
        messages = [neutral.random_message(class_of(cls), name, seed) for seed in SEEDS]
        sent = [encode(cls, seed, message) for seed, message in zip(SEEDS, messages, strict=True)]
        answers = genpy("decode", name, sent)
        for seed, message, octets, (shown, again) in zip(
            SEEDS, messages, sent, answers, strict=True
        ):
            wrong += differences(f"{name}, seed {seed!r}", (message, octets), (shown, again))
    none_of(wrong)


def test_messages_of_genpy_here(genpy: Ask, package: str) -> None:
    """Encoded by genpy, decoded here: the same values, encoded to the same octets."""
    wrong = []
    for name, cls in classes(installed(), package).items():
        for seed, (message, octets) in zip(SEEDS, genpy("encode", name, SEEDS), strict=True):
            ours = cls.from_bytes(bytes.fromhex(octets))
            shown, again = neutral.show(ours), ours.to_bytes().hex()
            wrong += differences(f"{name}, seed {seed!r}", (message, octets), (shown, again))
            built = encode(cls, seed, message)
            wrong += differences(f"{name}, seed {seed!r}, built", octets, built)
    none_of(wrong)


def encode(cls: Any, seed: str, message: Any) -> str:
    try:
        octets: bytes = neutral.build(class_of(cls), cls._type, message).to_bytes()
    except SerializationError as exc:
        raise AssertionError(f"{cls._type}, seed {seed!r}: {exc}") from exc
    return octets.hex()


def differences(where: str, before: Any, after: Any) -> Iterator[str]:
    """The first difference of messages, else that of their octets, if any."""
    pairs = [(before, after)] if isinstance(before, str) else zip(before, after, strict=True)
    for one, other in pairs:
        if found := neutral.difference(one, other):
            yield f"{where}: {found}"
            return


@pytest.mark.parametrize(
    "octets", [b"\xff", b"gr\xfc\xdfe", b"\xed\xa0\x80", b"a\xc3", bytes(range(256))]
)
def test_strings_that_are_not_utf8(genpy: Ask, octets: bytes) -> None:
    """genpy shows them with replacement characters; here nothing is lost."""
    debian.require_python("std_msgs")
    cls = installed().load_msg("std_msgs/String")
    ours = cls(data=octets.decode("utf-8", "surrogateescape"))
    assert cls.from_bytes(ours.to_bytes()) == ours
    ((theirs, again),) = genpy("decode", "std_msgs/String", [ours.to_bytes().hex()])
    shown = octets.decode("utf-8", "replace")
    assert theirs == {"data": shown}
    assert again == cls(data=shown).to_bytes().hex()


@pytest.mark.parametrize(
    ("name", "secs", "nsecs"),
    [
        ("std_msgs/Time", 1, 1_000_000_000),
        ("std_msgs/Time", 1, 0xFFFFFFFF),
        ("std_msgs/Duration", 1, -1),
        ("std_msgs/Duration", -1, -2_000_000_001),
        ("std_msgs/Duration", 0, 0x7FFFFFFF),
    ],
)
def test_times_that_are_not_normal(genpy: Ask, name: str, secs: int, nsecs: int) -> None:
    """genpy makes them normal as it decodes; here they stay what the peer sent."""
    debian.require_python("std_msgs")
    cls = installed().load_msg(name)
    kind = Time if name.endswith("Time") else Duration
    octets = (secs % (1 << 32)).to_bytes(4, "little") + (nsecs % (1 << 32)).to_bytes(4, "little")
    ours = cls.from_bytes(octets)
    assert (ours.data.secs, ours.data.nsecs) == (secs, nsecs)
    assert ours.to_bytes() == octets
    ((theirs, again),) = genpy("decode", name, [octets.hex()])
    normal = kind(secs, nsecs)
    assert theirs == {"data": {"secs": normal.secs, "nsecs": normal.nsecs}}
    assert again == cls(data=normal).to_bytes().hex()
