"""``aioros1.contrib.numpy`` gives what the tools of ROS give for the same messages."""

from __future__ import annotations

from pathlib import Path

import pytest

from . import debian
from .test_genpy_tools import PEERS, ROOT, run

MODULES = {
    "images": "cv_bridge",
    "clouds": "sensor_msgs",
    "scans": "laser_geometry",
    "transforms": "tf",
}


@pytest.mark.parametrize("check", MODULES)
def test_in_the_python_of_debian(check: str, tmp_path: Path) -> None:
    """One of the checks of ``peers/numpy_helpers.py``."""
    debian.require_python("numpy", "geometry_msgs", "sensor_msgs", MODULES[check])
    run([debian.PYTHON, str(PEERS / "numpy_helpers.py"), check], ROOT, tmp_path)
