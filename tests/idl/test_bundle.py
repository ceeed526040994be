"""The definitions that come with the library, each against an MD5 sum that others made.

``debian_md5.json`` has the sums of the classes in Debian, ``published_md5.json`` those that
public generated code has for the types Debian lacks, and where they were seen.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aioros1.idl import MessageStore
from aioros1.idl.paths import KINDS, bundle

HERE = Path(__file__).parent
SUFFIXES = (
    "Action",
    "ActionFeedback",
    "ActionGoal",
    "ActionResult",
    "Feedback",
    "Goal",
    "Result",
)
PACKAGES = [
    "ackermann_msgs",
    "actionlib",
    "actionlib_msgs",
    "actionlib_tutorials",
    "audio_common_msgs",
    "bond",
    "control_msgs",
    "diagnostic_msgs",
    "dynamic_reconfigure",
    "geographic_msgs",
    "geometry_msgs",
    "map_msgs",
    "mavros_msgs",
    "move_base_msgs",
    "nav_msgs",
    "nodelet",
    "pcl_msgs",
    "rosapi",
    "roscpp",
    "roscpp_tutorials",
    "rosgraph_msgs",
    "rospy_tutorials",
    "sensor_msgs",
    "shape_msgs",
    "std_msgs",
    "std_srvs",
    "stereo_msgs",
    "tf",
    "tf2_msgs",
    "topic_tools",
    "trajectory_msgs",
    "uuid_msgs",
    "vision_msgs",
    "visualization_msgs",
]
FILES = sorted(path for kind in KINDS for path in bundle().glob(f"*/{kind}/*.{kind}"))


def table(name: str) -> dict[tuple[str, str], str]:
    """MD5 sums by kind and type; of an action, those of its seven messages."""
    rows = json.loads((HERE / name).read_text())["types"]
    sums = {(kind, type_): md5sum for kind, type_, md5sum, *_ in rows}
    assert len(sums) == len(rows)
    return sums


@pytest.fixture(scope="module")
def store() -> MessageStore:
    return MessageStore([bundle()], parent=None)


@pytest.fixture(scope="module")
def sums(store: MessageStore) -> dict[tuple[str, str], str]:
    """What the bundle makes of itself, as in the tables."""
    made = {}
    for package in store.packages():
        for name in store.types(package):
            made["msg", name] = store.load_msg(name)._md5sum
        for name in store.types(package, "srv"):
            made["srv", name] = store.load_srv(name)._md5sum
        for name in store.types(package, "action"):
            for suffix in SUFFIXES:
                made["action", name + suffix] = store.load_msg(name + suffix)._md5sum
    return made


def test_packages(store: MessageStore) -> None:
    assert store.packages() == PACKAGES


def test_every_file_is_found_as_a_type(store: MessageStore) -> None:
    found = {
        store.find(name, kind)
        for package in PACKAGES
        for kind in KINDS
        for name in store.types(package, kind)
    }
    assert found == set(FILES) == {path for path in bundle().rglob("*") if path.is_file()}


@pytest.mark.parametrize("name", ["debian_md5.json", "published_md5.json"])
def test_sums_are_those_that_others_made(sums: dict[tuple[str, str], str], name: str) -> None:
    wanted = table(name)
    assert {key: sums.get(key) for key in wanted} == wanted


def test_nothing_is_without_proof(sums: dict[tuple[str, str], str]) -> None:
    debian, published = table("debian_md5.json"), table("published_md5.json")
    assert not set(debian) & set(published)
    assert set(sums) == set(debian) | set(published)


def test_every_published_sum_says_where() -> None:
    evidence = json.loads((HERE / "published_md5.json").read_text())
    assert {row[3] for row in evidence["types"]} == set(evidence["sources"])


def test_all_can_be_sent(store: MessageStore, sums: dict[tuple[str, str], str]) -> None:
    for kind, name in sums:
        if kind == "srv":
            service = store.load_srv(name)
            classes = [service.Request, service.Response]
        else:
            classes = [store.load_msg(name)]
        for cls in classes:
            octets = cls().to_bytes()
            assert cls.from_bytes(octets) == cls()
            assert len(octets) == cls._min_size


def test_an_action_has_the_messages_that_load_by_name(store: MessageStore) -> None:
    names = [name for package in PACKAGES for name in store.types(package, "action")]
    assert {"tf2_msgs/LookupTransform", "move_base_msgs/MoveBase"} < set(names)
    for name in names:
        action = store.load_action(name)
        assert action.Goal is store.load_msg(f"{name}Goal")
        assert action.ActionFeedback is store.load_msg(f"{name}ActionFeedback")


def test_files_hold_facts_and_no_comments() -> None:
    """One statement a line, single spaces, no comment, no empty line but a single one."""
    for path in FILES:
        text = path.read_text(encoding="ascii")
        assert "#" not in text, path
        lines = text.splitlines()
        assert text == "".join(f"{line}\n" for line in lines), path
        assert all(" ".join(line.split()) == line for line in lines), path
        assert "\n\n\n" not in text, path
        assert "" not in (lines[:1] + lines[-1:]), path


def test_the_page_in_the_documents_counts_right(store: MessageStore) -> None:
    page = (HERE.parents[1] / "docs" / "messages-bundled.md").read_text()
    rows = [line.split("|")[1:5] for line in page.splitlines() if line.startswith("| `")]
    counted = [
        [f"`{package}`", *(str(len(store.types(package, kind)) or "") for kind in KINDS)]
        for package in PACKAGES
    ]
    assert [[cell.strip() for cell in row] for row in rows] == counted


ASK_GENPY = """
import importlib, json, sys
answers = []
for kind, name in json.load(sys.stdin):
    package, _, short = name.partition("/")
    try:
        module = importlib.import_module(package + (".srv" if kind == "srv" else ".msg"))
        cls = getattr(module, short)
    except (ImportError, AttributeError):
        continue
    parts = [cls._request_class, cls._response_class] if kind == "srv" else [cls]
    facts = []
    for part in parts:
        plain = {k: v for k, v in vars(part).items() if k[0] != "_"}
        constants = {k: v for k, v in plain.items() if isinstance(v, (int, str, float))}
        facts.append([list(part.__slots__), list(part._slot_types), constants])
    answers.append([kind, name, cls._md5sum, facts])
json.dump(answers, sys.stdout)
"""


@pytest.mark.interop
def test_debian_has_what_its_table_says(system_python, store: MessageStore, sums) -> None:
    """Every type that is installed, with the fields and constants of genpy's class."""
    wanted = table("debian_md5.json")
    answers = json.loads(system_python(ASK_GENPY, json.dumps(sorted(sums))))
    assert len(answers) > 50
    for kind, name, md5sum, facts in answers:
        assert wanted.get((kind, name)) == md5sum, name
        if kind == "srv":
            parts = [store.load_srv(name).Request, store.load_srv(name).Response]
        else:
            parts = [store.load_msg(name)]
        assert facts == [
            [list(cls.__slots__), list(cls._slot_types), {c.name: c.value for c in cls._constants}]
            for cls in parts
        ], name
