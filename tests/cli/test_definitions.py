"""``aioros1 msg``, ``srv`` and ``action``."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

import aioros1
import aioros1.cli

ROOT = Path(aioros1.cli.__file__).parents[2]

FILES = {
    "shop_msgs/msg/Ware.msg": "# One\nuint8 NEW=0\nstring UNIT=kg # all of it\nstring name\n",
    "shop_msgs/msg/Shelf.msg": "Header header\nWare[] items\nfloat32[2] size\n",
    "shop_msgs/srv/Buy.srv": "Ware item\n---\nbool ok\n",
    "shop_msgs/srv/Close.srv": "---\n",
    "shop_msgs/action/Fetch.action": "Ware item\n---\n---\nfloat32 part\n",
    "toy_msgs/msg/Ware.msg": "int32 age\n",
}
SHELF = """\
std_msgs/Header header
  uint32 seq
  time stamp
  string frame_id
shop_msgs/Ware[] items
  uint8 NEW=0
  string UNIT=kg # all of it
  string name
float32[2] size
"""
FETCHED = ["Action", "ActionFeedback", "ActionGoal", "ActionResult", "Feedback", "Goal", "Result"]


@dataclass(frozen=True)
class Outcome:
    code: int
    out: str
    err: str

    @property
    def lines(self) -> list[str]:
        assert (self.code, self.err) == (0, "")
        return self.out.splitlines()


Run = Callable[..., Outcome]


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    """A directory with two packages."""
    for name, text in FILES.items():
        write(tmp_path / "src" / name, text)
    return tmp_path / "src"


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


@pytest.fixture
def run(shop: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a command line, with the two packages where ROS would find them."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(shop))

    def run(*words: str) -> Outcome:
        capsys.readouterr()
        code: object = 0
        try:
            aioros1.cli.main(words)
        except SystemExit as end:
            code = end.code or 0
        assert isinstance(code, int)
        return Outcome(code, *capsys.readouterr())

    return run


def process(*words: str, code: str = "", **environ: str) -> subprocess.CompletedProcess[bytes]:
    """Run a command line, or ``code``, in a process."""
    env = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
    program = ["-c", code] if code else ["-m", "aioros1"]
    return subprocess.run(
        [sys.executable, *program, *words],
        env={**env, "PYTHONPATH": str(ROOT), **environ},
        capture_output=True,
        check=False,
        timeout=30,
    )


# One type


def test_show(run: Run) -> None:
    # As with rosmsg there is an empty line at the end.
    assert run("msg", "show", "shop_msgs/Shelf") == Outcome(0, f"{SHELF}\n", "")
    assert run("msg", "info", "shop_msgs/Shelf.msg") == Outcome(0, f"{SHELF}\n", "")
    assert run("srv", "show", "shop_msgs/Close").lines == ["---", ""]
    assert run("srv", "show", "shop_msgs/Buy").lines == [
        "shop_msgs/Ware item",
        "  uint8 NEW=0",
        "  string UNIT=kg # all of it",
        "  string name",
        "---",
        "bool ok",
        "",
    ]
    assert run("action", "show", "shop_msgs/Fetch").lines[-4:] == ["---", "---", "float32 part", ""]
    assert run("msg", "show", "shop_msgs/FetchFeedback").lines == ["float32 part", ""]


@pytest.mark.parametrize("option", ["-r", "--raw"])
def test_show_the_text(run: Run, option: str) -> None:
    for file, text in FILES.items():
        package, kind, name = file.split("/")
        shown = run(kind, "show", option, f"{package}/{name.partition('.')[0]}")
        assert shown == Outcome(0, f"{text}\n", "")


def test_a_name_without_a_package_shows_all_of_that_name(run: Run) -> None:
    shown = run("msg", "show", "-r", "Ware")
    shop, toy = FILES["shop_msgs/msg/Ware.msg"], FILES["toy_msgs/msg/Ware.msg"]
    assert shown == Outcome(0, f"[shop_msgs/Ware]:\n{shop}\n[toy_msgs/Ware]:\n{toy}\n", "")
    assert run("srv", "show", "Buy").lines[0] == "[shop_msgs/Buy]:"
    assert [line.split(" ")[0] for line in run("msg", "md5", "Ware").lines] == [
        "[shop_msgs/Ware]:",
        "[toy_msgs/Ware]:",
    ]


def test_one_that_cannot_be_read_does_not_hide_the_others(run: Run, shop: Path) -> None:
    broken = shop / "a_msgs" / "msg" / "Ware.msg"
    write(broken, "int32 a\nint32\n")
    shown = run("msg", "show", "Ware")
    assert (shown.code, shown.out.count("[")) == (1, 2)
    assert shown.err.startswith(f"aioros1: {broken}:2: ")


def test_md5(run: Run, shop: Path) -> None:
    store = aioros1.MessageStore([shop])
    for name in ("shop_msgs/Shelf", "shop_msgs/FetchAction", "std_msgs/String"):
        assert run("msg", "md5", name).lines == [store.load_msg(name)._md5sum]
    for name in ("shop_msgs/Buy", "std_srvs/SetBool"):
        assert run("srv", "md5", name).lines == [store.load_srv(name)._md5sum]
    assert run("msg", "md5", "std_msgs/String").lines == ["992ce8a1687cec8c8bd883ec73ca41d1"]


def test_md5_of_an_action_are_those_of_its_messages(run: Run, shop: Path) -> None:
    store = aioros1.MessageStore([shop])
    lines = run("action", "md5", "shop_msgs/Fetch").lines
    names = [f"shop_msgs/Fetch{suffix}" for suffix in FETCHED]
    assert set(lines) == {f"[{name}]: {store.load_msg(name)._md5sum}" for name in names}
    assert lines[0].endswith(f": {store.load_action('shop_msgs/Fetch')._md5sum}")


def test_full_text(run: Run, shop: Path) -> None:
    store = aioros1.MessageStore([shop])
    shelf = run("msg", "full-text", "shop_msgs/Shelf")
    assert shelf.out == store.load_msg("shop_msgs/Shelf")._full_text + "\n"
    assert "MSG: shop_msgs/Ware\n" in shelf.out
    buy = run("srv", "full-text", "shop_msgs/Buy")
    assert buy.out == store.load_srv("shop_msgs/Buy")._full_text + "\n"
    fetch = run("action", "full-text", "shop_msgs/Fetch")
    assert fetch.out == store.load_msg("shop_msgs/FetchAction")._full_text + "\n"


def test_the_name_may_come_from_standard_input(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n std_msgs/String \nmore\n"))
    assert run("msg", "show").lines == ["string data", ""]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("stdin", [io.StringIO("\n"), Terminal("std_msgs/String\n"), None])
def test_no_name_at_all(
    run: Run, monkeypatch: pytest.MonkeyPatch, stdin: io.StringIO | None
) -> None:
    monkeypatch.setattr(sys, "stdin", stdin)
    assert run("msg", "show") == Outcome(
        2, "", "aioros1: no type given, neither as an argument nor on standard input\n"
    )


# Many types


def test_list(run: Run) -> None:
    for kind in ("msg", "srv", "action"):
        names = run(kind, "list").lines
        assert names == sorted(set(names))
        listed = [name.partition("/")[2] for name in names if name.startswith("shop_msgs/")]
        expected = {
            "msg": [*(f"Fetch{suffix}" for suffix in FETCHED), "Shelf", "Ware"],
            "srv": ["Buy", "Close"],
            "action": ["Fetch"],
        }
        assert listed == expected[kind]
    assert "std_msgs/String" in run("msg", "list").lines


def test_all_that_is_listed_can_be_shown(run: Run) -> None:
    for kind in ("msg", "srv", "action"):
        for name in run(kind, "list", "shop_msgs/").lines:
            assert run(kind, "show", name).code == 0


@pytest.mark.parametrize(
    ("pattern", "names"),
    [
        ("op_msgs/SH", ["shop_msgs/Shelf"]),
        ("*/ware", ["shop_msgs/Ware", "toy_msgs/Ware"]),
        ("[st]?y_msgs*", ["toy_msgs/Ware"]),
        ("toy_msgs/War?", ["toy_msgs/Ware"]),
    ],
)
def test_list_those_that_fit(run: Run, pattern: str, names: list[str]) -> None:
    assert run("msg", "list", pattern).lines == names


def test_nothing_fits(run: Run) -> None:
    assert run("srv", "list", "*/Ware") == Outcome(
        1, "", "aioros1: no type of service fits '*/Ware'\n"
    )


def test_a_definition_that_cannot_be_read_is_listed(run: Run, shop: Path) -> None:
    write(shop / "toy_msgs" / "msg" / "Odd.msg", "nonsense")
    write(shop / "toy_msgs" / "action" / "Do.action", "nonsense")
    assert run("msg", "list", "toy_msgs/Odd").lines == ["toy_msgs/Odd"]
    assert run("action", "package", "toy_msgs").lines == ["toy_msgs/Do"]


def test_package_and_packages(run: Run) -> None:
    assert run("srv", "package", "shop_msgs").lines == ["shop_msgs/Buy", "shop_msgs/Close"]
    assert run("srv", "package", "-s", "shop_msgs").out == "shop_msgs/Buy shop_msgs/Close\n"
    assert run("srv", "package", "toy_msgs") == Outcome(0, "", "")
    for kind, names in {
        "msg": {"shop_msgs", "toy_msgs", "std_msgs"},
        "action": {"shop_msgs"},
    }.items():
        packages = run(kind, "packages").lines
        assert names <= set(packages)
        assert packages == sorted({name.partition("/")[0] for name in run(kind, "list").lines})
        assert run(kind, "packages", "--single-line").out == " ".join(packages) + "\n"
    assert "toy_msgs" not in run("srv", "packages").lines


# Where they are looked for


def test_a_path_comes_before_all_others(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path / "one" / "toy_msgs" / "msg" / "Ware.msg", "int8 one\n")
    write(tmp_path / "two" / "toy_msgs" / "msg" / "Ware.msg", "int8 two\n")
    write(tmp_path / "two" / "two_msgs" / "msg" / "Box.msg", "toy_msgs/Ware item\nint8 b\n")
    one, two = str(tmp_path / "one"), str(tmp_path / "two")
    assert run("msg", "show", "toy_msgs/Ware").lines == ["int32 age", ""]
    assert run("msg", "show", "toy_msgs/Ware", "--path", two).lines == ["int8 two", ""]
    shown = run("msg", "show", f"--path={one}", "--path", two, "two_msgs/Box")
    assert shown.lines == ["toy_msgs/Ware item", "  int8 one", "int8 b", ""]
    monkeypatch.chdir(tmp_path / "two" / "two_msgs")  # the package itself
    assert run("msg", "package", "two_msgs", "--path", ".").lines == ["two_msgs/Box"]
    monkeypatch.chdir("msg")
    assert run("msg", "show", "-r", "two_msgs/Box", "--path", ".").lines[-2] == "int8 b"


# What goes wrong


@pytest.mark.parametrize(
    ("words", "parts"),
    [
        ("msg show shop_msgs/Shelv", ["no definition (.msg) of shop_msgs/Shelv; searched: {shop}",
                                      "did you mean shop_msgs/Shelf"]),
        ("msg md5 shop_msgs/shelf", ["did you mean shop_msgs/Shelf"]),
        ("msg full-text toy_msgs/Shelf", ["did you mean shop_msgs/Shelf"]),
        ("msg show shop_msgs::Shelf", ["'shop_msgs::Shelf' is not the name of a type",
                                       "did you mean shop_msgs/Shelf"]),
        ("msg show shop_msgs.msg.Shelf", ["did you mean shop_msgs/Shelf"]),
        ("msg show a/b/c", ["'a/b/c' is not the name of a type: expected 'package/Type'"]),
        ("msg show ///", ["'///' is not the name of a type"]),
        ("msg show Shelve", ["no type of message Shelve in any package; searched: {shop}",
                             "did you mean shop_msgs/Shelf"]),
        ("msg show shop_msgs/Buy", ["shop_msgs/Buy is a type of service: aioros1 srv show"]),
        ("msg show Fetch", ["shop_msgs/Fetch is a type of action: aioros1 action show"]),
        ("srv show toy_msgs/Wares", ["no definition (.srv) of toy_msgs/Wares"]),
        ("action md5 shop_msgs/Fetc", ["no definition (.action) of shop_msgs/Fetc",
                                       "did you mean shop_msgs/Fetch"]),
        ("msg package shop_msg", ["no package 'shop_msg' with definitions; searched: {shop}",
                                  "did you mean shop_msgs"]),
    ],
)  # fmt: skip
def test_what_is_not_there(run: Run, shop: Path, words: str, parts: list[str]) -> None:
    outcome = run(*words.split(" "))
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.startswith("aioros1: ")
    for part in parts:
        assert part.format(shop=shop) in outcome.err


def test_nothing_is_suggested_that_is_not_like_it(run: Run) -> None:
    error = run("msg", "show", "Qxzptlk").err
    assert len(error.splitlines()) == 1


def test_a_definition_that_needs_another(run: Run, shop: Path) -> None:
    write(shop / "toy_msgs" / "msg" / "Box.msg", "Lid lid\n")
    outcome = run("msg", "show", "toy_msgs/Box")
    assert outcome.code == 1
    assert outcome.err.startswith(
        "aioros1: no definition (.msg) of toy_msgs/Lid, needed by toy_msgs/Box; searched: "
    )
    # The name that was given is right.
    assert "did you mean" not in outcome.err


@pytest.mark.parametrize("command", ["show", "md5", "full-text"])
def test_a_definition_that_cannot_be_read(run: Run, shop: Path, command: str) -> None:
    path = shop / "toy_msgs" / "srv" / "Do.srv"
    write(path, "int32 a\n---\nint32 b c\n")
    outcome = run("srv", command, "toy_msgs/Do")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err == f"aioros1: {path}:3: expected 'type name', got 'int32 b c'\n"


def test_a_name_that_no_file_can_have(run: Run) -> None:
    outcome = run("msg", "show", f"toy_msgs/{'Ware' * 100}")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.startswith("aioros1: ")
    assert "WareWare" in outcome.err


@pytest.mark.parametrize(
    "words",
    [
        "nope",
        "msg nope",
        "msg list --nope",
        "msg show a b",
        "msg show --path /does/not/exist a/b",
        "msg package",
        "srv packages x",
    ],
)
def test_wrong_usage(run: Run, words: str) -> None:
    outcome = run(*words.split(" "))
    assert (outcome.code, outcome.out) == (2, "")
    assert "Traceback" not in outcome.err
    assert outcome.err.strip()


# The program


@pytest.mark.parametrize("words", ["", "msg", "msg --help", "srv show --help", "action md5 -h"])
def test_help(run: Run, words: str) -> None:
    outcome = run(*words.split())
    assert (outcome.code, outcome.err) == (0, "")
    assert "Usage: aioros1" in outcome.out


def test_every_command_has_a_help(run: Run) -> None:
    for kind in ("msg", "srv", "action"):
        text = run(kind, "--help").out
        for command in ("show", "md5", "full-text", "list", "package", "packages"):
            assert command in text
            assert "--path" in run(kind, command, "--help").out


def test_as_a_process() -> None:
    done = process("msg", "md5", "std_msgs/String")
    assert (done.returncode, done.stdout.split(), done.stderr) == (
        0, [b"992ce8a1687cec8c8bd883ec73ca41d1"], b"",
    )  # fmt: skip


def test_it_loads_nothing_of_the_network() -> None:
    code = (
        "import sys\n"
        "from aioros1.cli import main\n"
        "try: main(['msg', 'show', 'geometry_msgs/PoseStamped'])\n"
        "except SystemExit as end: assert not end.code, end.code\n"
        "heavy = {'aiohttp', 'asyncio', 'ssl', 'rich.console'} & set(sys.modules)\n"
        "sys.exit(f'imported: {heavy}' if heavy else 0)"
    )
    done = process(code=code)
    assert (done.returncode, done.stderr) == (0, b"")


def test_a_terminal_without_the_character(shop: Path) -> None:
    write(shop / "toy_msgs" / "msg" / "Warm.msg", "# 20\N{DEGREE SIGN}\nint8 t\n")
    done = process(
        "msg", "show", "-r", "toy_msgs/Warm",
        ROS_PACKAGE_PATH=str(shop), PYTHONIOENCODING="ascii", PYTHONUTF8="0",
    )  # fmt: skip
    assert (done.returncode, done.stdout.split(b"\n")[0], done.stderr) == (0, b"# 20\\xb0", b"")


@pytest.mark.skipif(os.name != "posix", reason="a pipe that nobody reads")
@pytest.mark.parametrize("words", [["msg", "list"], ["msg", "show", "Header"], ["--help"]])
def test_a_reader_that_has_gone(words: list[str]) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "aioros1", *words],
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdout=writing,
            stderr=subprocess.PIPE,
            check=False,
            timeout=30,
        )
    finally:
        os.close(writing)
    assert (done.returncode, done.stderr) == (1, b"")
