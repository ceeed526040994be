"""The code in the README and in ``docs`` works.

A block of Python that runs an event loop itself (``asyncio.run``, ``aioros1.run``), or has
one in a thread, is a program: it is started as one, and has to end well. All other blocks of
a page are run one after the other, in one node, with the names of those before. A block
after the comment ``<!-- compiled only -->`` is not run.
"""

from __future__ import annotations

import ast
import asyncio
import dataclasses
import importlib
import inspect
import os
import re
import signal
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import CodeType

import pytest

import aioros1
from aioros1._public import HOMES

ROOT = Path(aioros1.__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
PATIENCE = 40.0

# The code does not depend on the loop, and this file is about the code.
one_loop = pytest.mark.asyncio(loop_factories=["asyncio"])

_BLOCK = re.compile(
    r"(?:<!-- (?P<mark>compiled only|pytest) -->\n)?^```python\n(?P<code>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
_PROGRAM = re.compile(r"^((asyncio|aioros1|uvloop)\.run|with NodeThread)\(", re.MULTILINE)


@dataclass(frozen=True)
class Block:
    page: Path
    line: int
    code: str
    mark: str | None

    @property
    def kind(self) -> str:
        """What is done with it: ``program``, ``fragment``, or what the mark says."""
        return self.mark or ("program" if _PROGRAM.search(self.code) else "fragment")

    @property
    def place(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"

    def compile(self) -> CodeType:
        """The code, with the lines of errors counted as in the page."""
        source = "\n" * self.line + self.code
        flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
        code: CodeType = compile(source, str(self.page), "exec", flags=flags)
        return code


def blocks_of(page: Path) -> list[Block]:
    text = page.read_text(encoding="utf-8")
    return [
        Block(page, text.count("\n", 0, match.start("code")), match["code"], match["mark"])
        for match in _BLOCK.finditer(text)
    ]


BLOCKS = [block for page in PAGES for block in blocks_of(page)]
PROGRAMS = [block for block in BLOCKS if block.kind == "program"]
TEST_FILES = [block for block in BLOCKS if block.kind == "pytest"]
FRAGMENTS = {
    page: fragments
    for page in PAGES
    if (fragments := [b for b in blocks_of(page) if b.kind == "fragment"])
}


def place(value: Block | Path) -> str:
    return value.place if isinstance(value, Block) else str(value.relative_to(ROOT))


def test_there_is_code_in_the_documentation():
    assert len(BLOCKS) > 20
    assert any(block.page.name == "README.md" for block in PROGRAMS)


@pytest.mark.parametrize("block", BLOCKS, ids=place)
def test_it_compiles(block):
    block.compile()


@one_loop
@pytest.mark.parametrize("page", FRAGMENTS, ids=place)
async def test_fragments_run(page, master, make_node, capsys):
    node = await make_node("docs", rosout=True)
    names = {
        "__name__": "docs",
        "aioros1": aioros1,
        "asyncio": asyncio,
        "master": master,
        "node": node,
    }
    for block in FRAGMENTS[page]:
        code = block.compile()
        async with asyncio.timeout(PATIENCE):
            # What such code is, depends on whether there is an await in it.
            result = eval(code, names)
            if inspect.iscoroutine(result):
                await result


@one_loop
@pytest.mark.skipif(os.name != "posix", reason="ends programs by signals")
@pytest.mark.parametrize("block", PROGRAMS, ids=place)
async def test_programs_run(block, master):
    environ = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
    environ |= {"PYTHONPATH": str(ROOT), "ROS_MASTER_URI": master.uri}
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-W", "error", "-c", block.code,
        env=environ, stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    try:
        if "aioros1.run(" in block.code:  # it runs until it is interrupted
            async with asyncio.timeout(PATIENCE), aioros1.Node("watch", master_uri=master.uri) as w:
                await w.graph.wait_for(lambda graph: "/chatter" in graph.topics)
            process.send_signal(signal.SIGINT)
        async with asyncio.timeout(PATIENCE):
            _, errors = await process.communicate()
    finally:
        if process.returncode is None:
            process.kill()
            await process.communicate()
    assert (process.returncode, errors.decode()) == (0, "")


@pytest.mark.parametrize("block", TEST_FILES, ids=place)
@pytest.mark.parametrize("mode", ["auto", "strict"])
def test_tests_pass(block, mode, pytester, monkeypatch):
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    pytester.makepyfile(block.code)
    result = pytester.runpytest_subprocess(
        *("-p", "pytest_asyncio.plugin", "-p", "aioros1.testing.pytest_plugin"),
        *(f"--asyncio-mode={mode}", "-W", "error", "--strict-markers"),
        *("-o", "asyncio_default_fixture_loop_scope=function"),
        timeout=PATIENCE,
    )
    result.assert_outcomes(passed=block.code.count("def test_"))


def test_commands_of_the_readme_set_everything_up():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for heading, last in (("Quick start", "examples/demo.py"), ("Tests", "-m pytest -n 4")):
        section = text.split(f"\n## {heading}\n")[1]
        command = section.split("```sh\n")[1].split("```")[0]
        assert command.startswith("python3 -m venv .venv && .venv/bin/pip install ")
        assert command.endswith(f".venv/bin/python {last}\n")
        assert command.count("\n") == 1


def test_the_page_on_security_has_every_limit_with_its_default():
    text = (ROOT / "docs" / "security.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \| (\S+) \|", text, re.MULTILINE))
    defaults = aioros1.Limits()
    assert rows == {
        field.name: f"{value:,}" if (value := getattr(defaults, field.name)) else "None"
        for field in dataclasses.fields(defaults)
    }


def test_links_between_pages_lead_somewhere():
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text):
            if "://" not in target:
                assert (page.parent / target).exists(), f"{place(page)}: {target}"


KINDS: dict[str, type] = {
    "node": aioros1.Node,
    "node.graph": aioros1.Graph,
    "node.master": aioros1.MasterProxy,
    "peer": aioros1.NodeProxy,
    "pub": aioros1.Publisher,
    "sub": aioros1.Subscriber,
    "provider": aioros1.ServiceProvider,
    "caller": aioros1.ServiceCaller,
    "psub": aioros1.ParamSubscriber,
    "store": aioros1.MessageStore,
    "master": aioros1.Master,
}
_MEMBER = re.compile(r"(?<![\w./])((?:node\.)?[a-z]+)\.([a-z_]\w*)")
_DOTTED = re.compile(r"(?<![\w./])aioros1((?:\.[A-Za-z]\w*)+)")


def is_member(kind: type, name: str) -> bool:
    """Whether instances have an attribute of that name, set in a constructor or not."""
    return hasattr(kind, name) or any(
        f"self.{name}" in ast.unparse(each)
        for cls in kind.__mro__
        if cls.__module__.startswith("aioros1")
        for each in _source(cls).body
        if isinstance(each, ast.ClassDef) and each.name == cls.__name__
    )


def _source(cls: type) -> ast.Module:
    """The module in which a class is written."""
    home = HOMES.get(f"{cls.__module__}.{cls.__qualname__}", cls.__module__)
    return ast.parse(inspect.getsource(sys.modules[home]))


FOLDERS = [ROOT, ROOT / "aioros1"]
"""Where the pages find files."""


def is_there(names: list[str]) -> bool:
    """Whether ``aioros1`` has something by that dotted name."""
    found: object = aioros1
    for depth, name in enumerate(names, start=1):
        if not hasattr(found, name):
            try:
                importlib.import_module(".".join(["aioros1", *names[:depth]]))
            except ImportError:
                return False
        found = getattr(found, name)
    return True


def wishes(page: Path) -> Iterator[str]:
    """What is named in a page and does not exist."""
    for code in re.findall(r"`([^`\n]+)`", page.read_text(encoding="utf-8")):
        if re.fullmatch(r"[\w/]+\.py", code):
            if not any((folder / code).exists() for folder in FOLDERS):
                yield code
            continue
        for owner, name in _MEMBER.findall(code):
            if owner in KINDS and not is_member(KINDS[owner], name):
                yield f"{owner}.{name}"
        for names in _DOTTED.findall(code):
            if not is_there(names.split(".")[1:]):
                yield f"aioros1{names}"


@pytest.mark.parametrize("page", PAGES, ids=place)
def test_what_is_named_exists(page):
    """The tables say what stands for something else, and must not name what is only wished."""
    assert not list(wishes(page))
