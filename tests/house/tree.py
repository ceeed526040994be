"""The modules of a package as they are written, for rules about them. Nothing is imported."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

__all__ = ["GENERATED", "ROOT", "Import", "Module", "read_tree", "strongly_connected"]

ROOT = Path(__file__).parents[2]

GENERATED = ("msg", "srv", "action")
"""Packages whose subfolders hold generated stubs."""


@dataclass(frozen=True)
class Import:
    """One module that another one imports, at any level and for whatever purpose."""

    target: str
    """The module: ``aioros1.idl.store`` both for ``from aioros1.idl.store import MessageStore``
    and for ``from aioros1.idl import store``."""
    line: int
    names: tuple[str, ...] = ()
    """What ``from target import ...`` takes out of it."""


@dataclass(frozen=True)
class Module:
    """One file of the package."""

    name: str
    path: Path
    root: Path
    tree: ast.Module = field(repr=False, compare=False)
    imports: tuple[Import, ...] = field(repr=False, compare=False)

    @property
    def entry(self) -> str:
        """The folder or the single module at the top of the package; empty for the package."""
        return self.name.partition(".")[2].partition(".")[0]

    def place(self, line: int) -> str:
        return f"{self.path.relative_to(self.root)}:{line}"


@cache
def read_tree(root: Path = ROOT, package: str = "aioros1") -> dict[str, Module]:
    """All modules of ``root/package`` by name, without the generated stubs.

    A stub beside a module counts as part of it; a stub alone is a module.
    """
    found: dict[str, tuple[Path, ast.Module, list[ast.Module]]] = {}
    files = [*(root / package).rglob("*.py"), *(root / package).rglob("*.pyi")]
    for path in sorted(files, key=lambda path: (path.suffix, path)):
        parts = path.relative_to(root).with_suffix("").parts
        if path.suffix == ".pyi" and len(parts) > 2 and parts[1] in GENERATED:
            continue
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        tree = ast.parse(path.read_text(encoding="utf-8"), str(path))
        if name in found:
            found[name][2].append(tree)
        else:
            found[name] = (path, tree, [tree])
    return {
        name: Module(
            name,
            path,
            root,
            tree,
            tuple(one for part in trees for one in _imports(part, set(found), path, root)),
        )
        for name, (path, tree, trees) in found.items()
    }


def _imports(tree: ast.Module, known: set[str], path: Path, root: Path) -> Iterator[Import]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield Import(alias.name, node.lineno)
        elif isinstance(node, ast.ImportFrom):
            source = node.module or ""
            if node.level:
                parts = path.relative_to(root).parts[: -node.level]
                source = ".".join((*parts, source)).rstrip(".")
            names = []
            for alias in node.names:
                if f"{source}.{alias.name}" in known:
                    yield Import(f"{source}.{alias.name}", node.lineno)
                else:
                    names.append(alias.name)
            if names:
                yield Import(source, node.lineno, tuple(names))
        elif isinstance(node, ast.Call) and _called(node) in ("import_module", "__import__"):
            match node.args:
                case [ast.Constant(value=str(target)), *_]:
                    yield Import(target, node.lineno)


def _called(node: ast.Call) -> str:
    match node.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
    return ""


def strongly_connected(edges: dict[str, set[str]]) -> list[tuple[set[str], list[str]]]:
    """The groups of nodes that reach each other, and the shortest circle in each."""
    reach = {node: _reachable(node, edges) for node in edges}
    circles, seen = [], set[str]()
    for node in sorted(edges):
        if node in seen or node not in reach[node]:
            continue
        group = {other for other in reach[node] if node in reach.get(other, ())}
        seen |= group
        circles.append((group, min((_circle(one, edges) for one in sorted(group)), key=len)))
    return circles


def _reachable(start: str, edges: dict[str, set[str]]) -> set[str]:
    found: set[str] = set()
    waiting = [*edges[start]]
    while waiting:
        node = waiting.pop()
        if node not in found:
            found.add(node)
            waiting += edges.get(node, ())
    return found


def _circle(start: str, edges: dict[str, set[str]]) -> list[str]:
    """The shortest way from ``start`` back to it."""
    ways = [[start]]
    seen: set[str] = set()
    for way in ways:  # grows while it is read: breadth first
        for node in sorted(edges.get(way[-1], ())):
            if node == start:
                return [*way, start]
            if node not in seen:
                seen.add(node)
                ways.append([*way, node])
    raise ValueError(f"{start} is on no circle")
