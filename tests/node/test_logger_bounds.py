"""Loggers that others create, which stay until the process ends."""

from __future__ import annotations

import logging
import secrets

import pytest

import aioros1
from aioros1.node import logger_services
from aioros1.srv.roscpp import SetLoggerLevel


async def test_others_can_create_few_loggers_with_short_names(make_node, monkeypatch, caplog):
    monkeypatch.setattr(logger_services, "_MOST_CREATED", 3)
    node, other = await make_node("node", logger_services=True), await make_node("other")
    await other.wait_for_service("/node/set_logger_level", timeout=30)
    top = node.log.logger.name
    tag = secrets.token_hex(4)  # loggers of other tests are still there
    before = len(logging.Logger.manager.loggerDict)

    async def set_level(logger: str) -> None:
        await other.call(
            "/node/set_logger_level", SetLoggerLevel, logger=logger, level="debug", timeout=30
        )

    with pytest.raises(aioros1.ServiceError, match="is not created"):
        await set_level(top + ".x" * 1_000)
    for number in range(3):
        await set_level(f"{top}.{tag}{number}")
    with pytest.raises(aioros1.ServiceError, match="is not created"):
        await set_level(f"{top}.{tag}_more")
    await set_level(f"{top}.{tag}0")
    await set_level(top)
    assert len(logging.Logger.manager.loggerDict) <= before + 3
    # What a caller does wrong is told to the caller, and is no failure of this node.
    assert not [record for record in caplog.records if record.levelname == "ERROR"]
