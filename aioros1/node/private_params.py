"""Values of ``_name:=value`` words on a command line."""

from __future__ import annotations

from typing import Any

from aioros1.wire.xmlrpc import encode_response

__all__ = ["parse_value"]

_WORDS = {"true": True, "false": False}


def parse_value(text: str) -> Any:
    """What ``text`` means: YAML where PyYAML is installed, as for every program of ROS 1.

    Without it a number, ``true`` or ``false`` are recognised, and anything else is text.
    Nothing at all is the empty text. Raises :class:`ValueError` for what is not YAML, and
    for what is no value of a parameter: null, a date without a time, numbers too large.
    """
    try:
        import yaml
    except ImportError:
        return _scalar(text)
    try:
        value = yaml.safe_load(text) if text else ""
    except yaml.YAMLError as error:
        raise ValueError(f"expected a value in YAML, got {text!r}: {error}") from error
    try:
        encode_response(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"expected the value of a parameter, got {text!r}: {error}") from error
    return value


def _scalar(text: str) -> Any:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return _WORDS.get(text.lower(), text)
