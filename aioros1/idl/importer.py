"""Makes ``from std_msgs.msg import String``, as in code for rospy, work without ROS."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from aioros1._public import public
from aioros1.idl.modules import DefinitionFinder, DefinitionLoader, names_of
from aioros1.idl.paths import Kind
from aioros1.idl.store import MessageStore, default_store

__all__ = ["install_importer", "uninstall_importer"]

_KINDS: dict[str, Kind] = {"msg": "msg", "srv": "srv"}


@public
def install_importer(*, store: MessageStore | None = None, shadow: bool = False) -> None:
    """Make message packages importable by ROS's own names, ``std_msgs.msg`` for one.

    The classes are those of ``store``; by default they are the same as in
    :mod:`aioros1.msg` and :mod:`aioros1.srv`. Modules that exist as files, in an installed
    ROS or in a package of your own, are left alone. With ``shadow`` their ``msg`` and
    ``srv`` modules are hidden, unless they have been imported already.

    Nothing is searched before something is imported. If you call this again, the new
    arguments replace the old ones.
    """
    store = store if store is not None else default_store()
    for finder in sys.meta_path:
        if isinstance(finder, _TypesFinder) and (finder.store, finder.shadow) == (store, shadow):
            return
    uninstall_importer()
    # A directory with definitions looks like a package without code, and must not win
    # against us; packages with code must win, and with them what belongs to them.
    sys.meta_path[:] = [_TypesFinder(store, shadow), *sys.meta_path, _PackageFinder(store)]


@public
def uninstall_importer() -> None:
    """Undo :func:`install_importer`, and forget the modules that were imported by it."""
    sys.meta_path[:] = [
        finder for finder in sys.meta_path if not isinstance(finder, (_TypesFinder, _PackageFinder))
    ]
    for name, module in tuple(sys.modules.items()):
        spec = vars(module).get("__spec__") if isinstance(module, ModuleType) else None
        if spec is not None and isinstance(spec.loader, (_TypesLoader, _PackageLoader)):
            del sys.modules[name]
            parent, _, attribute = name.rpartition(".")
            vars(sys.modules.get(parent, module)).pop(attribute, None)


class _TypesLoader(DefinitionLoader):
    """Makes ``pkg.msg`` and ``pkg.srv``."""


class _TypeLoader(_TypesLoader):
    """Makes ``pkg.msg._Type``, the module that genpy has for each type."""

    def __init__(self, store: MessageStore, package: str, kind: Kind, name: str) -> None:
        super().__init__(store, package, kind)
        self._names = (
            [name] if kind == "msg" else [f"{name}{s}" for s in ("", "Request", "Response")]
        )

    def names(self) -> list[str]:
        return self._names

    def _load(self, name: str) -> Any:
        if name not in self._names:
            raise AttributeError(
                f"{self.package}.{self.kind}._{self._names[0]} has no {name!r}; "
                f"it has: {', '.join(self._names)}"
            )
        return super()._load(name)


class _TypesFinder(DefinitionFinder):
    def __init__(self, store: MessageStore, shadow: bool) -> None:
        self.store = store
        self.shadow = shadow

    def loader(self, fullname: str, path: Sequence[str] | None) -> DefinitionLoader | None:
        package, _, rest = fullname.partition(".")
        module, _, type_module = rest.partition(".")
        kind = _KINDS.get(module)
        if kind is None or not package.isidentifier():
            return None
        if not self.shadow and _has_code(fullname, path):
            return None
        names = names_of(self.store, package, kind)
        if names and not type_module:
            return _TypesLoader(self.store, package, kind)
        if type_module[:1] == "_" and type_module[1:] in names:
            return _TypeLoader(self.store, package, kind, type_module[1:])
        return None


def _has_code(fullname: str, path: Sequence[str] | None) -> bool:
    """Whether another finder has a module of that name that is more than a directory."""
    for finder in sys.meta_path:
        if not isinstance(finder, (DefinitionFinder, _PackageFinder)):
            spec = finder.find_spec(fullname, path)
            if spec is not None:
                return spec.loader is not None
    return False


class _PackageLoader(Loader):
    """Makes ``pkg``, which has only ``msg`` and ``srv``."""

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        name = module.__name__
        module.__doc__ = f"The message definitions of {name}."

        def get(attribute: str) -> Any:
            if attribute in _KINDS:
                try:
                    return import_module(f"{name}.{attribute}")
                except ModuleNotFoundError:
                    pass
            raise AttributeError(
                f"module {name!r} has no attribute {attribute!r}: there are only "
                f"message definitions of {name}"
            )

        module.__dict__["__getattr__"] = get


class _PackageFinder(MetaPathFinder):
    def __init__(self, store: MessageStore) -> None:
        self._store = store

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname.isidentifier() and any(
            names_of(self._store, fullname, k) for k in _KINDS.values()
        ):
            origin = f"definitions of {fullname}"
            return ModuleSpec(fullname, _PackageLoader(), origin=origin, is_package=True)
        return None
