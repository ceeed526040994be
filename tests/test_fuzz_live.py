"""An attack over real sockets, a short one: ``fuzz/run.py live`` does the same at length."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import pytest

import aioros1
from aioros1.master.api import MasterApi
from aioros1.node.slave_api import SlaveApi

sys.path.append(str(Path(__file__).parents[1]))

from fuzz import http_attack, live
from fuzz.live import Finding, attack

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")


@pytest.mark.parametrize("only", ["http", "tcpros"])
async def test_nothing_is_found(only: str) -> None:
    report = await attack(600, seed=1, only=only)
    other = {"http": "tcpros", "tcpros": "http"}[only]
    assert report.counts[f"{only} sent"] >= 600
    assert report.counts[f"{only} answered"] > 100
    assert report.counts[f"{only} refused"] > 0
    assert report.counts[f"{other} sent"] == 0
    assert report.healthy["messages"] > 0
    assert f"{only}: {report.counts[f'{only} sent']:,} sent" in str(report)


# What is the use of an attack that finds nothing, whatever there is?


async def test_an_exception_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    right = SlaveApi.request_topic

    def wrong(self: Any, caller_id: Any, topic: Any, protocols: Any) -> Any:
        protocols[0][0].upper()
        return right(self, caller_id, topic, protocols)

    monkeypatch.setattr(SlaveApi, "request_topic", wrong)
    with pytest.raises(Finding, match=r"fault -32500|requestTopic failed"):
        await attack(2000, seed=1, only="http")


async def test_a_parameter_that_is_lost_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    right = MasterApi._set_param

    def wrong(self: Any, caller_id: str, key: str, value: Any) -> Any:
        if caller_id.startswith("/fuzzer"):
            right(self, caller_id, "/healthy/param", value)
        return right(self, caller_id, key, value)

    monkeypatch.setattr(MasterApi, "_set_param", wrong)
    with pytest.raises(Finding):
        await attack(2000, seed=1, only="http")


async def test_what_is_left_behind_is_found(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    left: list[aioros1.Node] = []
    right = live._World.live_once

    async def wrong(self: Any) -> None:
        if len(left) < 1:
            left.append(aioros1.Node("left", master_uri=self.master.uri, host="127.0.0.1"))
            await left[0].start()
        await right(self)

    monkeypatch.setattr(live._World, "live_once", wrong)
    monkeypatch.setattr(live, "SETTLE", 0.5)
    try:
        with pytest.raises(Finding, match=r"left behind: .*descriptors"):
            await attack(50, seed=1, only="http", findings=tmp_path)
    finally:
        await left[0].close()
    (folder,) = os.listdir(tmp_path)
    assert folder.startswith("live-")


async def test_memory_that_grows_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[list[Any]] = []
    right = SlaveApi.get_uri

    def wrong(self: Any, caller_id: Any) -> Any:
        kept.extend([] for _ in range(5000))
        return right(self, caller_id)

    monkeypatch.setattr(SlaveApi, "get_uri", wrong)
    with pytest.raises(Finding, match="memory"):
        await attack(600, seed=1, only="http")


@pytest.mark.parametrize(
    "octets",
    [
        b"HTTP/1.1 200\r\n\r\n",
        b"HTTP/1.1 200 OK\r\nno colon\r\n\r\n",
        b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\n\r\n",
        b"HTTP/1.1 200 OK\r\nContent-Length: 1\r\n\r\nx",
        b"HTTP/1.1 200 OK\r\nContent-Length: 1\r\nContent-Length: 1\r\n\r\nx",
    ],
)
def test_what_is_not_an_answer_is_refused(octets: bytes) -> None:
    connection = http_attack._Connection()
    connection.data_received(octets)
    assert isinstance(connection.failure, AssertionError)
