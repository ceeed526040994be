"""``aioros1 msg``, ``srv`` and ``action``: definitions, as rosmsg and rossrv show them."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from difflib import get_close_matches
from os.path import abspath
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from cyclopts import App, Parameter
from cyclopts.types import ExistingDirectory

from aioros1 import MessageError, MessageNotFoundError
from aioros1.cli import _catalog

if TYPE_CHECKING:
    from aioros1 import MessageStore
    from aioros1.idl import Kind

__all__ = ["KINDS", "make_noun"]

KINDS: dict[Kind, str] = {"msg": "message", "srv": "service", "action": "action"}
"""The nouns, and what is defined there."""

TypeName: TypeAlias = Annotated[
    str | None,
    Parameter(
        help="The type, as package/Type; without the package, all types of that name. "
        "Read from standard input if not given."
    ),
]
Paths: TypeAlias = Annotated[
    tuple[ExistingDirectory, ...],
    Parameter(
        name="--path",
        negative=(),
        show_default=False,
        help="A directory to search first, with packages in it or a package itself; can be "
        "repeated. Always searched are ROS_PACKAGE_PATH, an installed ROS and the "
        "definitions that come with aioros1.",
    ),
]
SingleLine: TypeAlias = Annotated[
    bool,
    Parameter(
        name=["--single-line", "-s"], negative=(), show_default=False, help="All on one line."
    ),
]
Raw: TypeAlias = Annotated[
    bool,
    Parameter(
        name=["--raw", "-r"],
        negative=(),
        show_default=False,
        help="The text of the file, comments included.",
    ),
]


def make_noun(kind: Kind) -> App:
    """The command ``aioros1 KIND``."""
    commands = _ActionCommands(kind) if kind == "action" else _Commands(kind)
    noun = App(name=kind, help=f"Look up definitions of {KINDS[kind]} types.")
    noun.command(commands.show, name=["show", "info"])
    noun.command(commands.md5, name="md5")
    noun.command(commands.full_text, name="full-text")
    noun.command(commands.list_, name="list")
    noun.command(commands.package, name="package")
    noun.command(commands.packages, name="packages")
    return noun


class _Commands:
    """The commands for one kind of definition; their docstrings are the help."""

    def __init__(self, kind: Kind) -> None:
        self.kind: Kind = kind

    # -- one type ---------------------------------------------------------------------

    def show(self, type: TypeName = None, /, *, raw: Raw = False, path: Paths = ()) -> None:
        """Show the constants and fields of a type, and those of the types inside."""
        from aioros1.idl import outline, spec_of

        store = _store(path)

        def text(cls: Any) -> str:
            spec = spec_of(cls)
            # Either text ends its last line itself: the empty one after it is rosmsg's way.
            return spec.text if raw else outline(spec, lambda name: spec_of(store.load_msg(name)))

        self._print(store, type, text)

    def md5(self, type: TypeName = None, /, *, path: Paths = ()) -> None:
        """Show the MD5 sum by which programs compare definitions."""
        self._print(_store(path), type, lambda cls: cls._md5sum, after=" ")

    def full_text(self, type: TypeName = None, /, *, path: Paths = ()) -> None:
        """Show the definition with those of all types it needs, as publishers send it."""
        self._print(_store(path), type, lambda cls: cls._full_text)

    def _print(
        self, store: MessageStore, name: str | None, text: Callable[[Any], str], after: str = "\n"
    ) -> None:
        """Print the text of a type, or with headings those of all types of that name."""
        name = (_from_stdin() if name is None else name).removesuffix(f".{self.kind}")
        if not name.isidentifier():
            print(text(self._load(store, name)))
            return
        found = [n for n in _catalog.all_types(store, self.kind) if n.endswith(f"/{name}")]
        if not found:
            raise MessageNotFoundError(
                f"no type of {KINDS[self.kind]} {name} in any package; "
                f"searched: {', '.join(store.places())}"
                f"{_did_you_mean(store.suggest(name, self.kind))}{self._hint(store, name)}"
            )
        failed = False
        for each in found:
            try:
                print(f"[{each}]:{after}{text(self._load(store, each))}")
            except MessageError as error:
                print(f"aioros1: {error}", file=sys.stderr)
                failed = True
        if failed:
            raise SystemExit(1)

    def _load(self, store: MessageStore, name: str) -> Any:
        load: dict[Kind, Callable[[str], Any]] = {
            "msg": store.load_msg,
            "srv": store.load_srv,
            "action": store.load_action,
        }
        try:
            return load[self.kind](name)
        except MessageNotFoundError as error:
            raise MessageNotFoundError(f"{error}{self._hint(store, name)}") from None

    def _hint(self, store: MessageStore, name: str) -> str:
        """The commands that show a type of another kind, on lines of their own."""
        hint = ""
        for kind, word in KINDS.items():
            for other in _catalog.all_types(store, kind) if kind != self.kind else ():
                if other == name or other.endswith(f"/{name}"):
                    hint += f"\n{other} is a type of {word}: aioros1 {kind} show {other}"
        return hint

    # -- many types -------------------------------------------------------------------

    def list_(self, pattern: str | None = None, /, *, path: Paths = ()) -> None:
        """List all types.

        Parameters
        ----------
        pattern
            Only the types with this text in their names. With wildcards, as a shell has
            them, it must fit the whole name. Lower and upper case are the same.
        """
        names = _catalog.all_types(_store(path), self.kind)
        if pattern is not None:
            names = _catalog.matching(pattern, names)
            if not names:
                raise MessageNotFoundError(f"no type of {KINDS[self.kind]} fits {pattern!r}")
        _print_names(names)

    def package(
        self, package: str, /, *, single_line: SingleLine = False, path: Paths = ()
    ) -> None:
        """List the types of a package."""
        from aioros1.idl import types_of

        store = _store(path)
        names = types_of(store, package, self.kind)
        if not names and package not in (known := store.packages()):
            raise MessageNotFoundError(
                f"no package {package!r} with definitions; "
                f"searched: {', '.join(store.places())}"
                f"{_did_you_mean(get_close_matches(package, known))}"
            )
        _print_names(names, single_line)

    def packages(self, *, single_line: SingleLine = False, path: Paths = ()) -> None:
        """List the packages that have such types."""
        _print_names(_catalog.packages(_store(path), self.kind), single_line)


class _ActionCommands(_Commands):
    """An action is no more than its messages, which is what a connection knows of it."""

    def md5(self, type: TypeName = None, /, *, path: Paths = ()) -> None:
        """Show the MD5 sums of the seven messages of an action.

        The first message contains all others, and so its sum stands for the whole.
        """
        from aioros1.idl import spec_of

        def text(cls: Any) -> str:
            messages = [getattr(cls, name) for name in spec_of(cls).messages]
            return "\n".join(f"[{message._type}]: {message._md5sum}" for message in messages)

        self._print(_store(path), type, text)

    def full_text(self, type: TypeName = None, /, *, path: Paths = ()) -> None:
        """Show the definition of the message that contains all others of an action."""
        self._print(_store(path), type, lambda cls: cls.Action._full_text)


def _store(paths: Iterable[Any]) -> MessageStore:
    # Imported when a command runs: the help needs no definitions.
    from aioros1.idl import standard_store

    # The last part of a path can be the name of a package, which "." does not have.
    return standard_store(map(abspath, paths))


def _from_stdin() -> str:
    """The name that another program has written: ``rostopic type /a | aioros1 msg show``."""
    if sys.stdin is not None and not sys.stdin.isatty():
        for line in sys.stdin:
            if line.strip():
                return line.strip()
    print("aioros1: no type given, neither as an argument nor on standard input", file=sys.stderr)
    raise SystemExit(2)


def _did_you_mean(names: list[str]) -> str:
    return f"; did you mean {' or '.join(names)}?" if names else ""


def _print_names(names: Iterable[str], single_line: bool = False) -> None:
    text = (" " if single_line else "\n").join(names)
    if text:
        print(text)
