"""The commands put together; each noun has a module of its own."""

from __future__ import annotations

from cyclopts import App

from aioros1._version import __version__
from aioros1.cli.master import master

__all__ = ["make_app"]


def make_app() -> App:
    """The whole command line."""
    app = App(name="aioros1", help="ROS 1 without ROS.", version=__version__)
    app.command(master, name=["master", "core"])
    return app
