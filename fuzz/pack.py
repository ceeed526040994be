"""The kept inputs: one archive for each target, in ``corpus/``, the same for the same inputs."""

from __future__ import annotations

import io
import lzma
import tarfile
from collections.abc import Iterable
from hashlib import sha1
from pathlib import Path

__all__ = ["CORPUS", "TARGETS", "load", "save"]

CORPUS = Path(__file__).parent / "corpus"

TARGETS = (
    *("decode", "values", "header", "frames", "service", "http", "xmlrpc"),
    *("definition", "full_definition"),
)


def load(target: str) -> list[bytes]:
    """The inputs of a target, the shortest first; none if none were kept yet."""
    path = CORPUS / f"{target}.tar.xz"
    if not path.exists():
        return []
    with tarfile.open(path) as archive:
        members = (archive.extractfile(member) for member in archive.getmembers())
        return [member.read() for member in members if member is not None]


def save(target: str, inputs: Iterable[bytes]) -> Path:
    """Keep these inputs, in place of those that were kept before."""
    CORPUS.mkdir(exist_ok=True)
    plain = io.BytesIO()
    with tarfile.open(fileobj=plain, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for data in sorted(set(inputs), key=lambda data: (len(data), data)):
            member = tarfile.TarInfo(sha1(data, usedforsecurity=False).hexdigest()[:16])
            member.size = len(data)
            archive.addfile(member, io.BytesIO(data))
    path = CORPUS / f"{target}.tar.xz"
    path.write_bytes(lzma.compress(plain.getvalue(), preset=9 | lzma.PRESET_EXTREME))
    return path
