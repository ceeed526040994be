"""The clients of ROS 1 that npm has, and what they need to know of messages."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import aioros1
from common import ROOT
from common.contenders import PEERS, Contender, Missing, Places
from common.versions import npm_package, output

__all__ = ["INSTALL", "foxglove_client", "rosnodejs_client"]

# The first needs tslib, and does not say so.
INSTALL = "npm install --prefix DIR @foxglove/ros1@3.0.1 tslib@2.9.1 rosnodejs@3.1.0"
TYPES = [
    *("std_msgs/String", "sensor_msgs/JointState", "geometry_msgs/TransformStamped"),
    *("sensor_msgs/PointCloud2", "sensor_msgs/Image"),
]
PACKAGES = ("std_msgs", "std_srvs", "sensor_msgs", "geometry_msgs", "rosgraph_msgs", "roscpp")


def foxglove_client(places: Places) -> Contender:
    node, modules = find_package(places, "@foxglove/ros1")
    definitions = places.scratch / "definitions.json"
    definitions.write_text(json.dumps({name: aioros1.load_msg(name)._full_text for name in TYPES}))
    return Contender(
        "foxglove",
        "@foxglove/ros1",
        (node, str(PEERS / "foxglove_peer.cjs")),
        (f"modules={modules}", f"definitions={definitions}"),
        version=version(node, modules, "@foxglove/ros1"),
        share=0.3,
    )


def rosnodejs_client(places: Places) -> Contender:
    node, modules = find_package(places, "rosnodejs")
    return Contender(
        "rosnodejs",
        "rosnodejs",
        (node, str(PEERS / "rosnodejs_peer.cjs")),
        (f"modules={modules}", f"messages={make_messages(node, modules, places.scratch)}"),
        version=version(node, modules, "rosnodejs"),
        share=0.5,
    )


def find_package(places: Places, name: str) -> tuple[str, Path]:
    """Node, and the folder ``node_modules`` that has the package."""
    node = shutil.which("node")
    if not node:
        raise Missing("Node is not installed (nodejs, npm)")
    if not places.node_modules:
        raise Missing(f"no --node-modules DIR/node_modules ({INSTALL})")
    modules = places.node_modules.resolve()
    load = f"require('module').createRequire({json.dumps(f'{modules}/peer.cjs')})('{name}')"
    environment = {**os.environ, "CMAKE_PREFIX_PATH": str(places.scratch)}  # rosnodejs insists
    done = subprocess.run([node, "-e", load], env=environment, capture_output=True, text=True)
    if done.returncode:
        why = next(
            (line for line in done.stderr.splitlines() if "Error" in line), "no reason given"
        )
        raise Missing(f"{name} cannot be loaded from {modules}: {why} ({INSTALL})")
    return node, modules


def version(node: str, modules: Path, name: str) -> str:
    return f"{npm_package(modules, name)}, Node {output(node, '--version').lstrip('v')}"


def make_messages(node: str, modules: Path, scratch: Path) -> Path:
    """The classes of rosnodejs, written to files beforehand, as its users have them."""
    sources, made = scratch / "node_packages", scratch / "node_messages"
    for package in PACKAGES:
        shutil.copytree(ROOT / "share" / "msg" / package, sources / package)
        (sources / package / "package.xml").write_text(f"<package><name>{package}</name></package>")
    made.mkdir()
    environment = {**os.environ, "CMAKE_PREFIX_PATH": str(made), "ROS_PACKAGE_PATH": str(sources)}
    command = [node, str(PEERS / "rosnodejs_messages.cjs"), str(modules)]
    subprocess.run(command, env=environment, check=True, capture_output=True)
    return made
