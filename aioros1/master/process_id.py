"""What a master answers to getPid.

Some clients ask for nothing else to find out whether their master was restarted, cROS among
them. So the answer has to differ from that of the master that was there before, although the
process may be the same, or have the same id in the next container.
"""

from __future__ import annotations

import os
import random
from collections import Counter

__all__ = ["process_id"]

_BITS = 22
"""No process id of Linux has more. What distinguishes masters is above them."""

_RUNS = 1 << (31 - _BITS)
"""As many fit into an int of XML-RPC."""

_IN_CONTAINERS = 300
"""Linux gives lower ids only to what it starts at boot, or to the processes of a container."""

_masters: Counter[int] = Counter()  # of this process, by port


def process_id(port: int, *, is_free: bool) -> int:
    """The process id, unless a client could take the master for the one before it.

    That is so if this process had a master at ``port`` before, or if it is one of a
    container; not if the system chose the port because it ``is_free``. The answer then has
    the process id only in its lowest 22 bits.
    """
    pid = os.getpid()
    run = _masters[port] % _RUNS
    _masters[port] += 1
    if is_free:
        run = 0
    elif not run and pid < _IN_CONTAINERS:
        run = random.randrange(1, _RUNS)
    return (run << _BITS | pid) & 0x7FFFFFFF
