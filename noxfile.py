"""What is checked before a change lands: ``nox`` runs all of it, ``nox -s NAME`` a part."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import nox

PYTHONS = ["3.11", "3.12", "3.13"]

nox.needs_version = ">=2024.10.9"
nox.options.default_venv_backend = "uv|virtualenv"
nox.options.sessions = ["lint", "types", "tests", "docs", "package"]
nox.options.error_on_missing_interpreters = "CI" in os.environ


@nox.session
def lint(session: nox.Session) -> None:
    """Style, and mistakes that can be seen without running anything."""
    session.install("ruff>=0.8")
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")


@nox.session
def types(session: nox.Session) -> None:
    """Strict type checks, by two checkers."""
    session.install(".[cli,lint,test]")
    session.run("mypy")
    session.run("pyright")
    session.run("python", "-m", "pytest", "-q", "tests/typing")


@nox.session
def stubs(session: nox.Session) -> None:
    """Write the stubs of the bundled definitions anew; to be run when those were changed."""
    session.run("python", "-m", "aioros1.idl.stubs")


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """The tests, with asyncio's own loop and with uvloop."""
    session.install(".[test]")
    session.run("python", "-m", "pytest", *session.posargs)


@nox.session
def docs(session: nox.Session) -> None:
    """The documentation; a dangling reference is an error."""
    session.install(".[docs]")
    session.run("sphinx-build", "-q", "-n", "-W", "--keep-going", "docs", "docs/_build")


@nox.session
def package(session: nox.Session) -> None:
    """Build wheel and sdist, and use the wheel where nothing else is."""
    session.install("build")
    out = Path(session.create_tmp()).resolve() / "dist"
    shutil.rmtree(out, ignore_errors=True)
    session.run("python", "-m", "build", "--outdir", str(out), silent=True)
    (wheel,) = out.glob("*.whl")
    venv = out / "venv"
    session.run("python", "-m", "venv", str(venv))
    python = venv / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    session.run(str(python), "-m", "pip", "install", "-q", f"{wheel}[cli]", external=True)
    session.chdir(out)
    session.run(str(python), str(Path(__file__).parent / "tests" / "smoke.py"), external=True)


def python_of_ros() -> str | None:
    """The interpreter that has rospy: only with the same one the two can be compared."""
    debian = Path("/usr/bin/python3")
    return str(debian) if Path("/usr/lib/python3/dist-packages/rospy").exists() else None


@nox.session(python=python_of_ros())
def bench(session: nox.Session) -> None:
    """The benchmarks, beside the real programs: ``nox -s bench -- topics latency --runs 5``."""
    session.install(".[bench]")
    session.run("python", "benchmarks/run.py", *session.posargs)


@nox.session
def fuzz(session: nox.Session) -> None:
    """The inputs that fuzzing has left, and some new ones; ``nox -s fuzz -- --seconds 600``."""
    session.install(".[fuzz]")
    session.run("python", "-m", "pytest", "tests/test_fuzz_corpus.py")
    options = session.posargs or ["--seconds", "20", "--jobs", "2"]
    session.run("python", "fuzz/run.py", "all", *options)


@nox.session
def soak(session: nox.Session) -> None:
    """Bad things done to nodes and masters, often: ``nox -s soak -- [SCENARIO] --minutes 60``."""
    session.install(".[uvloop]")
    session.run("python", "soak/run.py", *session.posargs)
