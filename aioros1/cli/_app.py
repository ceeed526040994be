"""The commands put together; each noun has a module of its own."""

from __future__ import annotations

from cyclopts import App

from aioros1._version import __version__
from aioros1.cli.definitions import KINDS, make_noun
from aioros1.cli.master import master
from aioros1.cli.stubs import stubs

__all__ = ["make_app"]


def make_app() -> App:
    """The whole command line."""
    app = App(name="aioros1", help="ROS 1 without ROS.", version=__version__)
    app.command(master, name=["master", "core"])
    for kind in KINDS:
        app.command(make_noun(kind))
    app.command(stubs)
    app.register_install_completion_command()
    return app
