"""The Master and Parameter Server API: checks requests, answers them and passes them on.

It refuses the same requests as rosmaster, in the same order and with the same texts and
values: the tools of ROS 1 print the texts, and some programs compare the codes. -1 means a
mistake of the caller, 0 a failure, 1 success.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from typing import Any

from aioros1.master.parameters import (
    MAX_NAME,
    ParameterTree,
    holds_nil,
    param_updates,
    subscription_key,
)
from aioros1.master.registry import Answer, Changed, Notification, Registry
from aioros1.names import resolve_from
from aioros1.wire.http import MAX_URI

__all__ = ["MasterApi"]

_Check = Callable[[str, Any, str], Any]
"""Takes a parameter's name, its value and the caller's name; returns the value to use."""


class _RefusedError(Exception):
    """A parameter of a request is invalid."""


class MasterApi:
    """Answers requests from a :class:`.Registry` and a :class:`.ParameterTree`.

    ``notify`` takes the notifications for other nodes. ``shutdown`` takes the reason of a
    request to shut down and the answer to it, and returns what to answer. The registry gets
    ``max_registrations`` at most.
    """

    def __init__(
        self,
        registry: Registry,
        parameters: ParameterTree,
        *,
        notify: Callable[[Iterable[Notification]], object],
        shutdown: Callable[[str, Answer], object],
        max_registrations: int = 50_000,
    ) -> None:
        self._registry = registry
        self._parameters = parameters
        self._notify = notify
        self._on_shutdown = shutdown
        self._max_registrations = max_registrations
        self._state: Answer | None = None  # all registrations, until they change
        self._room = 0  # registrations that fit for certain
        self.uri = ""
        """The answer of getUri."""
        self.pid = os.getpid()
        """The answer of getPid."""

    def methods(self) -> dict[str, Callable[..., Any]]:
        """Every method by its name, for :class:`.XmlRpcServer`."""
        registry, notify = self._registry, self._notify
        topic, service = ("topic", _topic), ("service", _topic)
        key, api = ("key", _key), ("caller_api", _api)
        topic_type = ("topic_type", _type)

        def told(change: Callable[..., Changed]) -> Callable[..., Answer]:
            def call(*params: Any) -> Answer:
                self._state = None
                answer, notifications = change(*params)
                if notifications:
                    notify(notifications)
                return answer

            return call

        def new(change: Callable[..., Changed], failure: Any) -> Callable[..., Answer]:
            call = told(change)

            def checked(caller_id: str, name: str, *params: Any) -> Answer:
                if not self._has_room(caller_id, name):
                    return self._full(failure)
                return call(caller_id, name, *params)

            return checked

        def plain(query: Callable[..., Answer]) -> Callable[..., Answer]:
            return lambda caller_id, *params: query(*params)

        return {
            "registerPublisher": _checked(
                new(registry.register_publisher, []), [], topic, topic_type, api
            ),
            "unregisterPublisher": _checked(told(registry.unregister_publisher), 0, topic, api),
            "registerSubscriber": _checked(
                new(registry.register_subscriber, []), [], topic, topic_type, api
            ),
            "unregisterSubscriber": _checked(told(registry.unregister_subscriber), 0, topic, api),
            "registerService": _checked(
                new(registry.register_service, 0), 0, service, ("service_api", _api), api
            ),
            "unregisterService": _checked(
                told(registry.unregister_service), 0, service, ("service_api", _api)
            ),
            "lookupService": _checked(plain(registry.lookup_service), "", service),
            "lookupNode": _checked(plain(registry.lookup_node), "", ("node", _name)),
            "getPublishedTopics": _checked(
                plain(registry.published_topics), 0, ("subgraph", _subgraph)
            ),
            "getTopicTypes": _checked(plain(registry.topic_types), []),
            "getSystemState": _checked(lambda caller_id: self._system_state(), [[], [], []]),
            "getUri": _checked(lambda caller_id: (1, "", self.uri), ""),
            "getPid": _checked(lambda caller_id: (1, "", self.pid), -1),
            "shutdown": _checked(self._shutdown, 0, ("msg", _anything)),
            "setParam": _checked(self._set_param, 0, key, ("value", _value)),
            "getParam": _checked(self._get_param, 0, key),
            "deleteParam": _checked(self._delete_param, 0, key),
            "hasParam": _checked(self._has_param, False, key),
            "searchParam": _checked(self._search_param, 0, ("key", _unresolved_key)),
            "getParamNames": _checked(self._param_names, []),
            "subscribeParam": _checked(self._subscribe_param, 0, api, key),
            "unsubscribeParam": _checked(self._unsubscribe_param, 0, api, key),
        }

    def _system_state(self) -> Answer:
        # Tools ask for it again and again, and a large one takes long to make.
        if self._state is None:
            self._state = self._registry.system_state()
        return self._state

    def _has_room(self, caller_id: str, name: str) -> bool:
        if self._registry.has_registered(caller_id, name):
            return True
        # Counted when it may be needed: counting all nodes for each registration is slow.
        if self._room <= 0:
            self._room = self._max_registrations - self._registry.count()
        self._room -= 2  # a publisher may bring a type
        return self._room >= -1

    def _full(self, failure: Any) -> Answer:
        text = f"there are {self._max_registrations} registrations (limits.registrations)"
        return -1, f"ERROR: {text}", failure

    # ------------------------------------------------------------------ parameters

    def _set_param(self, caller_id: str, key: str, value: Any) -> Answer:
        try:
            self._parameters.set(key, value)
        except TypeError as error:
            return -1, f"Error: invalid arguments: {error}", 0
        except ValueError as error:
            return -1, f"ERROR: parameter [{key}] cannot be set: {error}", 0
        self._params_changed(key, value, caller_id)
        return 1, f"parameter {key} set", 0

    def _get_param(self, caller_id: str, key: str) -> Answer:
        try:
            return 1, f"Parameter [{key}]", self._parameters.get(key)
        except KeyError:
            return -1, f"Parameter [{key}] is not set", 0

    def _delete_param(self, caller_id: str, key: str) -> Answer:
        try:
            self._parameters.delete(key)
        except KeyError:
            return -1, f"parameter [{key}] is not set", 0
        self._params_changed(key, {}, None)
        return 1, f"parameter {key} deleted", 0

    def _has_param(self, caller_id: str, key: str) -> Answer:
        return 1, key, self._parameters.has(key)

    def _search_param(self, caller_id: str, key: str) -> Answer:
        try:
            found = self._parameters.search(caller_id, key)
        except ValueError as error:
            return 0, f"Internal failure: {error}", 0
        if found is None:
            return -1, f"Cannot find parameter [{key}] in an upwards search", ""
        return 1, f"Found [{found}]", found

    def _param_names(self, caller_id: str) -> Answer:
        try:
            return 1, "Parameter names", self._parameters.names()
        except ValueError as error:
            return -1, f"ERROR: {error}", []

    def _subscribe_param(self, caller_id: str, api: str, key: str) -> Answer:
        if not self._has_room(caller_id, subscription_key(key)):
            return self._full(0)
        self._notify(
            self._registry.register_param_subscriber(caller_id, subscription_key(key), api)
        )
        value = self._parameters.get(key) if self._parameters.has(key) else {}
        return 1, f"Subscribed to parameter [{key}]", value

    def _unsubscribe_param(self, caller_id: str, api: str, key: str) -> Answer:
        self._registry.unregister_param_subscriber(caller_id, subscription_key(key), api)
        return 1, f"Unsubscribe to parameter [{key}]", 1

    def _params_changed(self, key: str, value: Any, setter: str | None) -> None:
        updates = param_updates(self._registry.param_subscribers, key, value, setter=setter)
        if updates:
            self._notify(updates)

    # ------------------------------------------------------------------ the master itself

    def _shutdown(self, caller_id: str, reason: Any) -> object:
        text = f"external shutdown request from [{caller_id}]: {reason}"
        return self._on_shutdown(text, (1, "shutdown", 0))


def _checked(
    method: Callable[..., Any], failure: Any, *checks: tuple[str, _Check]
) -> Callable[..., Any]:
    """Wrap ``method`` in checks of its parameters, the first of which is the caller's name.

    ``failure`` is the value in answers that refuse a request.
    """

    def call(*params: Any) -> Any:
        if not params:
            return -1, "missing required caller_id parameter", failure
        if len(params) != len(checks) + 1:
            return -1, "Error: bad call arity", failure
        caller_id = params[0]
        if not isinstance(caller_id, str):
            return -1, "caller_id must be a string", failure
        if len(caller_id) > MAX_NAME:
            return -1, f"caller_id has more than {MAX_NAME} characters", failure
        checked = [caller_id]
        try:
            for (name, check), value in zip(checks, params[1:], strict=True):
                checked.append(check(name, value, caller_id))
        except _RefusedError as error:
            return -1, f"ERROR: parameter [{error.args[0]}] {error.args[1]}", failure
        return method(*checked)

    return call


def _check_length(name: str, value: str, most: int = MAX_NAME) -> None:
    # Names are kept, split at each slash, and sent to others.
    if len(value) > most:
        raise _RefusedError(name, f"has more than {most} characters")


def _name(name: str, value: Any, caller_id: str) -> str:
    if not isinstance(value, str) or not value:
        raise _RefusedError(name, "must be a non-empty string")
    _check_length(name, value)
    if ":" in value or " " in value:
        raise _RefusedError(name, "contains illegal chars")
    return resolve_from(value, caller_id)


def _topic(name: str, value: Any, caller_id: str) -> str:
    resolved = _name(name, value, caller_id)
    if resolved == "/":
        raise _RefusedError(name, "cannot be the global namespace")
    return resolved


def _subgraph(name: str, value: Any, caller_id: str) -> str:
    if not isinstance(value, str):
        raise _RefusedError(name, "must be a string")
    _check_length(name, value)
    return resolve_from(value, caller_id) if value else ""


def _type(name: str, value: Any, caller_id: str) -> str:
    if not isinstance(value, str) or not value:
        raise _RefusedError(name, "must be a non-empty string")
    _check_length(name, value)
    if value != "*" and value.count("/") != 1:
        raise _RefusedError(name, "is not a valid package resource name")
    return value


def _api(name: str, value: Any, caller_id: str) -> str:
    if not isinstance(value, str) or not value:
        raise _RefusedError(name, "is not an XMLRPC URI")
    _check_length(name, value, MAX_URI)
    if not value.startswith(("http://", "rosrpc://")):
        raise _RefusedError(name, "is not an RPC URI")
    return value


def _unresolved_key(name: str, value: Any, caller_id: str) -> str:
    if not value:
        raise _RefusedError(name, "must be specified and non-empty")
    if not isinstance(value, str):
        raise _RefusedError(name, "must be a string")
    _check_length(name, value)
    return value


def _key(name: str, value: Any, caller_id: str) -> str:
    return resolve_from(_unresolved_key(name, value, caller_id), caller_id)


def _value(name: str, value: Any, caller_id: str) -> Any:
    if value is None:
        raise _RefusedError(name, "must be specified")
    # rosmaster accepts a nested nil, and then can never again answer for the parameter, its
    # namespaces and "/".
    if holds_nil(value):
        raise _RefusedError(name, "holds a nil, which no parameter can be")
    return value


def _anything(name: str, value: Any, caller_id: str) -> Any:
    return value
