"""Who touches what is private to others.

A name with one leading underscore belongs to its package (``aioros1/topics``), or to its file
where that stands alone (``aioros1/time.py``). A subclass may use what it inherits, by ``self``;
in packages that stand on public names, not even that, but for what
:class:`aioros1.Composite` has for classes that are derived from it.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from .floors import PUBLIC_ONLY
from .tree import Module

__all__ = [
    "FOR_COMPOSITES",
    "GENPY",
    "INSIDE_PYTHON",
    "NAMED_TUPLES",
    "InsidePython",
    "touched",
]

GENPY = frozenset(
    {
        "_connection_header",
        "_full_text",
        "_has_header",
        "_md5sum",
        "_request_class",
        "_response_class",
        "_slot_types",
        "_type",
    }
)
"""Public attributes of messages and services, which genpy named so."""

NAMED_TUPLES = frozenset(["_asdict", "_field_defaults", "_fields", "_make", "_replace"])
"""Public attributes of named tuples, which Python named so."""


FOR_COMPOSITES = frozenset(["_abort", "_check_open", "_close", "_create_task", "_open", "_own"])
"""What a class derived from :class:`aioros1.Composite` may use of it, or replace."""


@dataclass(frozen=True)
class InsidePython:
    """Something private of the standard library that a module cannot do without."""

    module: str
    name: str
    reason: str


_HELPERS = "multiprocessing has no public way to the pipes of the helpers that it keeps running"

INSIDE_PYTHON = (
    InsidePython(
        "aioros1.net.coalescing",
        "_is_owned",
        "threading.Condition asks it too; there is no public way to tell who holds a lock",
    ),
    InsidePython(
        "aioros1.log.node_log",
        "_getframe",
        "documented; there is no public way to the caller's frame that is as cheap",
    ),
    InsidePython(
        "aioros1.testing.leaks",
        "_DummyThread",
        "threads that Python did not start are nobody's leak, and told by nothing else",
    ),
    *(
        InsidePython("aioros1.testing.leaks", name, _HELPERS)
        for name in ("_fd", "_forkserver", "_forkserver_alive_fd", "_resource_tracker")
    ),
    InsidePython(
        "aioros1.testing.simulated_clock",
        "_fut_waiter",
        "asyncio has no public way to tell a task that waits from one that can run",
    ),
)

_ACCESSORS = frozenset(["getattr", "setattr", "hasattr", "delattr", "attrgetter"])


def touched(
    modules: dict[str, Module], inside: tuple[InsidePython, ...] = INSIDE_PYTHON
) -> Iterator[str]:
    """Private names that are used outside of the package they belong to."""
    own: dict[str, set[str]] = {}
    for module in modules.values():
        own.setdefault(module.entry, set()).update(_defined(module.tree))
    composites = {entry: _composites(modules, entry) for entry in PUBLIC_ONLY}
    excused = {(one.module, one.name) for one in inside}
    used = set[tuple[str, str]]()
    for module in modules.values():
        uses = [*_uses(module), *(_spelled(module) if module.entry in PUBLIC_ONLY else ())]
        for line, owner, name in uses:
            if name in own[module.entry] or name in GENPY or name in NAMED_TUPLES:
                continue
            if (module.name, name) in excused:
                used.add((module.name, name))
            elif (
                owner in ("self", "super()")
                and name in FOR_COMPOSITES
                and any(
                    each.lineno <= line <= (each.end_lineno or 0)
                    for each in _classes(module)
                    if each.name in composites.get(module.entry, ())
                )
            ):
                continue
            elif owner not in ("self", "cls", "super()") or module.entry in PUBLIC_ONLY:
                yield (
                    f"{module.place(line)}: {owner}.{name} is private to another package; "
                    "ask the object for what you need by a public name, or give it one"
                )
    for module_name, name in sorted(excused - used):
        if module_name in modules:
            place = modules[module_name].place(1)
            yield f"{place}: {name} is not used any more; take it out of INSIDE_PYTHON"


def _classes(module: Module) -> Iterator[ast.ClassDef]:
    return (node for node in ast.walk(module.tree) if isinstance(node, ast.ClassDef))


def _composites(modules: dict[str, Module], entry: str) -> set[str]:
    """The classes of a package that are derived from Composite, some by way of others."""
    found = {"Composite"}
    classes = [
        each for module in modules.values() if module.entry == entry for each in _classes(module)
    ]
    for _ in classes:
        for each in classes:
            bases = (base.value if isinstance(base, ast.Subscript) else base for base in each.bases)
            if any(ast.unparse(base).rpartition(".")[2] in found for base in bases):
                found.add(each.name)
    return found


def _is_private(name: str) -> bool:
    return name.startswith("_") and not name.startswith("__") and name.strip("_") != ""


def _defined(tree: ast.Module) -> Iterator[str]:
    """The private names that a module gives to its classes, their instances and itself."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                yield name
            case ast.ClassDef(name=name, body=body):
                yield name
                yield from _assigned(body)
                for statement in body:
                    if isinstance(statement, ast.Assign) and any(
                        isinstance(target, ast.Name) and target.id == "__slots__"
                        for target in statement.targets
                    ):
                        for part in ast.walk(statement.value):
                            if isinstance(part, ast.Constant) and isinstance(part.value, str):
                                yield part.value
            case ast.Attribute(value=ast.Name(id="self" | "cls"), attr=name, ctx=ast.Store()):
                yield name
    yield from _assigned(tree.body)


def _assigned(body: list[ast.stmt]) -> Iterator[str]:
    """What statements assign, in ``if`` and ``try`` too, but not in functions or classes."""
    for statement in body:
        if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            continue
        for node in ast.walk(statement):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                yield node.id


def _uses(module: Module) -> Iterator[tuple[int, str, str]]:
    """Each use of a private name: its line, what it is taken from, and the name."""
    for node in ast.walk(module.tree):
        match node:
            case ast.Attribute(value=value, attr=name) if _is_private(name):
                yield node.lineno, _owner(value), name
            case ast.Call(
                func=ast.Name(id=function) | ast.Attribute(attr=function), args=arguments
            ) if function in _ACCESSORS:
                for argument in arguments:
                    match argument:
                        case ast.Constant(value=str(name)) if _is_private(name):
                            owner = "" if argument is arguments[0] else _owner(arguments[0])
                            yield node.lineno, owner or "object", name
            case ast.ImportFrom(module=source, names=names):
                # What is private to the whole package, anybody in it may use.
                _, _, inside = (source or "").partition(".")
                if source and inside.partition(".")[0] in ("", module.entry):
                    continue
                for alias in names:
                    if _is_private(alias.name):
                        yield node.lineno, source or ".", alias.name


def _spelled(module: Module) -> Iterator[tuple[int, str, str]]:
    """Private names as text, in a module that takes attributes by names it has in variables."""
    nodes = list(ast.walk(module.tree))
    for node in nodes:
        match node:
            case ast.Call(func=ast.Name(id=function), args=[_, name, *_]) if (
                function in _ACCESSORS and not isinstance(name, ast.Constant)
            ):
                break
    else:
        return
    for node in nodes:
        match node:
            case ast.Constant(value=str(text)) if text.isidentifier() and _is_private(text):
                yield node.lineno, "object", text


def _owner(value: ast.expr) -> str:
    """What an attribute is taken from, as it is written; ``super()`` in all its forms."""
    match value:
        case ast.Call(func=ast.Name(id="super")):
            return "super()"
    text = ast.unparse(value)
    return f"({text})" if isinstance(value, ast.IfExp | ast.BinOp | ast.BoolOp) else text
