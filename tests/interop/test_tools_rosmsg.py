"""rosmsg and rossrv beside ``aioros1 msg`` and ``aioros1 srv``: the same words, the same output."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

import aioros1

from . import debian
from .processes import Process, Result, end_all

ROOT = Path(aioros1.__file__).parents[1]
SHARE = Path("/usr/share")

TYPES = [
    ("msg", "std_msgs/String"),
    ("msg", "std_msgs/Empty"),
    ("msg", "std_msgs/Float64MultiArray"),
    ("msg", "geometry_msgs/PoseArray"),
    ("msg", "geometry_msgs/PoseWithCovarianceStamped"),
    ("msg", "sensor_msgs/BatteryState"),
    ("msg", "sensor_msgs/CameraInfo"),
    ("msg", "sensor_msgs/PointCloud2"),
    ("msg", "nav_msgs/Odometry"),
    ("msg", "nav_msgs/GetMapAction"),
    ("msg", "nav_msgs/GetMapGoal"),
    ("srv", "std_srvs/Empty"),
    ("srv", "std_srvs/SetBool"),
    ("srv", "sensor_msgs/SetCameraInfo"),
    ("srv", "nav_msgs/GetPlan"),
    ("srv", "roscpp/GetLoggers"),
]
PACKAGES = sorted({name.partition("/")[0] for _, name in TYPES})

ODD = """\
# A comment that is not ASCII: 90\N{DEGREE SIGN}

int8 LOW = -128
 float64   TURN=1.50   # of a circle
bool YES=True
string QUOTED= "a # b"
string NOTHING=
Header header
Other[2]  others
Other[] more
geometry_msgs/Point[] points
duration[3] waits
char c
byte b
"""
ODD_SERVICE = "# what to do\nOther other\nstring WHAT=do it\n--- # done\nOdd odd\n"


class Both:
    """Runs one command line of rosmsg or rossrv, and the same of ours."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.env = debian.environment("http://localhost:1", folder / "ros_home")
        self.processes: list[Process] = []

    async def __call__(
        self, kind: str, *words: str, codes: tuple[int, int] = (0, 0), stdin: str | None = None
    ) -> tuple[str, str]:
        """What either wrote to standard output."""
        debian.require(f"ros{kind}")
        ours = (sys.executable, "-m", "aioros1", kind)
        theirs, our_result = await asyncio.gather(
            self._run([f"ros{kind}", *words], stdin), self._run([*ours, *words], stdin)
        )
        assert (theirs.code, our_result.code) == codes, (theirs, our_result)
        assert "Traceback" not in our_result.stderr
        return theirs.stdout, our_result.stdout

    async def _run(self, argv: list[str], stdin: str | None) -> Result:
        process = Process(
            argv,
            env={**self.env, "PYTHONPATH": str(ROOT)} if argv[0] == sys.executable else self.env,
            folder=self.folder,
            label=f"{len(self.processes):03}-{Path(argv[0]).name}",
        )
        self.processes.append(process)
        if stdin is not None:
            process.tell(stdin)
        process.close()
        return await process.wait()


@pytest.fixture
async def both(tmp_path: Path) -> AsyncIterator[Both]:
    for package in PACKAGES:
        # Without this file rosmsg does not see the definitions beside it.
        path = f"{SHARE}/{package}/package.xml"
        debian.PACKAGES[path] = f"lib{package.replace('_', '-')}-dev"
        debian.require(path)
    both = Both(tmp_path)
    try:
        yield both
    finally:
        await end_all(both.processes)


@pytest.mark.parametrize(("kind", "name"), TYPES)
async def test_show(both: Both, kind: str, name: str) -> None:
    theirs, ours = await both(kind, "show", name)
    assert ours == theirs
    theirs, ours = await both(kind, "show", "-r", name)
    assert ours == theirs


@pytest.mark.parametrize(("kind", "name"), TYPES)
async def test_md5(both: Both, kind: str, name: str) -> None:
    debian.require_python(name.partition("/")[0])
    theirs, ours = await both(kind, "md5", name)
    assert ours == theirs
    assert len(theirs) == 33


async def test_the_name_can_come_from_another_program(both: Both) -> None:
    theirs, ours = await both("msg", "show", stdin="\nnav_msgs/Path")
    assert ours == theirs
    assert "poses" in theirs


async def test_the_name_of_a_file_will_do(both: Both) -> None:
    theirs, ours = await both("msg", "info", "std_msgs/String.msg")
    assert ours == theirs == "string data\n\n"


def sections(text: str) -> dict[str, str]:
    """What follows each heading ``[pkg/Type]:``."""
    parts = [part.partition("]:") for part in text.split("[")[1:]]
    return {name: content for name, _, content in parts}


@pytest.mark.parametrize(
    ("kind", "command", "name"),
    [("msg", "show", "Header"), ("srv", "show", "Empty"), ("srv", "md5", "Empty")],
)
async def test_a_name_without_a_package(both: Both, kind: str, command: str, name: str) -> None:
    """Ours has the types of the packages it brings along, too, and puts all in order."""
    debian.require_python("roscpp", "std_srvs")
    theirs, ours = await both(kind, command, name)
    expected = sections(theirs)
    assert expected
    assert {name: text for name, text in sections(ours).items() if name in expected} == expected
    assert list(sections(ours)) == sorted(sections(ours))


@pytest.mark.parametrize("kind", ["msg", "srv"])
async def test_lists(both: Both, kind: str) -> None:
    """All that rosmsg lists, in the same order, and what rosmsg has no way to find.

    It leaves out packages without a ``package.xml``. Ours lists them, and the definitions
    that come with the library.
    """

    def is_out_of_reach(name: str) -> bool:
        package, _, type_ = name.partition("/")
        here = SHARE / package
        return not ((here / "package.xml").exists() and (here / kind / f"{type_}.{kind}").exists())

    theirs, ours = (text.splitlines() for text in await both(kind, "list"))
    assert [name for name in ours if name in set(theirs)] == theirs
    assert [name for name in ours if name not in set(theirs) and not is_out_of_reach(name)] == []

    theirs_packages, our_packages = (text.splitlines() for text in await both(kind, "packages"))
    assert [name for name in our_packages if name in set(theirs_packages)] == theirs_packages
    assert our_packages == sorted({name.partition("/")[0] for name in ours})
    on_one_line = await both(kind, "packages", "-s")
    assert [text.split() for text in on_one_line] == [theirs_packages, our_packages]
    assert [text.count("\n") for text in on_one_line] == [1, 1]

    for words in (["package", "nav_msgs"], ["package", "-s", "sensor_msgs"]):
        their_types, our_types = await both(kind, *words)
        extra = [name for name in our_types.split() if name not in their_types.split()]
        if extra:  # of a later version of the package
            assert all(map(is_out_of_reach, extra))
        else:
            assert our_types == their_types


async def test_definitions_of_ones_own(both: Both, tmp_path: Path) -> None:
    """A package on ``ROS_PACKAGE_PATH``, with what is rarely written in definitions."""
    package = tmp_path / "ws" / "src" / "odd_msgs"
    for folder in ("msg", "srv"):
        (package / folder).mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package><name>odd_msgs</name><version>1.0.0</version><description/>"
        "<maintainer email='a@b.c'>a</maintainer><license>BSD</license></package>"
    )
    (package / "msg" / "Odd.msg").write_text(ODD)
    (package / "msg" / "Other.msg").write_text("std_msgs/Time[] times\nuint8 ONE=1")
    (package / "srv" / "Do.srv").write_text(ODD_SERVICE)
    both.env["ROS_PACKAGE_PATH"] = f"{tmp_path / 'ws'}:/usr/share"

    for kind, name in (("msg", "odd_msgs/Odd"), ("msg", "Odd"), ("msg", "odd_msgs/Other"),
                       ("srv", "odd_msgs/Do")):  # fmt: skip
        for words in (["show"], ["show", "--raw"]):
            theirs, ours = await both(kind, *words, name)
            assert ours == theirs
            assert theirs.strip()
    theirs, ours = await both("msg", "package", "odd_msgs")
    assert ours == theirs == "odd_msgs/Odd\nodd_msgs/Other\n"


async def test_what_is_not_there(both: Both) -> None:
    """Ours always ends with 1, and rosmsg with this and that."""
    nothing = ("", "")
    assert await both("msg", "show", "std_msgs/Nope", codes=(1, 1)) == nothing
    assert await both("msg", "show", "nope/Nope", codes=(1, 1)) == nothing
    assert await both("srv", "show", "Nope", codes=(1, 1)) == nothing
    assert await both("msg", "show", "std_msgs::String", codes=(2, 1)) == nothing
    assert await both("msg", "md5", "std_msgs/Nope", codes=(0, 1)) == nothing
    assert await both("msg", "md5", "Nope", codes=(0, 1)) == nothing
    assert await both("msg", "package", "nope", codes=(64, 1)) == nothing
    assert await both("msg", "show", "a", "b", codes=(2, 2)) == nothing
    # A package that has services only: an empty list is nothing, and not an empty line.
    assert await both("msg", "package", "std_srvs") == ("\n", "")
