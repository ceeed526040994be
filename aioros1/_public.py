"""The mark of what is public."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, ForwardRef, TypeVar, overload

__all__ = ["HOMES", "public"]

T = TypeVar("T", bound=Callable[..., Any])

HOMES: dict[str, str] = {}
"""The modules in which public names are defined, by public path. Files may move; who looks for
the source of ``aioros1.Node``, as the documentation does, finds it here."""


@overload
def public(module: str, /) -> Callable[[T], T]: ...
@overload
def public(thing: T, /) -> T: ...
def public(thing: Any, /) -> Any:
    """Mark a class or function as public: its name and path are a promise.

    ::

        @public                      # aioros1.Node
        class Node: ...

        @public("aioros1.testing")   # aioros1.testing.FlakyProxy
        class FlakyProxy: ...

    The argument is the module from which users import it, ``aioros1`` by default, and it becomes
    the ``__module__``. Tracebacks, reprs, pickles and the documentation then show the public
    path, and not the file where the definition happens to stand. That module has to have the
    name in its ``__all__``; ``tests/house`` compares.

    It has to be the outermost decorator: ``@dataclass`` evaluates annotations by ``__module__``,
    and with ``slots=True`` makes a new class.

    Annotations of a class are evaluated here, as far as their names are known by now. Later,
    :func:`typing.get_type_hints` would look for these names in the public module.

    ``inspect.getsource`` finds functions and methods as before, but not the class as a whole: it
    looks in the file of the public module. :data:`HOMES` says which file it is.
    """
    if isinstance(thing, str):
        return lambda marked: _mark(marked, thing)
    return _mark(thing, "aioros1")


def _mark(thing: Any, module: str) -> Any:
    home = thing.__module__
    if isinstance(thing, type):
        known = {**vars(sys.modules[home]), thing.__name__: thing}
        annotations = vars(thing).get("__annotations__", {})
        for name, annotation in annotations.items():
            annotations[name] = _evaluated(annotation, known)
    HOMES[f"{module}.{thing.__qualname__}"] = home
    thing.__module__ = module
    return thing


def _evaluated(annotation: Any, known: dict[str, Any]) -> Any:
    text = annotation.__forward_arg__ if isinstance(annotation, ForwardRef) else annotation
    if not isinstance(text, str):
        return annotation
    try:
        return eval(text, known)
    except NameError:  # imported for type checkers only
        return annotation
