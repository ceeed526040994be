"""``aioros1 stubs``: what type checkers and editors are to know of your own messages."""

from __future__ import annotations

import sys
from os.path import abspath
from pathlib import Path, PurePosixPath
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
    from aioros1.errors import MessageNotFoundError
    from aioros1.idl.store import standard_store
    from aioros1.idl.stubs import Stubs, write_stubs

    store = standard_store(map(abspath, path))
    writer = Stubs(store, "importer")
    files: dict[PurePosixPath, str] = {}
    packages = dict.fromkeys([package, *more])
    for name in packages:
        found = writer.files(name)
        if not found:
            places = ", ".join(store.places())
            raise MessageNotFoundError(f"no definitions of a package {name!r}; searched: {places}")
        files |= found
    for written in write_stubs(files, output):
        print(written)
    missing = sorted(writer.referred.difference(packages))
    if missing:
        print(
            f"aioros1 stubs: these refer to {', '.join(missing)}: stubs of "
            f"{'that' if len(missing) == 1 else 'those'} are needed, too",
            file=sys.stderr,
        )
