"""The services of all packages that have definitions.

::

    from aioros1.srv.std_srvs import SetBool

The modules are made at run time; see :mod:`aioros1.idl.modules`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from aioros1.idl.modules import install_finder, package_module, package_names

__all__: list[str] = []

install_finder()

if not TYPE_CHECKING:  # checkers read the stubs; with this they would accept any name

    def __getattr__(name: str) -> object:
        return package_module(__name__, name)


def __dir__() -> list[str]:
    return package_names("srv")
