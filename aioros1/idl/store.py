"""The store: types by name, made from definitions wherever these are found."""

# ruff: noqa: A001 - `type` is what ROS calls the name of a type, and part of the contract

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from threading import RLock
from typing import Any, Final, TypeAlias

from aioros1.errors import MessageNotFoundError, MessageSpecError
from aioros1.idl import digest
from aioros1.idl.factory import make_message_class, specs_of
from aioros1.idl.message import AnyMessage
from aioros1.idl.parser import action_texts, parse_action, parse_message, parse_service, split_type
from aioros1.idl.paths import KINDS, Kind, SearchPath
from aioros1.idl.service import (
    AnyAction,
    AnyService,
    make_action_class,
    make_service_class,
)
from aioros1.idl.spec import MessageSpec, ServiceSpec

__all__ = [
    "ACTION_SUFFIXES",
    "MessageStore",
    "default_store",
    "load_action",
    "load_msg",
    "load_srv",
    "standard_store",
]

_DEFAULT: Final = object()
_MAX_DEPTH = 100
_MAX_DEFINITIONS = 1000

ACTION_SUFFIXES: Final = (
    "ActionGoal",
    "ActionResult",
    "ActionFeedback",
    "Action",
    "Goal",
    "Result",
    "Feedback",
)

# By other names, as `type` is a parameter in much of this module.
_MessageClass: TypeAlias = type[AnyMessage]
_ServiceClass: TypeAlias = type[AnyService]

_Chain: TypeAlias = tuple[str, ...]
_Source: TypeAlias = tuple[str, str]  # text, and the path for errors


class MessageStore:
    """Loads types by name, each once.

    ``paths`` are searched first: directories with packages at any depth, single packages,
    or ``msg`` directories. What is found neither there nor among the texts added is left
    to ``parent``, by default :func:`default_store`; None is for a store that knows
    nothing but its own. Types of the parent that contain a type this store has a
    definition of are made anew, with that definition.
    """

    def __init__(
        self,
        paths: Iterable[str | os.PathLike[str]] = (),
        *,
        parent: MessageStore | object | None = _DEFAULT,
    ) -> None:
        if isinstance(paths, (str, os.PathLike)):
            paths = (paths,)
        self._search = SearchPath(paths)
        self._parent = parent
        self._texts: dict[tuple[Kind, str], str] = {}
        self._messages: dict[str, _MessageClass] = {}
        self._services: dict[str, _ServiceClass] = {}
        self._actions: dict[str, type[AnyAction]] = {}
        self._definitions: dict[tuple[str, str], _MessageClass] = {}
        self._lock = RLock()

    @property
    def parent(self) -> MessageStore | None:
        """The store that is asked for what this one does not have."""
        if self._parent is _DEFAULT:
            self._parent = default_store()
        assert self._parent is None or isinstance(self._parent, MessageStore)
        return self._parent

    # -- loading ----------------------------------------------------------------------

    def load_msg(self, type: str) -> _MessageClass:
        """The class of a message type, ``"pkg/Type"``.

        Raises :class:`MessageNotFoundError` when there is no definition of it or of a
        type inside it, :class:`MessageSpecError` when one cannot be read, and
        :class:`InvalidNameError`.
        """
        found = self._messages.get(type)
        if found is not None:
            return found
        with self._lock:
            return self._load(type, ())

    def load_srv(self, type: str) -> _ServiceClass:
        """The class of a service type; errors as for :meth:`load_msg`."""
        found = self._services.get(type)
        if found is not None:
            return found
        with self._lock:
            service = self._load_srv(type)
            self._services[type] = service
            return service

    def load_action(self, type: str) -> type[AnyAction]:
        """The class of an action type; errors as for :meth:`load_msg`.

        The seven messages can be loaded by their own names, too.
        """
        found = self._actions.get(type)
        if found is not None:
            return found
        with self._lock:
            source = self._source("action", type)
            if source is None:
                if self.parent is None:
                    raise self._not_found(type, ("action",))
                with self._searched_too():
                    return self.parent.load_action(type)
            spec = parse_action(type, source[0], path=source[1])
            messages = {suffix: self._load(f"{type}{suffix}", (type,)) for suffix in spec.messages}
            made = make_action_class(spec, messages, module=_module("action", type))
            self._actions[type] = made
            return made

    # -- adding -----------------------------------------------------------------------

    def add_text(self, type: str, text: str, *, kind: Kind | None = None) -> None:
        """Define a type by the text of a file, in place of any file there is.

        Without ``kind`` the lines of three dashes tell: none for a message, one for a
        service, two for an action. Types that the definition needs may be added later.
        Classes already made from a former definition stay what they are. Raises
        :class:`MessageSpecError` and :class:`InvalidNameError`.
        """
        if kind is None:
            kind = KINDS[min(sum(line.startswith("---") for line in text.split("\n")), 2)]
        if kind == "msg":
            parse_message(type, text)
        elif kind == "srv":
            parse_service(type, text)
        else:
            parse_action(type, text)
        with self._lock:
            self._texts[kind, type] = text
            stale = {type} | {f"{type}{suffix}" for suffix in ACTION_SUFFIXES}
            self._messages = {
                name: cls
                for name, cls in self._messages.items()
                if stale.isdisjoint(specs_of([cls]))
            }
            self._services.clear()
            self._actions.clear()
            self._definitions.clear()

    def add_definition(self, type: str, full_text: str) -> _MessageClass:
        """The class for a definition with all it needs, as in a connection header or a bag.

        All types inside are read from this text, never from anywhere else. When the store
        knows the type by the same MD5 sum, its class is returned. Otherwise the new class
        stands beside those of the store: loading by name finds it only when there is
        nothing else by that name.
        """
        with self._lock:
            # Every connection to a topic brings the same text again.
            found = self._definitions.get((type, full_text))
            if found is None:
                found = self._define(type, full_text)
                _remember(self._definitions, (type, full_text), found)
            return found

    def _define(self, type: str, full_text: str) -> _MessageClass:
        texts = digest.split_full_text(type, full_text)
        made: dict[str, _MessageClass] = {}

        def load(name: str, chain: _Chain) -> _MessageClass:
            if name not in made:
                if name not in texts:
                    raise MessageNotFoundError(
                        f"the definition of {type} lacks {name}{_needed_by(chain)}"
                    )
                spec = parse_message(name, texts[name])
                made[name] = _build(spec, load, chain)
            return made[name]

        cls = load(type, ())
        for (name, _), known in self._definitions.items():
            if name == type and known._md5sum == cls._md5sum:
                return known
        try:
            own = self._load(type, ())
        except (MessageNotFoundError, MessageSpecError):
            return cls
        return own if own._md5sum == cls._md5sum else cls

    # -- looking ----------------------------------------------------------------------

    def find(self, type: str, kind: Kind | None = None) -> Path:
        """The file that defines a type; :class:`MessageNotFoundError` when there is none."""
        package, name = split_type(type)
        for wanted in (kind,) if kind else KINDS:
            path = self._search.find(package, name, wanted)
            if path is not None:
                return path
        if self.parent is not None:
            with self._searched_too():
                return self.parent.find(type, kind)
        raise self._not_found(type, (kind,) if kind else KINDS)

    def packages(self) -> list[str]:
        """The names of all packages that have definitions, sorted."""
        names = self._search.packages() | {split_type(type)[0] for _, type in self._texts}
        return sorted(names.union(self.parent.packages() if self.parent else ()))

    def types(self, package: str, kind: Kind = "msg") -> list[str]:
        """All types of a package, as ``pkg/Type``, sorted."""
        names = {f"{package}/{name}" for name in self._search.types(package, kind)}
        names |= {
            type for other, type in self._texts if other == kind and split_type(type)[0] == package
        }
        return sorted(names.union(self.parent.types(package, kind) if self.parent else ()))

    def places(self) -> list[str]:
        """The directories that are searched, in this order."""
        inherited = self.parent.places() if self.parent else []
        return list(dict.fromkeys([*self._search.places(), *inherited]))

    # -- what users hand over in place of a name ---------------------------------------

    def resolve_msg(self, type_or_class: Any) -> _MessageClass:
        """The class that is meant by a class of ours, ``"pkg/Type"`` or a class of genpy.

        For a class that is not ours, one with the same MD5 sum: the store's, or one made
        from the class's ``_full_text``. Raises :class:`TypeError` for anything else.
        """
        if isinstance(type_or_class, type):
            if issubclass(type_or_class, AnyMessage):
                return type_or_class
            type_ = getattr(type_or_class, "_type", None)
            md5sum = getattr(type_or_class, "_md5sum", None)
            text = getattr(type_or_class, "_full_text", None)
            if isinstance(type_, str) and isinstance(md5sum, str) and isinstance(text, str):
                return self._foreign(type_, md5sum, text)
        elif isinstance(type_or_class, str):
            return self.load_msg(type_or_class)
        raise TypeError(f"{type_or_class!r} is neither a message class nor 'package/Type'")

    def resolve_srv(self, type_or_class: Any) -> _ServiceClass:
        """The same for services."""
        if isinstance(type_or_class, type):
            if issubclass(type_or_class, AnyService):
                return type_or_class
            type_ = getattr(type_or_class, "_type", None)
            md5sum = getattr(type_or_class, "_md5sum", None)
            request = getattr(type_or_class, "_request_class", None)
            response = getattr(type_or_class, "_response_class", None)
            if isinstance(type_, str) and isinstance(request, type) and isinstance(response, type):
                try:
                    known = self.load_srv(type_)
                except (MessageNotFoundError, MessageSpecError):
                    known = None
                if known is not None and known._md5sum == md5sum:
                    return known
                return _join_service(type_, self.resolve_msg(request), self.resolve_msg(response))
        elif isinstance(type_or_class, str):
            return self.load_srv(type_or_class)
        raise TypeError(f"{type_or_class!r} is neither a service class nor 'package/Type'")

    def _foreign(self, type: str, md5sum: str, full_text: str) -> _MessageClass:
        try:
            known = self.load_msg(type)
            if known._md5sum == md5sum:
                return known
        except (MessageNotFoundError, MessageSpecError):
            pass
        made = self.add_definition(type, full_text)
        if made._md5sum != md5sum:
            raise MessageSpecError(
                f"the definition of the class has MD5 sum {made._md5sum}, not {md5sum}", path=type
            )
        return made

    # -- inside -----------------------------------------------------------------------

    def _source(self, kind: Kind, type: str) -> _Source | None:
        """This store's own definition of a type."""
        text = self._texts.get((kind, type))
        if text is not None:
            return text, type
        path = self._search.find(*split_type(type), kind)
        if path is None:
            return None
        # Definitions are ASCII by rule; a comment in Latin-1 must not be the end of it, and
        # a constant keeps its octets, which count for the MD5 sum.
        return path.read_text(encoding="utf-8", errors="surrogateescape"), str(path)

    def _spec(self, type: str) -> MessageSpec | None:
        source = self._source("msg", type)
        if source is not None:
            return parse_message(type, source[0], path=source[1])
        # The messages of an action exist as files only where it has been built.
        for suffix in ACTION_SUFFIXES:
            base = type.removesuffix(suffix)
            if base != type and not base.endswith("/"):
                source = self._source("action", base)
                if source is not None:
                    text = action_texts(base, source[0], path=source[1])[suffix]
                    return parse_message(type, text, path=source[1])
        return None

    def _load(self, type: str, chain: _Chain) -> _MessageClass:
        found = self._messages.get(type)
        if found is not None:
            return found
        spec = self._spec(type)
        if spec is None:
            inherited = self._inherited(type, chain)
            if not self._overrides(specs_of([inherited])):
                self._messages[type] = inherited
                return inherited
            spec = inherited._spec
        cls = _build(spec, self._load, chain)
        self._messages[type] = cls
        return cls

    def _inherited(self, type: str, chain: _Chain) -> _MessageClass:
        """The parent's class, or as a last resort one that a peer has defined."""
        try:
            if self.parent is None:
                raise self._not_found(type, ("msg",), chain)
            with self._searched_too():
                return self.parent._load(type, chain)
        except MessageNotFoundError:
            for (name, _), cls in self._definitions.items():
                if name == type:
                    return cls
            raise

    def _overrides(self, types: Iterable[str]) -> bool:
        return any(self._source("msg", type) is not None for type in types)

    def _load_srv(self, type: str) -> _ServiceClass:
        source = self._source("srv", type)
        if source is None:
            if self.parent is None:
                raise self._not_found(type, ("srv",))
            with self._searched_too():
                inherited = self.parent.load_srv(type)
            parts = (inherited.Request, inherited.Response)
            inside = specs_of(cls for part in parts for cls in part._nested.values())
            if not self._overrides(inside):
                return inherited
            spec = inherited._spec
        else:
            spec = parse_service(type, source[0], path=source[1])
        return _build_service(spec, self._load)

    def _not_found(
        self, type: str, kinds: tuple[Kind, ...], chain: _Chain = ()
    ) -> MessageNotFoundError:
        files = ", ".join(f".{kind}" for kind in kinds)
        return MessageNotFoundError(
            f"no definition ({files}) of {type}{_needed_by(chain)}", self.places()
        )

    @contextmanager
    def _searched_too(self) -> Iterator[None]:
        """What the parent does not find was looked for here before."""
        try:
            yield
        except MessageNotFoundError as error:
            if error.places is not None:
                error.places = list(dict.fromkeys([*self._search.places(), *error.places]))
            raise


def _remember(
    definitions: dict[tuple[str, str], _MessageClass], key: tuple[str, str], cls: _MessageClass
) -> None:
    """Keep a definition, and drop the oldest: peers send them, and one may have no end of them."""
    while len(definitions) >= _MAX_DEFINITIONS:
        del definitions[next(iter(definitions))]
    definitions[key] = cls


def _needed_by(chain: _Chain) -> str:
    return f", needed by {' -> '.join(chain)}" if chain else ""


def _module(kind: Kind, type: str) -> str:
    return f"aioros1.{kind}.{type.partition('/')[0]}"


_Load: TypeAlias = Callable[[str, _Chain], _MessageClass]


def _build(spec: MessageSpec, load: _Load, chain: _Chain, *, kind: Kind = "msg") -> _MessageClass:
    """Make a class, with ``load`` for the types of its fields."""
    chain = (*chain, spec.type)
    if len(chain) > _MAX_DEPTH:
        raise MessageSpecError(f"types nested over {_MAX_DEPTH} deep", path=chain[0])
    nested = {}
    for name in spec.dependencies:
        if name in chain:
            circle = " -> ".join((*chain[chain.index(name) :], name))
            raise MessageSpecError(f"a type that contains itself: {circle}", path=spec.type)
        nested[name] = load(name, chain)
    specs = {name: cls._spec for name, cls in nested.items()}
    sums = {name: cls._md5sum for name, cls in nested.items()}
    return make_message_class(
        spec,
        nested,
        md5sum=digest.md5sum(spec, specs.__getitem__, sums),
        module=_module(kind, spec.type),
    )


def _build_service(spec: ServiceSpec, load: _Load) -> _ServiceClass:
    request = _build(spec.request, load, (spec.type,), kind="srv")
    response = _build(spec.response, load, (spec.type,), kind="srv")
    return _service(spec, request, response)


def _join_service(type: str, request: _MessageClass, response: _MessageClass) -> _ServiceClass:
    """A service from its two messages, whose texts are all there is of a definition."""
    text = f"{request._spec.text}---\n{response._spec.text}"
    return _service(ServiceSpec(type, request._spec, response._spec, text), request, response)


def _service(spec: ServiceSpec, request: _MessageClass, response: _MessageClass) -> _ServiceClass:
    lookup = specs_of([request, response]).__getitem__
    return make_service_class(
        spec,
        request,
        response,
        md5sum=digest.md5sum(spec, lookup),
        full_text=digest.full_text(spec, lookup),
        module=_module("srv", spec.type),
    )


# -- the store that is used when none is named ----------------------------------------


@cache
def default_store() -> MessageStore:
    """The store of the environment, the installed ROS and the bundle.

    The classes in :mod:`aioros1.msg` and its siblings are those of this store.
    """
    return standard_store()


def standard_store(paths: Iterable[str | os.PathLike[str]] = ()) -> MessageStore:
    """A new store that searches ``paths``, and then what :func:`default_store` searches."""
    store = MessageStore(parent=None)
    store._search = SearchPath(paths, standard=True)
    return store


def load_msg(type: str) -> _MessageClass:
    """:meth:`MessageStore.load_msg` of the default store."""
    return default_store().load_msg(type)


def load_srv(type: str) -> _ServiceClass:
    """:meth:`MessageStore.load_srv` of the default store."""
    return default_store().load_srv(type)


def load_action(type: str) -> type[AnyAction]:
    """:meth:`MessageStore.load_action` of the default store."""
    return default_store().load_action(type)
