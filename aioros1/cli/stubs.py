"""``aioros1 stubs``: what type checkers and editors are to know of your own messages."""

from __future__ import annotations

import sys
from os.path import abspath
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from aioros1.cli.definitions import Paths

__all__ = ["stubs"]


def stubs(
    package: str,
    /,
    *more: str,
    output: Annotated[Path, Parameter(name=["--output", "-o"])],
    path: Paths = (),
) -> None:
    """Write stubs of the types of packages: for type checkers and editors, as pkg.msg and pkg.srv.

    Parameters
    ----------
    package
        A package with definitions.
    more
        Further packages.
    output
        The directory to write into. It is made if need be; what is there and was not made
        by this command is never replaced.
    """
    # Imported here: the help needs none of it.
    from aioros1.idl import standard_store, write_package_stubs

    store = standard_store(map(abspath, path))
    written, missing = write_package_stubs(store, [package, *more], output)
    for each in written:
        print(each)
    if missing:
        print(
            f"aioros1 stubs: these refer to {', '.join(missing)}: stubs of "
            f"{'that' if len(missing) == 1 else 'those'} are needed, too",
            file=sys.stderr,
        )
