"""The floors of the house, and what may stand on what.

A module may import from the floors below its own. Beside it, it may import modules of its own
package, and values may import each other; nothing imports in a circle.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from .tree import Module, strongly_connected

__all__ = [
    "FLOORS",
    "LAYERS",
    "PUBLIC_ONLY",
    "PURE_VALUES",
    "circles",
    "impure",
    "in_needless_company",
    "wrong_ways",
]

VALUES = (
    "_public",
    "_version",
    "hints",
    "errors",
    "time",
    "names",
    "quoting",
    "options",
    "connection",
    "waiting",
    "events",
)
"""The lowest floor. These are single modules, and may import each other."""

PURE_VALUES = frozenset(VALUES) - {"waiting", "events"}
"""The values that know no event loop."""

LAYERS = (
    "actionlib",
    "tf2",
    "bag",
    "message_filters",
    "diagnostics",
    "dynamic_reconfigure",
    "bond",
    "web",
)
"""Packages for users that stand on public names only."""

FLOORS: tuple[tuple[str, ...], ...] = (
    VALUES,
    ("wire", "idl"),
    ("msg", "srv", "action"),
    ("net",),
    ("xmlrpc",),
    ("clock", "log"),
    ("core",),
    ("params", "topics", "services", "graph"),
    ("node",),
    ("master",),
    ("script", "contrib", "testing", *LAYERS),
    ("cli",),
    ("__main__",),
)
"""The entries of the package from the lowest floor to the highest. Those of one floor do not
know each other."""

FACADE_FROM = "master"
"""The lowest entry that may import the package itself, ``aioros1``, which names everything."""

PUBLIC_ONLY = ("script", "contrib", "testing", *LAYERS, "cli")
"""Entries that use what users use."""

BUNDLED = ("msg", "srv", "action")
"""What stands on ``idl`` alone."""

PURE = re.compile(
    rf"aioros1\.(idl|wire)(\..+)?|aioros1\.({'|'.join(sorted(PURE_VALUES))})"
    r"|aioros1\.master\.(registry|parameters|api)"
)
"""Modules that need no event loop and no HTTP server."""

NEEDS_AIOHTTP = re.compile(
    r"aioros1\.xmlrpc\.server\w*|aioros1\.contrib\.aiohttp|aioros1\.web(\..+)?"
)
"""Modules that may import aiohttp."""

_HEIGHTS = {entry: height for height, floor in enumerate(FLOORS) for entry in floor}


def wrong_ways(modules: dict[str, Module]) -> Iterator[str]:
    """Imports that do not go down."""
    for module in modules.values():
        if not module.entry:
            continue
        if module.entry not in _HEIGHTS:
            yield (
                f"{module.place(1)}: {module.entry!r} stands on no floor; "
                "give it one in FLOORS (tests/house/floors.py)"
            )
            continue
        for one in module.imports:
            top, _, inside = one.target.partition(".")
            if top == "aioros1" and (why := _wrong(module.entry, inside.partition(".")[0])):
                yield f"{module.place(one.line)}: imports {one.target}, {why}"


def _wrong(here: str, there: str) -> str:
    """What is wrong with an import of ``there`` from ``here``, and what to do; or nothing."""
    height = _HEIGHTS[here]
    if not there:
        if height >= _HEIGHTS[FACADE_FROM]:
            return ""
        return f"which names everything; below {FACADE_FROM}, import from the module itself"
    if there == here or there not in _HEIGHTS:
        return ""  # an entry without a floor is reported once, where it stands
    if here in BUNDLED:
        return "" if there == "idl" else f"but {here} stands on idl alone"
    if here in VALUES and there in VALUES:
        return ""
    if _HEIGHTS[there] > height:
        return (
            f"which stands above {here}; pass in what is needed, or move the name down "
            "to the lowest floor that needs it"
        )
    if _HEIGHTS[there] == height:
        return (
            f"which stands beside {here}; move what both need to a floor below, "
            "or let the floor above join them"
        )
    return ""


def circles(modules: dict[str, Module]) -> Iterator[str]:
    """Modules that import each other in a circle, whether it is for types or in functions.

    The package itself imports its names when they are used: what it imports is not followed.
    """
    edges = {
        name: {one.target for one in module.imports if one.target in modules}
        for name, module in modules.items()
    }
    edges["aioros1"] = set()
    for group, circle in strongly_connected(edges):
        first = modules[circle[0]]
        line = next(one.line for one in first.imports if one.target == circle[1])
        yield (
            f"{first.place(line)}: a circle of imports: {' -> '.join(circle)}, the shortest among "
            f"{len(group)} modules; move what they share into a module below all of them"
        )


def impure(modules: dict[str, Module]) -> Iterator[str]:
    """Modules that need an event loop, and should not."""
    for module in modules.values():
        if PURE.fullmatch(module.name):
            for one in module.imports:
                if (top := one.target.partition(".")[0]) in ("asyncio", "aiohttp"):
                    yield (
                        f"{module.place(one.line)}: imports {top}, but is pure; "
                        "move what needs the event loop to net/ or above"
                    )


def in_needless_company(modules: dict[str, Module]) -> Iterator[str]:
    """Modules that import aiohttp beside the few that serve HTTP."""
    for module in modules.values():
        if not NEEDS_AIOHTTP.fullmatch(module.name):
            for one in module.imports:
                if one.target.partition(".")[0] == "aiohttp":
                    yield (
                        f"{module.place(one.line)}: imports aiohttp, which is for "
                        "xmlrpc/server*.py, contrib/aiohttp.py and web/; use what these offer"
                    )


def without_aiohttp(names: Iterable[str]) -> list[str]:
    """The modules below the node that must load without an HTTP server."""
    node = _HEIGHTS["node"]
    return [
        name
        for name in names
        if (entry := name.partition(".")[2].partition(".")[0])
        and (
            _HEIGHTS.get(entry, node) < node
            or PURE.fullmatch(name)
            or name.startswith("aioros1.testing.flaky_")
        )
        and not NEEDS_AIOHTTP.fullmatch(name)
        and not name.endswith("._typing")
    ]
