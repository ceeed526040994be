"""Run a fuzz target, or all of them: ``python fuzz/run.py TARGET [--runs N | --seconds S]``.

Without a number it goes on until it finds something. What libFuzzer keeps on the way lies
in ``fuzz/work/TARGET``, beside the log of each process; what it finds in ``fuzz/findings``.
``--pack`` afterwards minimises the former into ``fuzz/corpus``. Options of libFuzzer can
be given behind ``--``.
"""

from __future__ import annotations

import argparse
import importlib
import pkgutil
import platform
import re
import secrets
import shlex
import shutil
import subprocess
import sys
import time
import warnings
from collections import deque
from functools import cache
from hashlib import sha1
from pathlib import Path
from typing import Any

HERE = Path(__file__).absolute().parent
# The folder of this script must not be searched: modules in it have names of others.
sys.path[:1] = [str(HERE.parent)]

from fuzz.pack import TARGETS, load, save  # noqa: E402 - found once the path is right

WORK = HERE / "work"
FINDINGS = HERE / "findings"
SEEN = ["aioros1.idl", "aioros1.wire", "aioros1.net.service_link"]
"""What libFuzzer sees the branches of."""
HISTORY = 200
"""Inputs before the one that failed that are kept with it: decoders have a memory."""


def module(target: str) -> Any:
    return importlib.import_module(f"fuzz.{target}")


# -- the process that fuzzes -----------------------------------------------------------


def instrument(target: str) -> None:
    """Let libFuzzer see the branches of the library, and of the codecs it generates."""
    import atheris

    with atheris.instrument_imports(include=SEEN):
        for layer in ("idl", "wire"):
            package = importlib.import_module(f"aioros1.{layer}")
            for found in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
                importlib.import_module(found.name)
        if target == "service":
            importlib.import_module("aioros1.net.service_link")
    if "definition" in target:
        return  # each input has classes of its own, and counters are never given back

    # Once for each source: decoders are made again, and must not look new each time.
    @cache
    def instrumented(*args: Any) -> Any:
        return atheris.patch_code(compile(*args), True)

    for name, loaded in list(sys.modules.items()):
        if name.startswith("aioros1.idl"):
            loaded.compile = instrumented  # type: ignore[attr-defined]


def work(target: str, flags: list[str]) -> None:
    """Fuzz in this process, which libFuzzer ends."""
    import atheris

    instrument(target)
    check = module(target).check
    warnings.simplefilter("error")
    recent: deque[bytes] = deque(maxlen=HISTORY)

    def test(data: bytes) -> None:
        recent.append(data)
        try:
            check(data)
        except Exception:
            keep_history(target, list(recent))
            raise

    atheris.Setup([str(WORK / f"{target}.sh"), *flags], test)
    atheris.Fuzz()


def keep_history(target: str, inputs: list[bytes]) -> None:
    folder = FINDINGS / f"{target}-{sha1(inputs[-1], usedforsecurity=False).hexdigest()[:12]}"
    folder.mkdir(parents=True, exist_ok=True)
    for number, data in enumerate(inputs):
        (folder / f"{number:03}").write_bytes(data)
    print(f"the inputs before, and this one: {folder}", file=sys.stderr)


def replay(target: str, paths: list[Path]) -> None:
    """Check the inputs in these files or folders, one after the other, without atheris."""
    check = module(target).check
    nested = [sorted(path.iterdir()) if path.is_dir() else [path] for path in paths]
    files = [file for files in nested for file in files]
    for file in files:
        check(file.read_bytes())
    print(f"{len(files)} inputs, all well")


# -- the process that looks after it ---------------------------------------------------


def prepare(target: str) -> Path:
    """The folder to fuzz in: what was kept, what is there already, and the seeds."""
    folder = WORK / target
    folder.mkdir(parents=True, exist_ok=True)
    FINDINGS.mkdir(exist_ok=True)
    for data in [*load(target), *module(target).seeds()]:
        (folder / sha1(data, usedforsecurity=False).hexdigest()).write_bytes(data)
    tokens = ["".join(f"\\x{octet:02x}" for octet in token) for token in module(target).TOKENS]
    # Not empty, even without any: libFuzzer would take it for missing.
    lines = ["# words of this format", *(f'"{token}"' for token in tokens), ""]
    (WORK / f"{target}.dict").write_text("\n".join(lines))
    # What libFuzzer calls to start itself again, which it does to minimise.
    script = WORK / f"{target}.sh"
    script.write_text(f'#!/bin/sh\nexec {shlex.join(command_of(target))} "$@"\n')
    script.chmod(0o755)
    return folder


def command_of(target: str) -> list[str]:
    return [sys.executable, str(HERE / "run.py"), target, "--work", "--"]


def start(target: str, log: Path, flags: list[str]) -> subprocess.Popen[bytes]:
    command = [*command_of(target), *flags]
    with log.open("wb") as output:
        return subprocess.Popen(command, stdout=output, stderr=output, cwd=HERE.parent)


def flags_of(target: str) -> list[str]:
    return [
        f"-max_len={module(target).MAX_LEN}",
        f"-dict={WORK / target}.dict",
        f"-artifact_prefix={FINDINGS}/{target}-",
        "-timeout=20",
        "-rss_limit_mb=2048",
        "-print_final_stats=1",
    ]


def fuzz(target: str, runs: int, seconds: int, jobs: int, extra: list[str]) -> tuple[int, bool]:
    """Fuzz one target in ``jobs`` processes: how many inputs, and whether all was well."""
    folder = prepare(target)
    flags = [str(folder), *flags_of(target), *extra]
    if runs:
        flags.append(f"-runs={-(-runs // jobs)}")
    if seconds:
        flags.append(f"-max_total_time={seconds}")
    logs = [WORK / f"{target}-{job}.log" for job in range(jobs)]
    began = time.monotonic()
    workers = [start(target, log, flags) for log in logs]
    try:
        codes = [worker.wait() for worker in workers]
    except KeyboardInterrupt:
        codes = [worker.wait() for worker in workers]
    finally:
        for worker in workers:
            worker.kill()
    took = time.monotonic() - began
    executed = 0
    for log in logs:
        found = re.findall(rb"stat::number_of_executed_units: +(\d+)", log.read_bytes())
        executed += sum(map(int, found))
    print(
        f"{target}: {executed:,} inputs in {took:.0f} s, {executed / took:,.0f} a second, "
        f"{jobs} processes, Python {platform.python_version()}, "
        f"{'nothing found' if not any(codes) else f'stopped, see {logs[0].parent}/{target}-*.log'}",
        flush=True,
    )
    return executed, not any(codes)


def pack(target: str) -> None:
    """Minimise what lies in the working folder, and keep it."""
    folder = prepare(target)
    smallest = WORK / f"{target}.min"
    shutil.rmtree(smallest, ignore_errors=True)
    smallest.mkdir()
    log = WORK / f"{target}-merge.log"
    flags = ["-merge=1", str(smallest), str(folder), *flags_of(target)]
    if start(target, log, flags).wait():
        sys.exit(f"minimising {target} failed, see {log}")
    inputs = [file.read_bytes() for file in smallest.iterdir()]
    path = save(target, inputs)
    print(
        f"{target}: {len(inputs)} inputs of {len(list(folder.iterdir()))} kept, "
        f"{path.stat().st_size:,} bytes"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", choices=[*TARGETS, "all", "live"])
    parser.add_argument("--runs", type=int, default=0, help="inputs; for all: divided by share")
    parser.add_argument("--seconds", type=int, default=0, help="for each target")
    parser.add_argument("--jobs", type=int, default=1, help="processes side by side")
    parser.add_argument("--pack", action="store_true", help="minimise and keep what was found")
    parser.add_argument("--replay", nargs="+", type=Path, help="check these files, no more")
    live = parser.add_argument_group("live")
    live.add_argument("--requests", type=int, default=100_000, help="how many, of both kinds")
    live.add_argument("--only", choices=["http", "tcpros"], help="one kind of requests")
    live.add_argument("--seed", type=int, help="send what was sent with it before")
    live.add_argument("--loop", choices=["asyncio", "uvloop"], default="asyncio")
    parser.add_argument("--work", action="store_true", help=argparse.SUPPRESS)
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    options, extra = parser.parse_args(words[:split]), words[split + 1 :]
    if options.work:
        work(options.target, extra)
        return
    if options.target == "live":
        seed = secrets.randbits(32) if options.seed is None else options.seed
        live_main = module("live").main
        sys.exit(not live_main(options.requests, seed, options.only, options.loop, FINDINGS))
    targets = TARGETS if options.target == "all" else (options.target,)
    well, total, began = True, 0, time.monotonic()
    for target in targets:
        if options.replay:
            replay(target, options.replay)
        elif options.pack:
            pack(target)
        else:
            share = module(target).SHARE if len(targets) > 1 else 100
            runs = options.runs * share // 100
            executed, fine = fuzz(target, runs, options.seconds, options.jobs, extra)
            total, well = total + executed, well and fine
    if total and len(targets) > 1:
        print(f"all: {total:,} inputs in {time.monotonic() - began:.0f} s")
    sys.exit(not well)


if __name__ == "__main__":
    main()
