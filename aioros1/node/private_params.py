"""Values of ``_name:=value`` words on a command line."""

from __future__ import annotations

from typing import Any

from aioros1.wire.xmlrpc import encode_response

__all__ = ["parse_value"]

_WORDS = {"true": True, "false": False}


def parse_value(text: str) -> Any:
    """Parse ``text`` as YAML if PyYAML is installed, as every program of ROS 1 does.

    Without PyYAML, numbers, ``true`` and ``false`` are recognised, and anything else is a
    string. Empty text is the empty string. Raises :class:`ValueError` for invalid YAML, and
    for values that no parameter can have: null, a date without a time, numbers too large.
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
