"""``aioros1.msg``, ``aioros1.srv``, ``aioros1.action``: modules without files.

There is a module for each package that has definitions, ``aioros1.msg.std_msgs`` for
one, and its attributes are classes, which are loaded when they are first asked for.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from aioros1.errors import MessageNotFoundError
from aioros1.idl.paths import Kind
from aioros1.idl.store import default_store

__all__ = ["DefinitionFinder", "install_finder", "package_module", "package_names"]

_PREFIXES: dict[str, Kind] = {
    "aioros1.msg.": "msg",
    "aioros1.srv.": "srv",
    "aioros1.action.": "action",
}


class DefinitionFinder(MetaPathFinder, Loader):
    """Finds the modules below the three, and nothing else."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        for prefix, kind in _PREFIXES.items():
            if fullname.startswith(prefix):
                package = fullname.removeprefix(prefix)
                if package.isidentifier() and default_store().types(package, kind):
                    return ModuleSpec(fullname, self, origin=f"definitions of {package}")
        return None

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        parent, _, package = module.__name__.rpartition(".")
        fill_module(module, package, _PREFIXES[f"{parent}."])


def fill_module(module: ModuleType, package: str, kind: Kind) -> None:
    """Give a module its two hooks."""
    module.__doc__ = f"The {kind} types of {package}, loaded when they are used."
    module.__dict__["__getattr__"] = _getter(module, package, kind)
    module.__dict__["__dir__"] = lambda: _names(package, kind)


def _names(package: str, kind: Kind) -> list[str]:
    return [name.partition("/")[2] for name in default_store().types(package, kind)]


def _load(package: str, name: str, kind: Kind) -> Any:
    store = default_store()
    if kind == "msg":
        return store.load_msg(f"{package}/{name}")
    if kind == "action":
        return store.load_action(f"{package}/{name}")
    if store.types(package, "srv").count(f"{package}/{name}"):
        return store.load_srv(f"{package}/{name}")
    for suffix in ("Request", "Response"):
        base = name.removesuffix(suffix)
        if base != name:
            return getattr(store.load_srv(f"{package}/{base}"), suffix)
    return store.load_srv(f"{package}/{name}")


def _getter(module: ModuleType, package: str, kind: Kind) -> Callable[[str], Any]:
    def get(name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")
        try:
            found = _load(package, name, kind)
        except MessageNotFoundError as exc:
            known = ", ".join(_names(package, kind))
            raise AttributeError(
                f"{package} has no {kind} type {name!r} ({exc}); it has: {known}"
            ) from exc
        module.__dict__[name] = found
        return found

    return get


def install_finder() -> None:
    """Make the modules importable; the second time does nothing."""
    if not any(isinstance(finder, DefinitionFinder) for finder in sys.meta_path):
        sys.meta_path.append(DefinitionFinder())


def package_module(parent: str, name: str) -> ModuleType:
    """The module of a package, for attribute access without an import statement."""
    fullname = f"{parent}.{name}"
    if name.startswith("_"):
        raise AttributeError(f"module {parent!r} has no attribute {name!r}")
    try:
        return import_module(fullname)
    except ModuleNotFoundError as exc:
        if exc.name != fullname:
            raise
        raise AttributeError(
            f"module {parent!r} has no attribute {name!r}: no definitions of such a package"
        ) from None


def package_names(kind: Kind) -> list[str]:
    """The packages that have definitions of a kind."""
    store = default_store()
    return [name for name in store.packages() if store.types(name, kind)]
