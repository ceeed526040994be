"""Values of ``_name:=value`` words on a command line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Self

from aioros1.node.yaml_scalars import NeedsYamlError, read_scalar
from aioros1.wire.xmlrpc import encode_response

__all__ = ["PrivateParams", "parse_value"]


@dataclass(frozen=True, slots=True)
class PrivateParams:
    """The private parameters that a command line sets."""

    values: Mapping[str, Any] = field(default_factory=dict)
    """By the name behind the node's own."""
    unread: tuple[str, ...] = ()
    """The words whose values are kept as text, because reading them takes PyYAML."""

    @classmethod
    def of(cls, words: Mapping[str, str]) -> Self:
        """Read ``{"rate": "10"}``. Raises :class:`ValueError`, which contains the word."""
        values: dict[str, Any] = {}
        unread = []
        for name, text in words.items():
            word = f"_{name}:={text}"
            try:
                values[name] = parse_value(text)
            except NeedsYamlError:
                values[name] = text
                unread.append(word)
            except ValueError as error:
                raise ValueError(f"{word}: {error}") from error
        return cls(values, tuple(unread))

    @property
    def warning(self) -> str:
        """What to do about the words that were not read; empty if there are none."""
        if not self.unread:
            return ""
        return (
            f"{', '.join(self.unread)}: kept as text, because lists, tables, tags and texts of "
            "several lines are read with PyYAML only: pip install 'aioros1[yaml]', or put the "
            "text in quotes"
        )


def parse_value(text: str) -> Any:
    """Parse ``text`` as YAML 1.1, as rospy and rosparam do.

    Without PyYAML, plain and quoted values are read, and anything else raises
    :class:`~aioros1.node.yaml_scalars.NeedsYamlError`. Raises :class:`ValueError` for invalid
    YAML, and for values that no parameter can have: null, a date without a time, numbers too
    large.
    """
    try:
        import yaml
    except ImportError:
        try:
            value = read_scalar(text)
        except ValueError as error:
            raise ValueError(f"expected a value in YAML, got {text!r}: {error}") from error
    else:
        try:
            value = yaml.safe_load(text)
        except (yaml.YAMLError, ValueError, RecursionError) as error:
            raise ValueError(f"expected a value in YAML, got {text!r}: {error}") from error
    try:
        encode_response(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"expected the value of a parameter, got {text!r}: {error}") from error
    return value
