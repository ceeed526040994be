"""What is public, what the reference says of it, and what is wrong with that."""

from __future__ import annotations

import ast
import inspect
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from .floors import BUNDLED, LAYERS, PUBLIC_ONLY
from .tree import ROOT, Module, read_tree

__all__ = [
    "Public",
    "documented",
    "private_imports",
    "private_in_signatures",
    "public_modules",
    "public_names",
    "speechless",
    "undescribed",
    "unlike_the_reference",
    "wrong_paths",
]

MODULES = (
    "aioros1",
    "aioros1.idl",
    "aioros1.names",
    "aioros1.testing",
    "aioros1.wire.frames",
    "aioros1.wire.handshake",
    "aioros1.wire.header",
    "aioros1.wire.http",
    "aioros1.wire.service",
    "aioros1.wire.xmlrpc",
)
"""Modules whose ``__all__`` is a promise, beside those of ``contrib`` and the layers."""

FOR_THE_WHOLE_PACKAGE = ("aioros1._public", "aioros1._version")
"""Modules that all of the package may use, and nobody else."""


def public_modules(root: Path = ROOT) -> tuple[str, ...]:
    """The paths from which users import."""
    contrib = sorted((root / "aioros1" / "contrib").glob("[!_]*.py"))
    layers = [layer for layer in LAYERS if (root / "aioros1" / layer).exists()]
    return (
        *MODULES,
        *(f"aioros1.contrib.{path.stem}" for path in contrib),
        *(f"aioros1.{layer}" for layer in layers),
    )


@dataclass(frozen=True)
class Public:
    """One public name."""

    path: str
    value: Any

    @property
    def place(self) -> str:
        """Where it is defined, or its path where nothing tells."""
        try:
            module, tree = _source(self.value)
            line = next(one.lineno for one in tree.body if _named(one) == self.value.__name__)
        except (AttributeError, KeyError, StopIteration, TypeError):
            return self.path
        return f"{_relative(module)}:{line}: {self.path}"


def public_names(modules: tuple[str, ...]) -> dict[str, Public]:
    """All public names but dunders, by public path."""
    return {
        f"{module}.{name}": Public(f"{module}.{name}", getattr(import_module(module), name))
        for module in modules
        for name in import_module(module).__all__
        if not name.startswith("__")
    }


# paths and pages


def wrong_paths(names: dict[str, Public]) -> Iterator[str]:
    """Classes and functions that show another path than the one they are imported from."""
    for path, one in names.items():
        module, shown = path.rpartition(".")[0], _module_of(one.value)
        if shown is not None and shown != module:
            mark = "@public" if module == "aioros1" else f"@public({module!r})"
            yield f"{one.place}: its __module__ is {shown}; mark it with {mark}"


def _module_of(value: Any) -> str | None:
    """What a class or function shows; a value has none, and where it is from is not shown."""
    if isinstance(value, type) or inspect.isroutine(value):
        return str(value.__module__)
    return None


_DIRECTIVE = re.compile(
    r"^\.\. (?:py:)?(?P<auto>auto)?"
    r"(?P<kind>module|class|exception|function|data|attribute):: *(?P<path>[\w.]+)"
    r"(?P<options>(?:\n +:.*)*)",
    re.MULTILINE,
)


def documented(pages: Path = ROOT / "docs" / "api") -> Iterator[tuple[str, str]]:
    """Each public path that the reference describes, and where."""
    for page in sorted(pages.rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        for match in _DIRECTIVE.finditer(text):
            place = (
                f"docs/api/{page.relative_to(pages)}:{text.count(chr(10), 0, match.start()) + 1}"
            )
            path = match["path"]
            if match["kind"] != "module":
                yield path, place
            elif match["auto"]:
                excluded = re.search(r":exclude-members: *(.*)", match["options"])
                without = re.split(r",\s*", excluded[1]) if excluded else []
                for name in import_module(path).__all__:
                    if name not in without:
                        yield f"{path}.{name}", place


def unlike_the_reference(
    names: dict[str, Public], described: list[tuple[str, str]]
) -> Iterator[str]:
    """Names that only the code, or only the reference, takes for public."""
    seen: dict[str, str] = {}
    for path, place in described:
        if path in seen:
            yield f"{place}: {path} is described in {seen[path]} already; take one out"
        seen[path] = place
        if path not in names:
            yield (
                f"{place}: {path} is not public; put it into __all__ of a public module "
                "and name it by that path, or take it out"
            )
    for path, one in names.items():
        if path not in seen:
            yield f"{one.place}: is not in the reference; describe it in docs/api"


# what is said


def undescribed(names: dict[str, Public]) -> Iterator[str]:
    """Classes, functions and members without a description; each member once."""
    seen = set[tuple[str, int, str]]()
    for one in names.values():
        if _module_of(one.value) is None:
            continue
        doc = one.value.__doc__
        if not doc or doc.startswith(f"{one.value.__name__}("):  # which @dataclass makes
            yield f"{one.place}: has no docstring"
        if isinstance(one.value, type):
            told = _told(one.value)
            for name, line, module in _members(one.value):
                if name not in told and (place := (module.__name__, line, name)) not in seen:
                    seen.add(place)
                    yield (
                        f"{_relative(module)}:{line}: {one.path}.{name} is not described; "
                        "write a docstring below it, or make it private"
                    )


def speechless(names: dict[str, Public]) -> Iterator[str]:
    """Classes whose instances only show an address; those of services have no instances."""
    from aioros1 import Action, Service

    for one in names.values():
        cls = one.value
        if (
            isinstance(cls, type)
            and cls.__repr__ is object.__repr__
            and not issubclass(cls, Action | Service)
            and not getattr(cls, "_is_protocol", False)
        ):
            yield f"{one.place}: its repr tells only an address; give it one with name and state"


def _bases(cls: type) -> Iterator[tuple[type, ModuleType, ast.ClassDef]]:
    """The class and its bases, as far as they are written in the package of the class."""
    top = cls.__module__.partition(".")[0]
    for each in cls.__mro__:
        if each.__module__.partition(".")[0] != top:
            continue
        try:
            module, tree = _source(each)
        except (KeyError, TypeError):
            continue
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and node.name == each.__name__:
                yield each, module, node


def _members(cls: type) -> Iterator[tuple[str, int, ModuleType]]:
    """Public attributes and methods, each once, and where they are written."""
    seen = set[str]()
    for _, module, node in _bases(cls):
        for name, line, _ in _written(node, module):
            if not name.startswith("_") and name not in seen:
                seen.add(name)
                yield name, line, module


def _told(cls: type) -> set[str]:
    """The members that are described: there, in a base, or in the docstring of a class."""
    told = set[str]()
    for each in cls.__mro__:
        told.update(re.findall(r"``(\w+)``", each.__doc__ or ""))
    for _, module, node in _bases(cls):
        told.update(name for name, _, is_told in _written(node, module) if is_told)
    for name in dir(cls):
        member = inspect.getattr_static(cls, name)
        is_code = callable(member) or isinstance(member, property | classmethod | staticmethod)
        if is_code and inspect.getdoc(getattr(cls, name)):
            told.add(name)
    return told


def _written(node: ast.ClassDef, module: ModuleType) -> Iterator[tuple[str, int, bool]]:
    """Members in the order of the source; whether a description follows."""
    yield from _assigned(node.body, "")
    for statement in node.body:
        if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef):
            yield statement.name, statement.lineno, ast.get_docstring(statement) is not None
            if statement.name == "__init__":
                yield from _assigned(statement.body, "self")


def _assigned(body: list[ast.stmt], owner: str) -> Iterator[tuple[str, int, bool]]:
    for position, statement in enumerate(body):
        match statement:
            case ast.Assign(targets=targets):
                pass
            case ast.AnnAssign(target=target):
                targets = [target]
            case _:
                continue
        match body[position + 1 : position + 2]:
            case [ast.Expr(value=ast.Constant(value=str()))]:
                is_told = True
            case _:
                is_told = False
        for target in targets:
            for part in target.elts if isinstance(target, ast.Tuple) else [target]:
                match part:
                    case ast.Name(id=name) if not owner:
                        yield name, statement.lineno, is_told
                    case ast.Attribute(value=ast.Name(id=of), attr=name) if of == owner:
                        yield name, statement.lineno, is_told


# what signatures name


TYPES = [["msg"], ["srv"], ["action"]]
"""The packages from which users import the classes of types, which have no page each."""


def private_in_signatures(names: dict[str, Public]) -> Iterator[str]:
    """Classes that a user is handed, or has to hand over, and cannot import."""
    promised = {id(one.value) for one in names.values()}
    for one in names.values():
        if _module_of(one.value) is None:
            continue
        module, tree = _source(one.value)
        for node in tree.body:
            if _named(node) != one.value.__name__:
                continue
            for line, annotation in _annotations(node):
                for name in sorted(_words(annotation)):
                    found = _looked_up(name, module, tree)
                    if (
                        isinstance(found, type)
                        and found.__module__.partition(".")[0] == "aioros1"
                        and found.__module__.split(".")[1:2] not in TYPES
                        and id(found) not in promised
                    ):
                        yield (
                            f"{_relative(module)}:{line}: {one.path} has {name} in a signature, "
                            "which is not public; make it so, or name something that is"
                        )


def _annotations(node: ast.AST, depth: int = 0) -> Iterator[tuple[int, ast.expr]]:
    """Those of a function, or of the public members of a class."""
    match node:
        case ast.ClassDef(body=body) if depth == 0:
            for statement in body:
                if not _named(statement).startswith("_"):
                    yield from _annotations(statement, depth + 1)
        case ast.FunctionDef() | ast.AsyncFunctionDef():
            arguments = node.args
            for each in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs):
                if each.annotation is not None:
                    yield each.lineno, each.annotation
            if node.returns is not None:
                yield node.lineno, node.returns
        case ast.AnnAssign(annotation=annotation):
            yield node.lineno, annotation


def _words(annotation: ast.expr) -> set[str]:
    """The names in an annotation, in quotes too."""
    words = set[str]()
    for node in ast.walk(annotation):
        match node:
            case ast.Name(id=name):
                words.add(name)
            case ast.Constant(value=str(text)) if re.fullmatch(r"[\w.\[\], |]+", text):
                words.update(re.findall(r"[A-Za-z_]\w*", text))
    return words


@cache
def _imported(tree: ast.Module) -> dict[str, tuple[str, str]]:
    """Where the names are from that a module imports, for type checkers only, too."""
    return {
        alias.asname or alias.name: (node.module, alias.name)
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module
        for alias in node.names
    }


def _looked_up(name: str, module: ModuleType, tree: ast.Module) -> object:
    """What a name means in a module; nothing, if it is another word."""
    if name in vars(module):
        return vars(module)[name]
    if name in _imported(tree):
        source, original = _imported(tree)[name]
        if source.partition(".")[0] == "aioros1":
            return getattr(import_module(source), original, None)
    return None


# what stands above the node


def private_imports(modules: dict[str, Module], usable: dict[str, set[str]]) -> Iterator[str]:
    """Imports of what is not public, in packages that use what users use.

    ``usable`` has the public modules and the names in them.
    """
    for module in modules.values():
        if module.entry not in PUBLIC_ONLY:
            continue
        for one in module.imports:
            top, _, inside = one.target.partition(".")
            entry = inside.partition(".")[0]
            if top != "aioros1" or entry in (module.entry, *BUNDLED):
                continue
            if one.target in FOR_THE_WHOLE_PACKAGE:
                continue
            if one.target not in usable:
                yield (
                    f"{module.place(one.line)}: imports {one.target}, which is not public; "
                    "import public names from aioros1 or a public subpackage"
                )
                continue
            for name in one.names:
                if name not in usable[one.target]:
                    yield f"{module.place(one.line)}: {one.target}.{name} is not public"
        for node in ast.walk(module.tree):
            match node:
                case ast.Attribute(value=ast.Name(id="aioros1"), attr=name):
                    if name not in usable["aioros1"] and not any(
                        path == f"aioros1.{name}" or path.startswith(f"aioros1.{name}.")
                        for path in usable
                    ):
                        yield f"{module.place(node.lineno)}: aioros1.{name} is not public"


# sources


def _source(value: Any) -> tuple[ModuleType, ast.Module]:
    """The module in which something is written, and that module as it is written."""
    from aioros1._public import HOMES

    home = HOMES.get(f"{value.__module__}.{value.__qualname__}", value.__module__)
    return sys.modules[home], _tree(home)


@cache
def _tree(name: str) -> ast.Module:
    known = read_tree().get(name)
    if known is not None:
        return known.tree
    return ast.parse(Path(str(sys.modules[name].__file__)).read_text(encoding="utf-8"))


def _named(node: ast.AST) -> str:
    match node:
        case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
            return name
        case ast.ClassDef(name=name) | ast.AnnAssign(target=ast.Name(id=name)):
            return name
    return ""


def _relative(module: ModuleType) -> str:
    path = Path(str(module.__file__))
    # Temporary folders, with modules that are made up, may lie below the root as well.
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT / "aioros1") else path.name
