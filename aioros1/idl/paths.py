"""Finds definition files: in ROS 1 installations, and in the bundle of the library."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Literal, TypeAlias

__all__ = ["KINDS", "Kind", "SearchPath"]

Kind: TypeAlias = Literal["msg", "srv", "action"]
KINDS: tuple[Kind, ...] = ("msg", "srv", "action")

_STOP_FILES = frozenset(
    {"CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE", "rospack_nosubdirs", "NO_ROS"}
)
_PACKAGE_NAME = re.compile(rb"<name>\s*([A-Za-z][\w-]*)\s*</name>")
_PACKAGE_FILES = ("package.xml", "manifest.xml")


def bundle() -> Path:
    """The directory of the definitions that come with the library."""
    package = Path(__file__).resolve().parent.parent
    packed = package / "share" / "msg"  # in a wheel
    return packed if packed.is_dir() else package.parent / "share" / "msg"


def installed() -> Iterator[Path]:
    """The ``share`` directories of the ROS 1 distributions on this machine."""
    # ROS 2 is installed in the same place, with other definitions of the same names.
    marked = [path.parent / "share" for path in Path("/opt/ros").glob("*/.catkin")]
    preferred = os.environ.get("ROS_DISTRO")
    yield from sorted(marked, key=lambda path: (path.parent.name == preferred, path), reverse=True)
    yield Path("/usr/share")


class _Root:
    """One directory to search, in any of the layouts in use.

    Definitions are in ``<root>/<pkg>/msg/T.msg`` or ``<root>/<pkg>/T.msg``, or the root is
    a package or its ``msg`` directory. With ``crawl`` packages are also found at any depth,
    by their ``package.xml``.
    """

    def __init__(self, path: Path, *, crawl: bool) -> None:
        self.path = path
        self.crawl = crawl
        self._crawled: dict[str, Path] | None = None

    def directories(self, package: str, kind: Kind) -> Iterator[Path]:
        """Where files of the package may be; those that are quick to look at come first."""
        path = self.path
        yield path / package / kind
        yield path / package
        if path.name == package:
            yield path / kind
        if path.name == kind and path.parent.name == package:
            yield path
        crawled = self.crawled().get(package)
        if crawled is not None:
            yield crawled / kind

    def packages(self) -> set[str]:
        found = set(self.crawled())
        path = self.path
        if any((path / kind).is_dir() for kind in KINDS):
            found.add(path.name)
        if path.name in KINDS:
            found.add(path.parent.name)
        found.update(entry.name for entry in _subdirectories(path) if entry.name not in KINDS)
        return found

    def crawled(self) -> dict[str, Path]:
        """The packages that were found by their ``package.xml``; they are searched once."""
        found = self._crawled
        if found is None:
            self._crawled = found = dict(_crawl(self.path)) if self.crawl else {}
        return found


def _subdirectories(path: Path | str) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(path) as entries:
            found = [e for e in entries if not e.name.startswith(".") and e.is_dir()]
    except OSError:
        return []
    return sorted(found, key=lambda entry: entry.name)


def _crawl(root: Path) -> Iterator[tuple[str, Path]]:
    """Name and directory of each package below; of two with one name, the first."""
    seen: set[str] = set()
    names: set[str] = set()
    waiting = [str(root)]
    while waiting:
        path = waiting.pop(0)
        real = os.path.realpath(path)
        if real in seen:
            continue  # a symbolic link that leads back
        seen.add(real)
        try:
            content = set(os.listdir(path))
        except OSError:
            continue
        if content & _STOP_FILES and "rospack_nosubdirs" not in content:
            continue
        manifest = next((name for name in _PACKAGE_FILES if name in content), None)
        if manifest is not None:
            name = _package_name(os.path.join(path, manifest)) or os.path.basename(path)
            if name not in names:
                names.add(name)
                yield name, Path(path)
            continue  # there are no packages inside packages
        if "rospack_nosubdirs" not in content:
            waiting += [entry.path for entry in _subdirectories(path)]


def _package_name(manifest: str) -> str | None:
    try:
        with open(manifest, "rb") as file:
            match = _PACKAGE_NAME.search(file.read(65536))
    except OSError:
        return None
    return match[1].decode() if match else None


class SearchPath:
    """An ordered list of directories to search.

    ``standard`` adds those of ``ROS_PACKAGE_PATH``, of an installed ROS and the bundle.
    Nothing is read before the first search. A change of ``ROS_PACKAGE_PATH`` counts from
    the next search on.
    """

    def __init__(self, paths: Iterable[str | os.PathLike[str]] = (), *, standard: bool = False):
        self._given = [_Root(Path(path), crawl=True) for path in paths]
        self._standard = standard
        self._environment: tuple[str | None, list[_Root]] = ("", [])
        self._fixed: list[_Root] | None = None

    def _roots(self) -> list[_Root]:
        if not self._standard:
            return self._given
        # Threads may do this at the same time: each reads once and replaces as a whole.
        fixed = self._fixed
        if fixed is None:
            self._fixed = fixed = [_Root(p, crawl=False) for p in (*installed(), bundle())]
        value = os.environ.get("ROS_PACKAGE_PATH", "")
        known, roots = self._environment
        if known != value:
            roots = [_Root(Path(part), crawl=True) for part in value.split(os.pathsep) if part]
            self._environment = value, roots
        return [*self._given, *roots, *fixed]

    def find(self, package: str, name: str, kind: Kind) -> Path | None:
        """The file that defines ``package/name``, or None."""
        for root in self._roots():
            for directory in root.directories(package, kind):
                path = directory / f"{name}.{kind}"
                if path.is_file():
                    return path
        return None

    def types(self, package: str, kind: Kind) -> set[str]:
        """The names (without the package) of all types of the package."""
        return {
            path.stem
            for root in self._roots()
            for directory in root.directories(package, kind)
            for path in directory.glob(f"*.{kind}")
        }

    def candidates(self, *, given: bool = False) -> set[str]:
        """The names that packages may have, by the directories there are: quick to say.

        With ``given``, only in directories that the user named, here or in the environment.
        """
        roots = [root for root in self._roots() if root.crawl or not given]
        return set().union(*(root.packages() for root in roots))

    def packages(self) -> set[str]:
        """The packages that have definitions of any kind."""
        names = self.candidates()
        return {name for name in names if any(self.types(name, kind) for kind in KINDS)}

    def places(self) -> list[str]:
        """The directories that are searched, for an error."""
        return [str(root.path) for root in self._roots()]

    def describe(self) -> str:
        """What is searched, in a few words and without looking at any file."""
        given = [str(root.path) for root in self._given]
        if len(given) > 3:
            given[2:] = [f"{len(given) - 2} more directories"]
        if self._standard:
            given.append("the standard places")
        return ", ".join(given) or "no directories"
