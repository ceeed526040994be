"""MD5 sums and full texts of definitions, as genmsg makes them.

In all of these ``lookup`` is a function that takes ``pkg/Type`` and gives its spec.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from typing import TypeAlias

from aioros1._public import public
from aioros1.errors import MessageSpecError
from aioros1.idl.spec import MessageSpec, ServiceSpec

__all__ = ["Lookup", "closure", "full_text", "md5_text", "md5sum", "split_full_text"]

Lookup: TypeAlias = Callable[[str], MessageSpec]

_RULE = "=" * 80


@public("aioros1.idl")
def md5_text(spec: MessageSpec, lookup: Lookup, known: dict[str, str] | None = None) -> str:
    """The text whose hash is the MD5 sum of a message.

    Constants come first, then fields; MD5 sums stand in place of the types of messages.
    ``known`` keeps the sums of dependencies for the next call; it is changed in place.
    """
    known = {} if known is None else known
    lines = [f"{c.type} {c.name}={c.text}" for c in spec.constants]
    for field in spec.fields:
        if field.is_builtin:
            lines.append(f"{field.type} {field.name}")
            continue
        base = field.base_type
        if base not in known:
            known[base] = _hash(md5_text(lookup(base), lookup, known))
        lines.append(f"{known[base]} {field.name}")
    return "\n".join(lines).strip()


@public("aioros1.idl")
def md5sum(
    spec: MessageSpec | ServiceSpec, lookup: Lookup, known: dict[str, str] | None = None
) -> str:
    """The MD5 sum of a definition, as connection headers have it."""
    known = {} if known is None else known
    if isinstance(spec, ServiceSpec):
        return _hash(md5_text(spec.request, lookup, known) + md5_text(spec.response, lookup, known))
    return _hash(md5_text(spec, lookup, known))


def _hash(text: str) -> str:
    data = text.encode("utf-8", "surrogateescape")
    return hashlib.md5(data, usedforsecurity=False).hexdigest()


def closure(spec: MessageSpec | ServiceSpec, lookup: Lookup) -> list[str]:
    """All types that the definition needs, each behind the first one that needs it."""
    found: dict[str, None] = {}

    def visit(message: MessageSpec) -> None:
        for name in message.dependencies:
            if name not in found:
                found[name] = None
                visit(lookup(name))

    if isinstance(spec, ServiceSpec):
        # As in genmsg, the full text of a service has the types of both messages.
        visit(spec.request)
        visit(spec.response)
    else:
        visit(spec)
    return list(found)


@public("aioros1.idl")
def full_text(spec: MessageSpec | ServiceSpec, lookup: Lookup) -> str:
    """The text of a definition and of all types it needs, as in ``message_definition``."""
    parts = [spec.text]
    parts += [f"{_RULE}\nMSG: {name}\n{lookup(name).text}" for name in closure(spec, lookup)]
    return "\n".join(parts)


def split_full_text(type: str, text: str) -> dict[str, str]:
    """The texts that :func:`full_text` has joined, by type; ``type`` is the type of the first.

    The texts come from all kinds of programs, so this is lenient: any line of equals signs
    that is followed by a line ``MSG: pkg/Type`` separates two texts.
    """
    lines = text.split("\n")
    texts: dict[str, str] = {}
    name, start = type, 0
    for number, line in enumerate(lines):
        follower = lines[number + 1].strip() if number + 1 < len(lines) else ""
        if line.startswith("=====") and not line.strip("=\r \t") and follower.startswith("MSG:"):
            texts.setdefault(name, "\n".join(lines[start:number]))
            name, start = follower[4:].strip(), number + 2
            if "/" not in name:
                raise MessageSpecError(
                    f"expected 'MSG: package/Type', got {follower!r}", path=type, line=number + 2
                )
    texts.setdefault(name, "\n".join(lines[start:]))
    return texts
