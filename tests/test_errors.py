"""Errors of the library travel: between processes, and as copies."""

from __future__ import annotations

import copy
import pickle

import pytest

import aioros1

ERRORS = [
    aioros1.RosError("text"),
    aioros1.InvalidNameError("text"),
    aioros1.MessageSpecError("text", path="a.msg", line=3),
    aioros1.MessageNotFoundError("text", ["/a"]),
    aioros1.SerializationError("text"),
    aioros1.DeserializationError("text"),
    aioros1.Md5MismatchError("text"),
    aioros1.MasterError(-1, "text"),
    aioros1.MasterUnreachable("text", advice="what", was_sent=False),
    aioros1.NodeNotFound(-1, "text"),
    aioros1.PeerError(0, "text"),
    aioros1.PeerUnreachable("text"),
    aioros1.HandshakeError("peer", "text"),
    aioros1.ServiceError("text\nand more"),
    aioros1.ServiceNotFound("text"),
    aioros1.ServiceUnavailable("text"),
    aioros1.ClosedError("text"),
]


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize(
    "way",
    [copy.copy, copy.deepcopy, lambda error: pickle.loads(pickle.dumps(error))],
    ids=["copy", "deepcopy", "pickle"],
)
def test_errors_can_be_copied(error, way):
    other = way(error)
    assert type(other) is type(error)
    assert str(other) == str(error)
    assert vars(other) == vars(error)
