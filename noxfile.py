"""The checks of this project: ``nox`` runs the usual ones, ``nox -s NAME`` runs one."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nox
from packaging.requirements import Requirement

PYPROJECT: dict[str, Any] = nox.project.load_toml("pyproject.toml")
QUICK = ("-m", "not slow", "-n", "2", "-q")
"""What pytest is given to run the quick tests."""

PYTHONS = ["3.11", "3.12", "3.13"]

COVERED = {
    "lines": ("num_statements", "covered_lines", 87.0),
    "branches": ("num_branches", "covered_branches", 71.0),
}
"""The names of coverage.json for all and for those reached, and the least percentage of these."""

NOT_WITH_COVERAGE = ("tests/test_two_loops.py", "tests/idl/test_modules.py")
"""Tests that look for what must not happen, and find what coverage does: it takes locks in
threads with an event loop, and imports modules."""

LINTERS = ("codespell", "ruff")

nox.needs_version = ">=2024.10.9"
nox.options.default_venv_backend = "uv|virtualenv"
nox.options.sessions = ["lint", "types", "tests", "docs", "package"]
nox.options.error_on_missing_interpreters = "CI" in os.environ


def requirements(*extras: str) -> Iterator[Requirement]:
    """Yield what the package needs with ``extras``, those that an extra names included."""
    project = PYPROJECT["project"]
    texts = [text for extra in extras for text in project["optional-dependencies"][extra]]
    for requirement in map(Requirement, texts):
        if requirement.name == project["name"]:
            yield from requirements(*sorted(requirement.extras))
        else:
            yield requirement


@nox.session
def lint(session: nox.Session) -> None:
    """Check style and spelling; nothing is run."""
    session.install(*(str(tool) for tool in requirements("lint") if tool.name in LINTERS))
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")
    session.run("codespell")


@nox.session
def types(session: nox.Session) -> None:
    """Check types strictly, with mypy and with pyright."""
    session.install(".[cli,lint,test]")
    session.run("mypy")
    session.run("pyright")
    session.run("python", "-m", "pytest", "-q", "tests/typing")


@nox.session
def stubs(session: nox.Session) -> None:
    """Write the stubs of the bundled definitions again, after a change to them."""
    session.run("python", "-m", "aioros1.idl.stubs")


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """Run the whole suite, or what you name: ``nox -s tests-3.12 -- tests/topics``."""
    session.install(".[test]")
    session.run("python", "-m", "pytest", *session.posargs)


def lowest() -> Iterator[str]:
    """Yield a pin to its lowest version for every package that the tests need."""
    direct = map(Requirement, PYPROJECT["project"]["dependencies"])
    for requirement in (*direct, *requirements("test")):
        bounds = [bound.version for bound in requirement.specifier if bound.operator == ">="]
        if len(bounds) != 1:
            raise ValueError(f"pyproject.toml: expected one lower bound, got '{requirement}'")
        yield f"{requirement.name}=={bounds[0]}"


@nox.session(name="tests-lowest", python=PYTHONS[0])
def tests_lowest(session: nox.Session) -> None:
    """Run the quick tests with the lowest versions that pyproject.toml allows."""
    constraints = Path(session.create_tmp()).resolve() / "lowest.txt"
    constraints.write_text("\n".join(lowest()) + "\n", encoding="utf-8")
    session.install("-c", str(constraints), ".[test]")
    session.run("python", "-m", "pytest", *QUICK, *session.posargs)


@nox.session(python=PYTHONS[-1])
def coverage(session: nox.Session) -> None:
    """Measure what the quick tests reach, or the whole suite: ``nox -s coverage -- --whole``.

    Further arguments go to pytest. The floors hold for the quick tests, unless you name others.
    """
    session.install("-e", ".[coverage]")  # editable: one place for every file that is measured
    folder = Path(session.create_tmp()).resolve()
    for old in folder.glob("coverage*"):
        old.unlink()
    session.env["COVERAGE_FILE"] = str(folder / "coverage")
    options = [option for option in session.posargs if option != "--whole"]
    tests = QUICK[2:] if "--whole" in session.posargs else QUICK
    left_out = [f"--ignore={file}" for file in NOT_WITH_COVERAGE]
    session.run("coverage", "run", "-m", "pytest", *tests, *left_out, *options)
    session.run("coverage", "combine", "-q")
    session.run("coverage", "report", "--sort=cover")
    report = folder / "coverage.json"
    session.run("coverage", "json", "-q", "-o", str(report))
    totals = json.loads(report.read_text(encoding="utf-8"))["totals"]
    below = []
    for kind, (total, reached, floor) in COVERED.items():
        percent = 100 * totals[reached] / totals[total]
        session.log(f"{kind}: {percent:.2f} %, at least {floor} %")
        if percent < floor:
            below.append(f"{kind}: {percent:.2f} % are reached, expected at least {floor} %")
    if below and not options:
        session.error("; ".join(below))


@nox.session
def docs(session: nox.Session) -> None:
    """Build the documentation; a reference that leads nowhere is an error."""
    session.install(".[docs]")
    session.run("sphinx-build", "-q", "-n", "-W", "--keep-going", "docs", "docs/_build")


@nox.session
def package(session: nox.Session) -> None:
    """Build the wheel and the sdist, and use the wheel in an empty environment."""
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
    """Return the interpreter that has rospy; the two are compared on the same one."""
    debian = Path("/usr/bin/python3")
    return str(debian) if Path("/usr/lib/python3/dist-packages/rospy").exists() else None


@nox.session(python=python_of_ros())
def bench(session: nox.Session) -> None:
    """Run the benchmarks beside the real programs: ``nox -s bench -- topics latency --runs 5``."""
    session.install(".[bench]")
    session.run("python", "benchmarks/run.py", *session.posargs)


@nox.session
def fuzz(session: nox.Session) -> None:
    """Run the inputs that fuzzing found, then new ones: ``nox -s fuzz -- --seconds 600``."""
    session.install(".[fuzz]")
    session.run("python", "-m", "pytest", "tests/test_fuzz_corpus.py")
    options = session.posargs or ["--seconds", "20", "--jobs", "2"]
    session.run("python", "fuzz/run.py", "all", *options)


@nox.session
def soak(session: nox.Session) -> None:
    """Disturb nodes and masters for a long time: ``nox -s soak -- [SCENARIO] --minutes 60``."""
    session.install(".[uvloop]")
    session.run("python", "soak/run.py", *session.posargs)
