"""The ``aioros1`` command. It needs the extra ``cli``; the library does not."""

from __future__ import annotations

import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> None:
    """Run the command line ``argv`` (``sys.argv`` without the program by default).

    Ends with :class:`SystemExit`: 0 for success, 1 for failure, 2 without the extra.
    """
    try:
        import cyclopts  # noqa: F401
        import rich  # noqa: F401
    except ImportError as error:
        print(
            f'the aioros1 command needs {error.name}: pip install "aioros1[cli]"', file=sys.stderr
        )
        raise SystemExit(2) from None
    from aioros1.cli._app import make_app

    make_app()(list(sys.argv[1:] if argv is None else argv))
