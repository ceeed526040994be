"""Reads definitions; accepts and refuses what genmsg does.

MD5 sums are made from definitions. If a definition were read differently here, two
programs would refuse to talk to each other. So all oddities of genmsg are kept; those that
look like mistakes have a comment.
"""

from __future__ import annotations

import re
import unicodedata

from aioros1._public import public
from aioros1.errors import InvalidNameError, MessageSpecError
from aioros1.idl.builtin_types import BUILTINS, CONSTANT_TYPES, HEADER_TYPE, is_builtin
from aioros1.idl.spec import ActionSpec, Constant, ConstantValue, Field, MessageSpec, ServiceSpec

__all__ = ["action_texts", "parse_action", "parse_message", "parse_service", "split_type"]

_SEPARATOR = "---"
_RESOURCE = re.compile(r"[A-Za-z][\w/]*\Z")
_FIELD_NAME = re.compile(r"[A-Za-z]\w*\Z")
_PACKAGE_TYPE = re.compile(r"([A-Za-z][A-Za-z0-9_]*)/([A-Za-z][A-Za-z0-9_]*)\Z")


def split_type(name: str) -> tuple[str, str]:
    """Split ``"pkg/Type"`` in two; raises :class:`InvalidNameError` for anything else."""
    match = _PACKAGE_TYPE.match(name) if isinstance(name, str) else None
    if match is None:
        raise InvalidNameError(f"{name!r} is not the name of a type: expected 'package/Type'")
    return match[1], match[2]


@public("aioros1.idl")
def parse_message(type: str, text: str, *, path: str = "", line: int = 1) -> MessageSpec:
    """Read the text of a ``.msg`` file.

    Errors point at ``path``, which is the name of the type if not given, and count lines
    from ``line``. Raises :class:`MessageSpecError`, and
    :class:`InvalidNameError` for a ``type`` that is not ``pkg/Type``.
    """
    package, _ = split_type(type)
    path = path or type
    fields: dict[str, Field] = {}
    constants: list[Constant] = []
    for number, source in enumerate(text.split("\n"), line):
        code = _strip_comment(source)
        if not code:
            continue
        try:
            if "=" in code:
                constants.append(_parse_constant(source, code))
            else:
                field = _parse_field(code, package)
                if field.name in fields:
                    raise ValueError(f"a second field {field.name!r}")
                fields[field.name] = field
        except ValueError as exc:
            raise MessageSpecError(str(exc), path=path, line=number) from None
    return MessageSpec(type, tuple(fields.values()), tuple(constants), text)


@public("aioros1.idl")
def parse_service(type: str, text: str, *, path: str = "") -> ServiceSpec:
    """Read the text of a ``.srv`` file; the messages are ``pkg/TypeRequest`` and ``Response``.

    As in genmsg, a line that *begins* with three dashes separates the two. Without one, the
    response is empty; behind a second one, the response goes on.
    """
    split_type(type)
    path = path or type
    request: list[str] = []
    response: list[str] = []
    numbered: list[str] = []
    current, response_line = request, 0
    for number, source in enumerate(text.split("\n"), 1):
        if source.startswith(_SEPARATOR):
            if current is request:
                current, response_line = response, number + 1
            else:
                numbered.append("")
            continue
        current.append(source)
        if current is response:
            numbered.append(source)
    request_text = "".join(f"{source}\n" for source in request)
    response_text = "".join(f"{source}\n" for source in response)
    # It is parsed with an empty line in place of each further separator, so that errors
    # name the line of the file; the text that is kept is the one that genmsg keeps.
    parsed = parse_message(f"{type}Response", "\n".join(numbered), path=path, line=response_line)
    return ServiceSpec(
        type,
        parse_message(f"{type}Request", request_text, path=path),
        MessageSpec(parsed.type, parsed.fields, parsed.constants, response_text),
        text,
    )


def action_texts(type: str, text: str, *, path: str = "") -> dict[str, str]:
    """The texts of the seven messages of an action, by their suffixes."""
    _, name = split_type(type)
    sections: list[list[str]] = [[]]
    for source in text.split("\n"):
        if source.startswith(_SEPARATOR):
            sections.append([])
        else:
            sections[-1].append(source)
    if len(sections) != 3:
        raise MessageSpecError(
            f"an action has three sections, this text has {len(sections)}", path=path or type
        )
    goal, result, feedback = ("".join(f"{s}\n" for s in section) for section in sections)
    stamped = "Header header\nactionlib_msgs/GoalStatus status\n"
    return {
        "Action": f"{name}ActionGoal action_goal\n"
        f"{name}ActionResult action_result\n"
        f"{name}ActionFeedback action_feedback\n",
        "ActionGoal": f"Header header\nactionlib_msgs/GoalID goal_id\n{name}Goal goal\n",
        "ActionResult": f"{stamped}{name}Result result\n",
        "ActionFeedback": f"{stamped}{name}Feedback feedback\n",
        "Goal": goal,
        "Result": result,
        "Feedback": feedback,
    }


@public("aioros1.idl")
def parse_action(type: str, text: str, *, path: str = "") -> ActionSpec:
    """Read the text of a ``.action`` file."""
    path = path or type
    texts = action_texts(type, text, path=path)
    # The three sections come one after the other in the file.
    line = 1
    lines = {}
    for suffix in ("Goal", "Result", "Feedback"):
        lines[suffix] = line
        line += texts[suffix].count("\n") + 1
    return ActionSpec(
        type,
        {
            suffix: parse_message(f"{type}{suffix}", part, path=path, line=lines.get(suffix, 1))
            for suffix, part in texts.items()
        },
        text,
    )


def _strip_comment(line: str) -> str:
    return line.partition("#")[0].strip()


def _words(code: str) -> list[str]:
    # Only spaces separate words; other white space is stripped from them.
    return [word for part in code.split(" ") if (word := part.strip())]


def _parse_field(code: str, package: str) -> Field:
    words = _words(code)
    if len(words) != 2:
        raise ValueError(f"expected 'type name', got {code!r}")
    type_, name = words
    if not _FIELD_NAME.match(name) or not _is_attribute(name):
        raise ValueError(f"{name!r} is not a legal field name")
    base, dimensions = _parse_type(type_)
    if "/" not in type_:
        # `Header` means std_msgs/Header in any package; `Header[]` does not.
        if type_ == "Header":
            type_ = base = HEADER_TYPE
        elif not is_builtin(base):
            type_, base = f"{package}/{type_}", f"{package}/{base}"
    if not is_builtin(base) and not _PACKAGE_TYPE.match(base):
        raise ValueError(f"{base!r} is not a legal field type")
    if not dimensions:
        return Field(name, type_, base)
    if len(dimensions) > 1:
        raise ValueError(f"an array has one dimension only: {type_!r}")
    return Field(name, type_, base, True, dimensions[0])


def _parse_type(type_: str) -> tuple[str, list[int | None]]:
    """A type without brackets, and the number (or None) in each pair of brackets."""
    base, bracket, rest = type_.partition("[")
    if not _RESOURCE.match(base) or "//" in base:
        raise ValueError(f"{type_!r} is not a legal field type")
    dimensions: list[int | None] = []
    rest = bracket + rest
    while rest:
        inner, closing, after = rest[1:].partition("]")
        # Like genmsg, int() also takes digits beyond ASCII.
        if rest[0] != "[" or not closing or not (inner == "" or inner.isdecimal()):
            raise ValueError(f"{type_!r} is not a legal field type")
        dimensions.append(int(inner) if inner else None)
        rest = after
    return base, dimensions


def _is_attribute(name: str) -> bool:
    # The compiler normalizes names beyond ASCII, and not all are identifiers. genmsg lets
    # such names pass, and then generates code that fails.
    return name.isascii() or (name.isidentifier() and unicodedata.normalize("NFKC", name) == name)


def _parse_constant(source: str, code: str) -> Constant:
    words = _words(code)
    type_ = words[0]
    if type_ not in CONSTANT_TYPES:
        raise ValueError(f"{type_!r} is not a legal type of a constant")
    if type_ == "string":
        # The value is all that follows the equals sign in the *whole* line, # included. The
        # name follows the first space, which is the indentation if the line has one.
        before, _, value = source.partition("=")
        name = before[before.find(" ") + 1 :]
    else:
        parts = " ".join(words[1:]).split("=")
        if len(parts) != 2:
            raise ValueError(f"expected 'type NAME=value', got {code!r}")
        name, value = parts
    text = value.strip()
    return Constant(name.strip(), type_, _constant_value(type_, text), text)


def _constant_value(type_: str, text: str) -> ConstantValue:
    kind = BUILTINS[type_].kind
    if kind == "string":
        return text
    try:
        if kind == "float":
            return float(text)
        if kind == "bool":
            return _literal_truth(text)
        value = int(text)
    except Exception:
        raise ValueError(f"{text!r} is not a value of {type_}") from None
    # genmsg computes these limits in floating point, so that those of 64 bits are too
    # wide by one on either side.
    low, high = BUILTINS[type_].low, BUILTINS[type_].high
    if type_ == "int64":
        low, high = low - 1, high + 1
    elif type_ == "uint64":
        high += 1
    if not low <= value <= high:
        raise ValueError(f"{text} is out of the range of {type_}")
    return value


def _literal_truth(text: str) -> bool:
    if text in ("True", "1"):
        return True
    if text in ("False", "0"):
        return False
    # Any other literal of Python counts by its truth value.
    from ast import literal_eval

    return bool(literal_eval(text))
