"""The store: gives the classes of types by name, from definitions wherever they are."""

# ruff: noqa: A001 - `type` is what ROS calls the name of a type, and part of the contract

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import RLock
from typing import Any, Final, TypeAlias, TypeVar

from aioros1._public import public
from aioros1.errors import InvalidNameError, MessageNotFoundError, MessageSpecError
from aioros1.idl import digest
from aioros1.idl.building import (
    ACTION_SUFFIXES,
    ActionClass,
    Chain,
    MessageClass,
    ServiceClass,
    build_action,
    build_message,
    build_service,
    join_action,
    join_service,
    needed_by,
)
from aioros1.idl.factory import specs_of
from aioros1.idl.message import AnyMessage
from aioros1.idl.parser import action_texts, parse_action, parse_message, parse_service, split_type
from aioros1.idl.paths import KINDS, Kind, SearchPath
from aioros1.idl.service import AnyAction, AnyService
from aioros1.idl.spec import MessageSpec
from aioros1.idl.wrong_types import near_types, not_a_type, of_another_kind

__all__ = [
    "MessageStore",
    "default_store",
    "load_action",
    "load_msg",
    "load_srv",
    "standard_store",
]

_DEFAULT: Final = object()
_MAX_DEFINITIONS = 1000

_ACTION_FIELDS: Final = ("action_goal", "action_result", "action_feedback")
"""The fields of the message ``TypeAction`` that an action is given as in rospy."""

_V = TypeVar("_V")

_Source: TypeAlias = tuple[str, str]  # text, and the path for errors


@public
class MessageStore:
    """Loads types by name, each of them once.

    ``paths`` are searched first: directories with packages at any depth, single packages,
    or ``msg`` directories. Types that are neither there nor among the texts that were added
    are looked up in ``parent``, by default :func:`~aioros1.idl.default_store`. With None
    the store knows only its own definitions. If a type of the parent contains a type that
    this store defines itself, it is made anew with that definition.

    A store can be used from several threads.
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
        self._messages: dict[str, MessageClass] = {}
        self._services: dict[str, ServiceClass] = {}
        self._actions: dict[str, ActionClass] = {}
        self._definitions: dict[Any, MessageClass] = {}
        self._joined: dict[Any, Any] = {}
        self._lock = RLock()

    @property
    def parent(self) -> MessageStore | None:
        """The store in which types are looked up that this one does not define; may be None."""
        if self._parent is _DEFAULT:
            self._parent = default_store()
        assert self._parent is None or isinstance(self._parent, MessageStore)
        return self._parent

    # -- loading ----------------------------------------------------------------------

    def load_msg(self, type: str) -> MessageClass:
        """The class of a message type, ``"pkg/Type"``.

        Raises :class:`MessageNotFoundError` if there is no definition of the type or of one
        inside it, :class:`MessageSpecError` if a definition cannot be read, and
        :class:`InvalidNameError` if ``type`` is not such a name.
        """
        if isinstance(type, str) and (found := self._messages.get(type)) is not None:
            return found
        with self._explaining(type, "msg"):
            return self._find_msg(type)

    def load_srv(self, type: str) -> ServiceClass:
        """The class of a service type; errors as for :meth:`load_msg`."""
        if isinstance(type, str) and (found := self._services.get(type)) is not None:
            return found
        with self._explaining(type, "srv"):
            return self._find_srv(type)

    def load_action(self, type: str) -> ActionClass:
        """The class of an action type; errors as for :meth:`load_msg`.

        You can also load each of its seven messages by name.
        """
        if isinstance(type, str) and (found := self._actions.get(type)) is not None:
            return found
        with self._explaining(type, "action"):
            return self._find_action(type)

    # -- adding -----------------------------------------------------------------------

    def add_text(self, type: str, text: str, *, kind: Kind | None = None) -> None:
        """Define a type by a text, which goes before any file.

        Without ``kind`` the lines of three dashes decide: none for a message, one for a
        service, two for an action. Types that the definition needs can be added later.
        Classes that were made from an earlier definition do not change. Raises
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
            self._joined.clear()

    def add_definition(self, type: str, full_text: str) -> MessageClass:
        """The class for a complete definition, as connection headers and bags have it.

        All types inside are read from this text, and from nowhere else. If the store knows
        the type with the same MD5 sum, you get the class of the store. Otherwise the new
        class does not replace that of the store: a load by name finds it only if there is
        no other definition of that name. Raises errors as :meth:`load_msg` does.
        """
        with self._lock:
            # Every connection to a topic brings the same text again.
            found = self._definitions.get((type, full_text))
            if found is None:
                found = self._define(type, full_text)
                _remember(self._definitions, (type, full_text), found)
            return found

    def _define(self, type: str, full_text: str) -> MessageClass:
        texts = digest.split_full_text(type, full_text)
        made: dict[str, MessageClass] = {}

        def load(name: str, chain: Chain) -> MessageClass:
            if name not in made:
                if name not in texts:
                    raise MessageNotFoundError(
                        f"the definition of {type} lacks {name}{needed_by(chain)}"
                    )
                spec = parse_message(name, texts[name])
                made[name] = build_message(spec, load, chain)
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
        """The file that defines a type. Raises :class:`MessageNotFoundError` if none does."""
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
        with self._lock:
            names = {split_type(type)[0] for _, type in self._texts}
        names |= self._search.packages()
        return sorted(names.union(self.parent.packages() if self.parent else ()))

    def types(self, package: str, kind: Kind = "msg") -> list[str]:
        """All types of a package, as ``pkg/Type``, sorted."""
        with self._lock:
            names = {
                type
                for other, type in self._texts
                if other == kind and split_type(type)[0] == package
            }
        names |= {f"{package}/{name}" for name in self._search.types(package, kind)}
        return sorted(names.union(self.parent.types(package, kind) if self.parent else ()))

    def suggest(self, type: str, kind: Kind = "msg") -> list[str]:
        """The few types that somebody may have meant by a wrong name, the likest first."""
        return near_types(
            type,
            kind,
            self._package_names(),
            self._package_names(given=True),
            lambda package: self.types(package, kind),
            lambda package, name: self._has(package, name, kind),
        )

    def places(self) -> list[str]:
        """The directories that are searched, in order."""
        inherited = self.parent.places() if self.parent else []
        return list(dict.fromkeys([*self._search.places(), *inherited]))

    # -- what users hand over in place of a name ---------------------------------------

    def resolve_msg(self, type_or_class: Any) -> MessageClass:
        """The message class that a user means by a name or a class.

        ``type_or_class`` is ``"pkg/Type"``, a message class of ours, which is returned as
        it is, or one of genpy's. For a class of genpy's you get a class of ours with the
        same MD5 sum: the store's if it knows such a type, otherwise one made from the
        class's own definition.

        Raises :class:`TypeError` for anything else, and errors as :meth:`load_msg` does.
        """
        if isinstance(type_or_class, str):
            return self.load_msg(type_or_class)
        if isinstance(type_or_class, type) and isinstance(_genpy(type_or_class, "_type"), str):
            if issubclass(type_or_class, AnyMessage):
                return type_or_class
            type_ = _genpy(type_or_class, "_type")
            md5sum = _genpy(type_or_class, "_md5sum")
            text = _genpy(type_or_class, "_full_text")
            is_service = _genpy(type_or_class, "_request_class") is not None
            is_other = is_service or issubclass(type_or_class, AnyAction)
            if isinstance(md5sum, str) and isinstance(text, str) and not is_other:
                return self._foreign(type_, md5sum, text)
        raise not_a_type("msg", type_or_class)

    def resolve_srv(self, type_or_class: Any) -> ServiceClass:
        """The service class that a user means by a name or a class.

        Takes names, classes of ours and classes of genpy's, as :meth:`resolve_msg` does;
        so for the errors.
        """
        if isinstance(type_or_class, str):
            return self.load_srv(type_or_class)
        if isinstance(type_or_class, type) and isinstance(_genpy(type_or_class, "_type"), str):
            if issubclass(type_or_class, AnyService):
                return type_or_class
            request = _genpy(type_or_class, "_request_class")
            response = _genpy(type_or_class, "_response_class")
            if isinstance(request, type) and isinstance(response, type):
                type_ = _genpy(type_or_class, "_type")
                md5sum = _genpy(type_or_class, "_md5sum")
                try:
                    known = self._find_srv(type_)
                except (MessageNotFoundError, MessageSpecError):
                    known = None
                if known is not None and known._md5sum == md5sum:
                    return known
                parts = self.resolve_msg(request), self.resolve_msg(response)
                made: ServiceClass = self._join(
                    (type_, *parts), lambda: join_service(type_, *parts)
                )
                return made
        raise not_a_type("srv", type_or_class)

    def resolve_action(self, type_or_class: Any) -> ActionClass:
        """The action class that a user means by a name or a class.

        ``type_or_class`` is ``"pkg/Type"``, an action class of ours, which is returned as
        it is, or what rospy's actionlib takes: the message class ``TypeAction``, genpy's
        or ours.

        Raises :class:`TypeError` for anything else, and errors as :meth:`load_action` does.
        """
        if isinstance(type_or_class, str):
            return self.load_action(type_or_class)
        if isinstance(type_or_class, type) and isinstance(_genpy(type_or_class, "_type"), str):
            if issubclass(type_or_class, AnyAction):
                return type_or_class
            if tuple(type_or_class.__dict__.get("__slots__", ())) == _ACTION_FIELDS:
                return self._action_of(self.resolve_msg(type_or_class))
        raise not_a_type("action", type_or_class)

    def __repr__(self) -> str:
        loaded = len(self._messages) + len(self._services) + len(self._actions)
        added = f", {_counted(len(self._texts), 'added text')}" if self._texts else ""
        return (
            f"<MessageStore: {self._search.describe()}{added}, {_counted(loaded, 'type')} loaded>"
        )

    def _action_of(self, message: MessageClass) -> ActionClass:
        """The action whose message ``TypeAction`` this is."""
        type = message._type.removesuffix("Action")
        try:
            known = self._find_action(type)
        except (MessageNotFoundError, MessageSpecError):
            known = None
        if known is not None and known._md5sum == message._md5sum:
            return known
        made: ActionClass = self._join(message, lambda: join_action(message))
        return made

    def _join(self, key: Any, make: Callable[[], Any]) -> Any:
        """What ``make`` makes of classes, once for each key."""
        with self._lock:
            made = self._joined.get(key)
            if made is None:
                made = make()
                _remember(self._joined, key, made)
            return made

    def _foreign(self, type: str, md5sum: str, full_text: str) -> MessageClass:
        try:
            known = self._find_msg(type)
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

    def _find_msg(self, type: str) -> MessageClass:
        with self._lock:
            return self._load(type, ())

    def _find_srv(self, type: str) -> ServiceClass:
        with self._lock:
            found = self._services.get(type)
            if found is None:
                found = self._services[type] = self._load_srv(type)
            return found

    def _find_action(self, type: str) -> ActionClass:
        with self._lock:
            found = self._actions.get(type)
            if found is None:
                found = self._actions[type] = self._load_action(type)
            return found

    def _source(self, kind: Kind, type: str) -> _Source | None:
        """This store's own definition of a type."""
        text = self._texts.get((kind, type))
        if text is not None:
            return text, type
        path = self._search.find(*split_type(type), kind)
        if path is None:
            return None
        # Definitions have to be ASCII. But a comment in Latin-1 does no harm, and a constant
        # keeps its bytes, which count for the MD5 sum.
        return path.read_text(encoding="utf-8", errors="surrogateescape"), str(path)

    def _spec(self, type: str) -> MessageSpec | None:
        source = self._source("msg", type)
        if source is not None:
            return parse_message(type, source[0], path=source[1])
        # The messages of an action have files only where the action has been built.
        for suffix in ACTION_SUFFIXES:
            base = type.removesuffix(suffix)
            if base != type and not base.endswith("/"):
                source = self._source("action", base)
                if source is not None:
                    text = action_texts(base, source[0], path=source[1])[suffix]
                    return parse_message(type, text, path=source[1])
        return None

    def _load(self, type: str, chain: Chain) -> MessageClass:
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
        cls = build_message(spec, self._load, chain)
        self._messages[type] = cls
        return cls

    def _inherited(self, type: str, chain: Chain) -> MessageClass:
        """The class of the parent; if it has none, one that a peer has defined."""
        try:
            if self.parent is None:
                raise self._not_found(type, ("msg",), chain)
            # Locks are taken from a store to its parent, and never the other way.
            with self._searched_too(), self.parent._lock:
                return self.parent._load(type, chain)
        except MessageNotFoundError:
            for (name, _), cls in self._definitions.items():
                if name == type:
                    return cls
            raise

    def _overrides(self, types: Iterable[str]) -> bool:
        return any(self._source("msg", type) is not None for type in types)

    def _load_srv(self, type: str) -> ServiceClass:
        source = self._source("srv", type)
        if source is None:
            if self.parent is None:
                raise self._not_found(type, ("srv",))
            with self._searched_too():
                inherited = self.parent._find_srv(type)
            parts = (inherited.Request, inherited.Response)
            inside = specs_of(cls for part in parts for cls in part._nested.values())
            if not self._overrides(inside):
                return inherited
            spec = inherited._spec
        else:
            spec = parse_service(type, source[0], path=source[1])
        return build_service(spec, self._load)

    def _load_action(self, type: str) -> ActionClass:
        source = self._source("action", type)
        if source is None:
            if self.parent is None:
                raise self._not_found(type, ("action",))
            with self._searched_too():
                inherited = self.parent._find_action(type)
            spec = inherited._spec
        else:
            inherited = None
            spec = parse_action(type, source[0], path=source[1])
        messages = {suffix: self._load(f"{type}{suffix}", (type,)) for suffix in spec.messages}
        if inherited is not None and all(
            getattr(inherited, suffix) is cls for suffix, cls in messages.items()
        ):
            return inherited
        return build_action(spec, messages)

    def _not_found(
        self, type: str, kinds: tuple[Kind, ...], chain: Chain = ()
    ) -> MessageNotFoundError:
        files = ", ".join(f".{kind}" for kind in kinds)
        others = [
            f".{kind}"
            for kind in KINDS
            if kind not in kinds and self._source(kind, type) is not None
        ]
        hint = f", which has a {' and a '.join(others)}" if others else ""
        return MessageNotFoundError(
            f"no definition ({files}) of {type}{hint}{needed_by(chain)}", self.places()
        )

    @contextmanager
    def _explaining(self, type: Any, kind: Kind) -> Iterator[None]:
        """If a name that a user gave is wrong, the error says what may have been meant."""
        if not isinstance(type, str):
            split_type(type)  # raises
        try:
            yield
        except InvalidNameError as error:
            if names := " or ".join(self.suggest(type, kind)):
                raise InvalidNameError(f"{error}; did you mean {names}?") from None
            raise
        except MessageNotFoundError as error:
            package, name = split_type(type)
            if self._has(package, name, kind):
                raise  # the name is right, but one inside is not
            for other in KINDS:
                if self._has(package, name, other):
                    raise MessageNotFoundError(of_another_kind(kind, other, type)) from None
            error.suggestions = tuple(self.suggest(type, kind))
            raise

    def _package_names(self, *, given: bool = False) -> set[str]:
        """The names that packages may have; ``given``: only of what users gave to stores."""
        with self._lock:
            names = {split_type(type)[0] for _, type in self._texts}
        names |= self._search.candidates(given=given)
        return names.union(self.parent._package_names(given=given) if self.parent else ())

    def _has(self, package: str, name: str, kind: Kind) -> bool:
        """Whether there is a definition of ``package/name``, here or in a parent."""
        if (kind, f"{package}/{name}") in self._texts:
            return True
        if self._search.find(package, name, kind) is not None:
            return True
        return self.parent is not None and self.parent._has(package, name, kind)

    @contextmanager
    def _searched_too(self) -> Iterator[None]:
        """If the parent does not find a type, the error names the places of this store too."""
        try:
            yield
        except MessageNotFoundError as error:
            if error.places is not None:
                error.places = list(dict.fromkeys([*self._search.places(), *error.places]))
            raise


def _remember(kept: dict[Any, _V], key: Any, value: _V) -> None:
    """Keep a value, and drop the oldest: peers send definitions, and one may send any number."""
    while len(kept) >= _MAX_DEFINITIONS:
        del kept[next(iter(kept))]
    kept[key] = value


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'s' * (number != 1)}"


def _genpy(cls: object, name: str) -> Any:
    """A class attribute by genpy's name, or None."""
    return getattr(cls, name, None)


# -- the store that is used when none is named ----------------------------------------


@public("aioros1.idl")
def standard_store(paths: Iterable[str | os.PathLike[str]] = ()) -> MessageStore:
    """A new store that searches ``paths``, and then what :func:`default_store` searches."""
    store = MessageStore(parent=None)
    store._search = SearchPath(paths, standard=True)
    return store


_default_store: Final = standard_store()  # reads nothing before it is asked for a type


@public("aioros1.idl")
def default_store() -> MessageStore:
    """The store of the environment, the installed ROS and the bundle.

    The classes in :mod:`aioros1.msg` and its siblings are those of this store.
    """
    return _default_store


@public
def load_msg(type: str) -> MessageClass:
    """:meth:`MessageStore.load_msg` of the default store."""
    return default_store().load_msg(type)


@public
def load_srv(type: str) -> ServiceClass:
    """:meth:`MessageStore.load_srv` of the default store."""
    return default_store().load_srv(type)


@public
def load_action(type: str) -> ActionClass:
    """:meth:`MessageStore.load_action` of the default store."""
    return default_store().load_action(type)
