"""``python -m aioros1``."""

from __future__ import annotations

from aioros1.cli import main

main()
