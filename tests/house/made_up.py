"""Small packages made up for tests of the rules."""

from __future__ import annotations

from pathlib import Path

from .tree import Module, read_tree

__all__ = ["tree_of"]


def tree_of(root: Path, **files: str) -> dict[str, Module]:
    """A package of made-up modules; ``net__hosts`` is ``aioros1/net/hosts.py``."""
    for name, text in {"__init__": "", **files}.items():
        path = root / "aioros1" / f"{name.replace('__', '/') if name[:2] != '__' else name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return read_tree(root)
