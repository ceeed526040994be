"""Writes stubs: what type checkers and editors know of classes that are made at run time.

``python -m aioros1.idl.stubs`` writes the stubs of the definitions that come with the
library; ``aioros1 stubs`` writes those of other packages.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from keyword import iskeyword
from pathlib import Path, PurePosixPath
from typing import Literal, TypeAlias

from aioros1._public import public
from aioros1.errors import MessageError, MessageNotFoundError
from aioros1.idl.building import ACTION_SUFFIXES
from aioros1.idl.builtin_types import BUILTINS
from aioros1.idl.message import Message
from aioros1.idl.modules import names_of
from aioros1.idl.paths import KINDS, Kind, bundle
from aioros1.idl.spec import Constant, ConstantValue, Field
from aioros1.idl.store import MessageStore
from aioros1.idl.structure import Structure

__all__ = [
    "HEADER",
    "Layout",
    "Stubs",
    "bundled_store",
    "bundled_stubs",
    "write_package_stubs",
    "write_stubs",
]

HEADER = "# Made by aioros1 from message definitions. Change those, and have it made anew.\n"
_WIDTH = 100

Layout: TypeAlias = Literal["aioros1", "importer"]
"""How the modules of a package are imported, and so where their stubs are.

``aioros1``: as ``aioros1.msg.pkg``, in the library itself. ``importer``: as ``pkg.msg``.
"""

# By the kind of an element: its type, what is accepted for it, the attribute that holds an
# array of it, and what is accepted for that.
_TYPES: dict[str, tuple[str, str, str, str]] = {
    "int": ("_b.int", "_t.Int", "_t.IntArray", "_t.Ints"),
    "float": ("_b.float", "_t.Float", "_t.FloatArray", "_t.Floats"),
    "bool": ("_b.bool", "_t.Bool", "_t.BoolList", "_t.Bools"),
    "string": ("_b.str", "_t.Text", "_t.TextList", "_t.Texts"),
}


def _of_class(name: str) -> tuple[str, str, str, str]:
    return name, name, f"_t.ItemList[{name}]", f"_t.Items[{name}]"


@cache
def bundled_store() -> MessageStore:
    """A store of the definitions that come with the library, and of no others."""
    return MessageStore([bundle()], parent=None)


class Stubs:
    """Writes the stubs of packages of a store.

    All names in a stub that are not from the definition begin with an underscore: a field
    may be called ``list``, ``Time`` or ``type``, but none begins with an underscore.
    """

    def __init__(self, store: MessageStore, layout: Layout) -> None:
        self._store = store
        self._layout: Layout = layout
        self.referred: set[str] = set()
        """The packages outside of the bundle whose messages the stubs so far refer to."""

    def files(self, package: str) -> dict[PurePosixPath, str]:
        """The stubs of a package, by path. There are none if it has no definitions.

        Raises :class:`MessageError` for a definition that cannot be read.
        """
        writers: dict[Kind, Callable[[str, _Module], None]] = {
            "msg": self._add_messages,
            "srv": self._add_services,
            "action": self._add_actions,
        }
        if self._layout == "importer":
            del writers["action"]  # rospy has no module for these
        files = {}
        for kind, write in writers.items():
            if names_of(self._store, package, kind):
                module = _Module(self._home)
                write(package, module)
                files[self._path(package, kind)] = module.text()
        if files and self._layout == "importer":
            files[PurePosixPath(package, "__init__.pyi")] = HEADER
        return files

    def _name(self, package: str, kind: Kind) -> str:
        return f"{package}.{kind}" if self._layout == "importer" else f"aioros1.{kind}.{package}"

    def _path(self, package: str, kind: Kind) -> PurePosixPath:
        # A directory even for one file: pyright warns of a stub that has no code beside it,
        # but accepts a directory.
        return PurePosixPath(*self._name(package, kind).split("."), "__init__.pyi")

    def _home(self, cls: type[Structure]) -> str:
        """The module in which checkers find the class of a message."""
        package = cls._type.partition("/")[0]
        if _is_bundled(cls._type, cls._md5sum, "msg"):
            return f"aioros1.msg.{package}"
        self.referred.add(package)
        return self._name(package, "msg")

    def _is_alias(self, type: str, md5sum: str, kind: Kind) -> bool:
        """Whether a class is one of the bundle under another name."""
        return self._layout == "importer" and _is_bundled(type, md5sum, kind)

    def _add_messages(self, package: str, module: _Module) -> None:
        for name in names_of(self._store, package, "msg"):
            cls = self._store.load_msg(f"{package}/{name}")
            if self._is_alias(cls._type, cls._md5sum, "msg"):
                module.take(f"aioros1.msg.{package}", name)
            else:
                module.add_message(cls)

    def _add_services(self, package: str, module: _Module) -> None:
        for type_ in self._store.types(package, "srv"):
            name = type_.partition("/")[2]
            request, response = f"{name}Request", f"{name}Response"
            service = self._store.load_srv(type_)
            if self._is_alias(type_, service._md5sum, "srv"):
                module.take(f"aioros1.srv.{package}", name, request, response)
                continue
            module.add_message(service.Request)
            module.add_message(service.Response)
            module.add_class(
                f"{name}(_t.Service[{request}, {response}])",
                [
                    f"Request: _ty.TypeAlias = {request}",
                    f"Response: _ty.TypeAlias = {response}",
                ],
            )

    def _add_actions(self, package: str, module: _Module) -> None:
        for type_ in self._store.types(package, "action"):
            name = type_.partition("/")[2]
            action = self._store.load_action(type_)
            messages = {s: module.reference(getattr(action, s)) for s in ACTION_SUFFIXES}
            written = [messages[suffix] for suffix in ("Goal", "Result", "Feedback")]
            module.add_class(
                _listing(f"{name}(_t.Action[", written, "])"),
                [f"{suffix}: _ty.TypeAlias = {message}" for suffix, message in messages.items()],
            )


@cache
def _is_bundled(type: str, md5sum: str, kind: Kind) -> bool:
    """Whether the library comes with exactly this definition."""
    store = bundled_store()
    try:
        found = store.load_srv(type) if kind == "srv" else store.load_msg(type)
    except MessageError:
        return False
    return found._md5sum == md5sum


class _Module:
    """A stub that is being written."""

    def __init__(self, home: Callable[[type[Structure]], str]) -> None:
        self._home = home
        self._imports: set[str] = set()
        self._taken: list[str] = []
        self._classes: list[str] = []

    def text(self) -> str:
        classes = "\n".join(self._classes)
        used = {"_b": "builtins", "_ty": "typing"}
        standard = [f"import {name} as {a}" for a, name in used.items() if f"{a}." in classes]
        ours = [f"import {name} as {_alias(name)}" for name in sorted(self._imports)]
        if "_t." in classes:
            ours.insert(0, "import aioros1.idl._typing as _t")
        blocks = ["\n".join(standard), "\n".join([*ours, *self._taken]), classes]
        return HEADER + "\n\n".join(filter(None, blocks)).rstrip("\n") + "\n"

    def reference(self, cls: type[Structure]) -> str:
        """The expression for the class of a message, in this stub or another."""
        module = self._home(cls)
        self._imports.add(module)
        return f"{_alias(module)}.{cls.__name__}"

    def take(self, module: str, *names: str) -> None:
        """Import names from another module into this one."""
        self._taken += [f"from {module} import {name} as {name}" for name in names]

    def add_class(self, head: str, body: Sequence[str]) -> None:
        lines = "\n".join(body).split("\n")
        self._classes.append(f"class {head}:\n" + "".join(f"    {line}\n" for line in lines))

    def add_message(self, cls: type[Message]) -> None:
        attributes, parameters = [], []
        for field in cls._fields:
            held, accepted = self._types(cls, field)
            if not iskeyword(field.name):
                attributes.append(f"{field.name}: {held}{_override(field.name)}")
            parameters.append((field.name, accepted))
        constants = [c for c in cls._constants if c.name in vars(cls) and not iskeyword(c.name)]
        self.add_class(
            f"{cls.__name__}(_t.Message)",
            [*map(_constant, constants), *attributes, *_constructor(parameters)],
        )

    def _types(self, cls: type[Message], field: Field) -> tuple[str, str]:
        """The type of the attribute of a field, and of what is accepted for it."""
        builtin = BUILTINS.get(field.base_type)
        if builtin is None:
            types = _of_class(self.reference(cls._nested[field.base_type]))
        elif builtin.kind in _TYPES:
            types = _TYPES[builtin.kind]
        else:
            types = _of_class(f"_t.{builtin.kind.title()}")
        if not field.is_array:
            return types[:2]
        if builtin is not None and builtin.octets:
            return "_t.OctetArray", "_t.Octets"
        return types[2:]


def _alias(module: str) -> str:
    return "_" + module.removeprefix("aioros1.").replace(".", "_")


def _constant(constant: Constant) -> str:
    value = _literal(constant.value)
    # There are no literal types of floats, even though mypy infers them.
    is_exact = value and not isinstance(constant.value, float)
    of = "" if is_exact else f"[_b.{type(constant.value).__name__}]"
    return f"{constant.name}: _ty.Final{of}{value and f' = {value}'}{_override(constant.name)}"


def _literal(value: ConstantValue) -> str:
    """The value as Python code; empty where that is impossible or hard to read."""
    if isinstance(value, str):
        is_plain = value.isprintable() and not {'"', "\\"} & set(value)
        return f'"{value}"' if is_plain and len(value) < _WIDTH // 2 else ""
    return repr(value) if math.isfinite(value) else ""


def _override(name: str) -> str:
    """The comment for checkers where a field or constant hides a method of messages."""
    return "  # type: ignore[assignment]  # pyright: ignore" if name in vars(Message) else ""


def _constructor(parameters: Sequence[tuple[str, str]]) -> list[str]:
    """``__init__`` with all values by position, or any of them by name."""
    this = "_self" if "self" in dict(parameters) else "self"
    if not parameters:
        return [f"def __init__({this}) -> None: ..."]
    named = [this, "*", *(f"{n}: {t} = ..." for n, t in parameters if not iskeyword(n))]
    if any(iskeyword(name) for name, _ in parameters):
        # No parameter can have such a name, but `**fields` can hold a value for it.
        named = [*(named if len(named) > 2 else [this]), "**_others: _ty.Any"]
    placed = [this, *(f"{'_' * iskeyword(n)}{n}: {t}" for n, t in parameters), "/"]
    return [
        "@_ty.overload",
        _listing("def __init__(", named, ") -> None: ..."),
        "@_ty.overload",
        _listing("def __init__(", placed, ") -> None: ..."),
    ]


def _listing(head: str, items: Sequence[str], tail: str) -> str:
    """All items in one line, or one line for each."""
    line = f"{head}{', '.join(items)}{tail}"
    if len(line) <= _WIDTH - 4:
        return line
    return "\n".join([head, *(f"    {item}," for item in items), tail])


# -- files ----------------------------------------------------------------------------


def bundled_stubs() -> dict[PurePosixPath, str]:
    """The stubs that come with the library, by paths relative to the parent of ``aioros1``."""
    stubs = Stubs(bundled_store(), "aioros1")
    files: dict[PurePosixPath, str] = {}
    for package in bundled_store().packages():
        files |= stubs.files(package)
    return files


def write_stubs(files: Mapping[PurePosixPath, str], directory: Path) -> list[Path]:
    """Write stubs below a directory; gives the paths of those that are new or changed.

    A package that has an ``__init__.py`` gets no stub for that. Raises
    :class:`FileExistsError`, before anything is written, if a file is in the way that was
    not made by aioros1.
    """
    texts = {
        directory / path: text
        for path, text in files.items()
        if text != HEADER or not (directory / path).with_suffix(".py").exists()
    }
    changed = []
    for path, text in texts.items():
        known = path.read_text(encoding="utf-8") if path.exists() else None
        if known is not None and known != text and not known.startswith(HEADER):
            raise FileExistsError(f"{path} was not made by aioros1, and is not replaced")
        if known != text:
            changed.append(path)
    for path in changed:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(texts[path], encoding="utf-8")
    return changed


@public("aioros1.idl")
def write_package_stubs(
    store: MessageStore, packages: Iterable[str], directory: Path
) -> tuple[list[Path], list[str]]:
    """Write what type checkers have to know of packages that are imported as in rospy.

    Returns the files that are new or changed, and the names of further packages, sorted,
    that the stubs refer to and that come neither with the library nor among ``packages``.

    Raises :class:`~aioros1.MessageNotFoundError` for a package without definitions,
    :class:`~aioros1.MessageError` for a definition that cannot be read, and
    :class:`FileExistsError`, before anything is written, if a file is in the way that
    was not made by aioros1.
    """
    writer = Stubs(store, "importer")
    files: dict[PurePosixPath, str] = {}
    names = dict.fromkeys(packages)
    for name in names:
        found = writer.files(name)
        if not found:
            places = ", ".join(store.places())
            raise MessageNotFoundError(f"no definitions of a package {name!r}; searched: {places}")
        files |= found
    return write_stubs(files, directory), sorted(writer.referred.difference(names))


def _main() -> None:
    root = Path(__file__).resolve().parents[2]
    files = bundled_stubs()
    for kind in KINDS:
        for path in root.glob(f"aioros1/{kind}/*/__init__.pyi"):
            if PurePosixPath(path.relative_to(root)) not in files:
                path.unlink()
                path.parent.rmdir()
    write_stubs(files, root)


if __name__ == "__main__":
    _main()
