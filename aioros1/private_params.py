"""Values of ``_name:=value`` words on a command line."""

from __future__ import annotations

from typing import Any

__all__ = ["parse_value"]

_WORDS = {"true": True, "false": False}


def parse_value(text: str) -> Any:
    """What ``text`` means: YAML where PyYAML is installed, as for every program of ROS 1.

    Without it a number, ``true`` or ``false`` are recognised, and anything else is text.
    Raises :class:`ValueError` for what is not YAML.
    """
    try:
        import yaml
    except ImportError:
        return _scalar(text)
    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(f"expected a value in YAML, got {text!r}: {error}") from error


def _scalar(text: str) -> Any:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return _WORDS.get(text.lower(), text)
