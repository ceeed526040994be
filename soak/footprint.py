"""What a process holds: tasks, file descriptors, threads, objects, memory."""

from __future__ import annotations

import asyncio
import ctypes
import gc
import os
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Self

__all__ = ["Footprint"]

OBJECTS = 2_000
"""More objects than before that say nothing: caches that fill up, whatever is done how often."""

MEMORY = 16 << 20
"""The same in bytes: what the allocator keeps."""


@dataclass(frozen=True)
class Footprint:
    """Of this process, at one moment."""

    tasks: int
    fds: int
    threads: int
    objects: int
    memory: int

    @classmethod
    async def take(cls, settled: float = 0.2) -> Self:
        """Once what was closed has had ``settled`` seconds to be gone."""
        await asyncio.sleep(settled)
        for _ in range(3):
            gc.collect()
            await asyncio.sleep(0)
        return cls(
            tasks=len(asyncio.all_tasks()),
            fds=len(os.listdir("/proc/self/fd")),
            threads=threading.active_count(),
            objects=len(gc.get_objects()),
            memory=_memory(),
        )

    def problems_since(self, before: Footprint, *, kept: int = 0) -> list[str]:
        """What there is more of than before. ``kept`` descriptors may be of connections that
        are idle, and kept for a while."""
        grown = {
            "tasks": (self.tasks - before.tasks, 0),
            "file descriptors": (self.fds - before.fds, kept),
            "threads": (self.threads - before.threads, 0),
            "objects": (self.objects - before.objects, OBJECTS),
            "bytes of memory": (self.memory - before.memory, MEMORY),
        }
        return [
            f"left behind: {more:,} {what}" for what, (more, most) in grown.items() if more > most
        ]

    def text_since(self, before: Footprint) -> str:
        more = (self.tasks - before.tasks, self.fds - before.fds, self.threads - before.threads)
        return (
            "{:+} tasks, {:+} descriptors, {:+} threads, ".format(*more)
            + f"{self.objects - before.objects:+,} objects, "
            + f"{(self.memory - before.memory) / 1e6:+.1f} MB"
        )


def _memory() -> int:
    """What is in use, without what the allocator of C keeps for later, where it can be told."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # glibc has it
    if trim is not None:
        trim(0)
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")
