"""The ``aioros1`` command. It needs the extra ``cli``; the library does not."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Sequence
from importlib.util import find_spec

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> None:
    """Run the command line ``argv`` (``sys.argv`` without the program by default).

    Ends with :class:`SystemExit`: 0 for success, 1 for failure, 2 for wrong usage or
    without the extra. What went wrong is said on standard error.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    if words[:1] in (["master"], ["core"]) and all(map(find_spec, ("cyclopts", "rich"))):
        from aioros1.cli.serve import plain_options, run

        # Others wait for a master, and importing what reads words takes as long as the rest.
        if (options := plain_options(words[1:])) is not None:
            raise SystemExit(run(**options))
    try:
        import cyclopts
        import rich  # noqa: F401
    except ImportError as error:
        print(
            f'the aioros1 command needs {error.name}: pip install "aioros1[cli]"', file=sys.stderr
        )
        raise SystemExit(2) from None
    from aioros1 import RosError
    from aioros1.cli._app import make_app

    if isinstance(sys.stdout, io.TextIOWrapper):
        # A character that the terminal does not have must not be the end of the output.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        try:
            make_app()(words, exit_on_error=False)
        finally:
            sys.stdout.flush()
    except cyclopts.CycloptsError:  # which has been printed
        raise SystemExit(2) from None
    except BrokenPipeError:
        # Who was reading has seen enough. Nothing is left for the interpreter to flush.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise SystemExit(1) from None
    except (RosError, OSError) as error:
        print(f"aioros1: {error}", file=sys.stderr)
        raise SystemExit(1) from None
