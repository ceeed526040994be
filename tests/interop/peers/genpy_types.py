"""What Debian's genpy says of types and messages: one JSON question a line, one answer each."""

import importlib.util
import inspect
import io
import json
import sys

import genpy
from neutral import build, random_message, show


def class_of(name):
    """The class of a message: ``pkg/Type``, the two of a service included."""
    if name in ("time", "duration"):
        return {"time": genpy.Time, "duration": genpy.Duration}[name]
    package, _, base = name.partition("/")
    return next(vars(module)[base] for module in modules(package) if base in vars(module))


def modules(package):
    for kind in ("msg", "srv"):
        name = f"{package}.{kind}"
        if importlib.util.find_spec(name) is not None:
            yield importlib.import_module(name)


def octets(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def types(package):
    """All types that the package has classes of."""
    answer = {}
    for module in modules(package):
        for cls in vars(module).values():
            if not inspect.isclass(cls):
                continue
            if issubclass(cls, genpy.Message):
                answer[cls._type] = describe(cls)
            elif hasattr(cls, "_request_class"):
                answer[cls._type] = {
                    "kind": "srv",
                    "md5sum": cls._md5sum,
                    "messages": [cls._request_class._type, cls._response_class._type],
                }
    return answer


def describe(cls):
    return {
        "kind": "msg",
        "md5sum": cls._md5sum,
        "full_text": cls._full_text,
        "slots": list(cls.__slots__),
        "slot_types": list(cls._slot_types),
        "has_header": cls._has_header,
        "constants": constants(cls),
        "defaults": show(cls()),
        "zero": octets(cls()).hex(),
    }


def constants(cls):
    return {
        name: [type(value).__name__, value.hex() if isinstance(value, float) else value]
        for name, value in vars(cls).items()
        if not name.startswith("_") and isinstance(value, (bool, int, float, str, bytes))
    }


def encode(name, seeds):
    """The messages of the seeds, and what genpy encodes them to."""
    messages = [random_message(class_of, name, seed) for seed in seeds]
    return [[m, octets(build(class_of, name, m)).hex()] for m in messages]


def decode(name, octets_of_messages):
    """What genpy decodes, and what it encodes that to."""
    answer = []
    for data in octets_of_messages:
        message = class_of(name)().deserialize(bytes.fromhex(data))
        answer.append([show(message), octets(message).hex()])
    return answer


if __name__ == "__main__":
    questions = {"types": types, "encode": encode, "decode": decode}
    for line in sys.stdin:
        question, *arguments = json.loads(line)
        try:
            answer = questions[question](*arguments)
        except Exception as exc:
            answer = {"error": f"{type(exc).__name__}: {exc}"}
        print(json.dumps(answer), flush=True)
