"""A node in an application of Starlette."""

from __future__ import annotations

import contextlib
import subprocess
import sys
from pathlib import Path

import pytest
from starlette.applications import Starlette

import aioros1
from aioros1.contrib.starlette import node_lifespan

ROOT = Path(aioros1.__file__).parents[1]


def running(app: Starlette):
    """The application's lifespan, which gives what ``request.state`` has."""
    return app.router.lifespan_context(app)


@pytest.fixture
def options(master):
    return {"master_uri": master.uri, "host": "localhost", "rosout": False}


async def test_a_node_starts_and_ends_with_the_application(options):
    app = Starlette(lifespan=node_lifespan("web", **options))
    async with running(app) as state:
        node = state["node"]
        assert node is app.state.node
        assert (node.name, node.is_open) == ("/web", True)
    assert node.state == "closed"


async def test_the_applications_own_lifespan_runs_inside(options):
    ended = []

    @contextlib.asynccontextmanager
    async def own(app):
        async with app.state.node.advertise("chatter", "std_msgs/String") as pub:
            yield {"publisher": pub}
            ended.append(app.state.node.is_open)

    app = Starlette(lifespan=node_lifespan("web", inner=own, **options))
    async with running(app) as state:
        assert set(state) == {"node", "publisher"}
        state["publisher"].publish(data="hello")
    assert ended == [True]


async def test_two_nodes(options):
    second = node_lifespan("two", key="two", **options)
    app = Starlette(lifespan=node_lifespan("one", inner=second, key="one", **options))
    async with running(app) as state:
        assert {key: node.name for key, node in state.items()} == {"one": "/one", "two": "/two"}
        assert (app.state.one, app.state.two) == (state["one"], state["two"])


async def test_a_lifespan_that_yields_nothing(options):
    @contextlib.asynccontextmanager
    async def own(app):
        yield

    app = Starlette(lifespan=node_lifespan("web", inner=own, **options))
    async with running(app) as state:
        assert set(state) == {"node"}


async def test_what_would_hide_the_node_is_refused(options):
    app = Starlette(lifespan=node_lifespan("web", inner=node_lifespan("two", **options), **options))
    with pytest.raises(ValueError, match="yields 'node', which is the node 'web'"):
        async with running(app):
            pass
    assert not app.state.node.is_open


async def test_an_error_inside_closes_the_node_and_goes_on(options):
    app = Starlette(lifespan=node_lifespan("web", **options))
    with pytest.raises(LookupError, match="shutdown"):
        async with running(app):
            raise LookupError("shutdown")
    assert not app.state.node.is_open


def test_it_imports_no_framework():
    code = (
        "import sys, aioros1.contrib.starlette, aioros1.contrib.threads;"
        "print([name for name in ('starlette', 'anyio', 'fastapi') if name in sys.modules])"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=True
    )
    assert result.stdout.strip() == "[]"
