"""``aioros1.msg``, ``aioros1.srv``, ``aioros1.action``: modules without files.

Each package that has definitions has a module, such as ``aioros1.msg.std_msgs``. The
attributes of the module are classes, which are loaded when they are first used.
"""

from __future__ import annotations

import sys
from abc import abstractmethod
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from threading import Lock
from types import ModuleType
from typing import Any

from aioros1._public import public
from aioros1.errors import MessageNotFoundError
from aioros1.idl.building import ACTION_SUFFIXES
from aioros1.idl.paths import KINDS, Kind
from aioros1.idl.store import MessageStore, default_store

__all__ = [
    "DefinitionFinder",
    "DefinitionLoader",
    "install_finder",
    "names_of",
    "package_module",
    "package_names",
    "types_of",
]


@public("aioros1.idl")
def types_of(store: MessageStore, package: str, kind: Kind) -> list[str]:
    """All types of a package, sorted; of messages also those of its actions."""
    types = set(store.types(package, kind))
    if kind == "msg":
        actions = store.types(package, "action")
        types |= {f"{action}{suffix}" for action in actions for suffix in ACTION_SUFFIXES}
    return sorted(types)


def names_of(store: MessageStore, package: str, kind: Kind) -> list[str]:
    """The names in the module of a package, sorted: its types, and the messages of services."""
    names = [name.partition("/")[2] for name in types_of(store, package, kind)]
    if kind == "srv":
        names += [f"{name}{suffix}" for name in names for suffix in ("Request", "Response")]
    return sorted(names)


class DefinitionLoader(Loader):
    """Makes the module of a package for one kind of types."""

    def __init__(self, store: MessageStore, package: str, kind: Kind) -> None:
        self.store = store
        self.package = package
        self.kind: Kind = kind

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        module.__doc__ = f"The {self.kind} types of {self.package}, loaded when they are used."
        for name in [name for name in vars(module) if not name.startswith("_")]:
            delattr(module, name)  # it is being reloaded
        module.__dict__["__getattr__"] = self._getter(module)
        module.__dict__["__dir__"] = self.names

    def names(self) -> list[str]:
        """The names in the module."""
        return names_of(self.store, self.package, self.kind)

    def load(self, name: str) -> Any:
        """The class of that name. The text of :class:`AttributeError` says where was searched."""
        try:
            return self._load(name)
        except MessageNotFoundError as exc:
            known = ", ".join(self.names())
            raise AttributeError(
                f"{self.package} has no {self.kind} type {name!r} ({exc}); it has: {known}"
            ) from exc

    def _load(self, name: str) -> Any:
        store, type_ = self.store, f"{self.package}/{name}"
        if self.kind == "msg":
            return store.load_msg(type_)
        if self.kind == "action":
            return store.load_action(type_)
        if type_ not in store.types(self.package, "srv"):
            for suffix in ("Request", "Response"):
                base = type_.removesuffix(suffix)
                if base != type_:
                    return getattr(store.load_srv(base), suffix)
        return store.load_srv(type_)

    def _getter(self, module: ModuleType) -> Callable[[str], Any]:
        def get(name: str) -> Any:
            if name == "__all__":
                return self.names()
            if name.startswith("_"):
                raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")
            found = module.__dict__[name] = self.load(name)
            return found

        return get


class DefinitionFinder(MetaPathFinder):
    """Finds the modules of types that are named in one way."""

    @abstractmethod
    def loader(self, fullname: str, path: Sequence[str] | None) -> DefinitionLoader | None:
        """The loader of the module of that name, or None if there is no such module."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        loader = self.loader(fullname, path)
        if loader is not None:
            # It is a package, as in rospy. Also, if an import statement does not find a name
            # in a package, it asks for a module of that name, in the lines below.
            origin = f"definitions of {loader.package}"
            return ModuleSpec(fullname, loader, origin=origin, is_package=True)
        parent, _, name = fullname.rpartition(".")
        spec = getattr(sys.modules.get(parent), "__spec__", None)
        if spec is not None and isinstance(spec.loader, DefinitionLoader) and name[0] != "_":
            try:
                spec.loader.load(name)
            except AttributeError as exc:
                # The import statement would only say that the name cannot be imported.
                raise ImportError(str(exc), name=parent) from exc
        return None


class _OurFinder(DefinitionFinder):
    """``aioros1.msg.pkg``, ``aioros1.srv.pkg``, ``aioros1.action.pkg``."""

    _KINDS: dict[str, Kind] = {  # noqa: RUF012 - a constant
        "aioros1.msg": "msg",
        "aioros1.srv": "srv",
        "aioros1.action": "action",
    }

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        spec = super().find_spec(fullname, path, target)
        parent, _, package = fullname.rpartition(".")
        kind = self._KINDS.get(parent)
        if spec is None and kind is not None and package.isidentifier() and package[0] != "_":
            # Of a module by its own name, `from aioros1.msg import name` would say nothing.
            raise ModuleNotFoundError(
                f"No module named {fullname!r}: {_no_package(package, kind)}", name=parent
            )
        return spec

    def loader(self, fullname: str, path: Sequence[str] | None) -> DefinitionLoader | None:
        parent, _, package = fullname.rpartition(".")
        kind = self._KINDS.get(parent)
        if kind is None or not package.isidentifier():
            return None
        store = default_store()
        return DefinitionLoader(store, package, kind) if names_of(store, package, kind) else None


def _no_package(package: str, kind: Kind) -> str:
    """Why there is no module for a package, and which one may have been meant."""
    store = default_store()
    found = [
        f"aioros1.{other}.{package}" for other in KINDS if names_of(store, package, other)
    ] or [
        f"from aioros1.{kind}.{type_.replace('/', ' import ')}"
        for type_ in store.suggest(package, kind)
    ]
    if not found:
        found = [
            f"aioros1.{kind}.{name}"
            for name in get_close_matches(package, store._package_names(), 3, 0.75)
            if names_of(store, name, kind)
        ]
    hint = f"; did you mean {' or '.join(found)}?" if found else ""
    return f"no package {package!r} has {_WORDS[kind]} definitions{hint}"


_WORDS: dict[Kind, str] = {"msg": "message", "srv": "service", "action": "action"}

_installing = Lock()  # two threads may import aioros1.msg and aioros1.srv


def install_finder() -> None:
    """Make the modules importable; the second time does nothing."""
    with _installing:
        if not any(isinstance(finder, _OurFinder) for finder in sys.meta_path):
            # In front, because directories with stubs look like packages without code.
            sys.meta_path.insert(0, _OurFinder())


def package_module(parent: str, name: str) -> ModuleType:
    """The module of a package; ``aioros1.msg.std_msgs`` works without importing that."""
    fullname = f"{parent}.{name}"
    if name.startswith("_"):
        raise AttributeError(f"module {parent!r} has no attribute {name!r}")
    try:
        return import_module(fullname)
    except ModuleNotFoundError as exc:
        if exc.name not in (fullname, parent):
            raise
        why = str(exc).partition(": ")[2]
        raise AttributeError(f"module {parent!r} has no attribute {name!r}: {why}") from None


def package_names(kind: Kind) -> list[str]:
    """The packages that have a module of a kind."""
    store = default_store()
    return [name for name in store.packages() if names_of(store, name, kind)]
