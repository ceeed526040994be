"""What is installed, in which version; and the machine it runs on."""

from __future__ import annotations

import json
import platform
import subprocess
from importlib import metadata
from pathlib import Path

__all__ = ["cpu_model", "debian_package", "distribution", "npm_package", "output"]


def output(*command: str) -> str:
    """What a program prints; nothing if it is not there or fails."""
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except OSError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def debian_package(name: str) -> str:
    return output("dpkg-query", "--show", "--showformat", "${Version}", name)


def distribution(name: str) -> str:
    """Of a Python package that this interpreter has."""
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""


def npm_package(modules: Path, name: str) -> str:
    version: str = json.loads((modules / name / "package.json").read_text())["version"]
    return version


def cpu_model() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.machine()
