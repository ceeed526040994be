"""Compiles decoders from the sources that the generators write."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from aioros1.idl.codegen import Source
from aioros1.idl.codegen_decode import Mode, write_decoder
from aioros1.idl.codegen_learned import write_learned
from aioros1.idl.explain import explainer
from aioros1.idl.structure import Structure
from aioros1.idl.values import made_later

__all__ = ["make_decoder", "make_whole_decoder"]


def make_decoder(cls: type[Structure], mode: Mode) -> Callable[[Any, int, int], Any]:
    """Compile a decoder of the bytes between two positions; some may be left over."""
    out = Source("decode", "data, pos, end")
    return _compile(out, cls, mode, "pos", exact=False)


def make_whole_decoder(cls: type[Structure]) -> Callable[..., Any]:
    """Compile a decoder of a buffer that is one message and nothing else."""
    # The parameter of the method is keyword-only. Here that would cost a tenth of the time.
    out = Source("from_bytes", "data, views=False")
    out.globals["as_bytes"] = _as_bytes
    out.globals["shown"] = made_later(lambda: _make_whole(cls, "views", _as_view))
    out.line("if views: return shown(data)")
    out.line("if data.__class__ is not bytes: data = as_bytes(data)")
    out.line("end = len(data)")
    return _compile(out, cls, "bytes", "0", exact=True)


def _make_whole(cls: type[Structure], mode: Mode, convert: Callable[[Any], Any]) -> Any:
    out = Source("from_bytes", "data")
    out.globals["convert"] = convert
    out.line("data = convert(data)")
    out.line("end = len(data)")
    return _compile(out, cls, mode, "0", exact=True)


def _as_bytes(buffer: Any) -> bytes:
    return memoryview(buffer).tobytes()


def _as_view(buffer: Any) -> memoryview:
    """The bytes of a buffer, without a copy."""
    return memoryview(buffer).cast("B")


def _compile(
    out: Source, cls: type[Structure], mode: Mode, base: str, *, exact: bool
) -> Callable[..., Any]:
    learning = mode == "bytes" and write_learned(out, cls, base)
    arguments = f"data, {base}, end"
    out.line("try:")
    out.depth += 1
    root = write_decoder(out, cls, mode, base, exact=exact)
    if learning:
        out.line(f"if layout is None: learn({arguments})")
    out.line(f"return {root}")
    out.depth -= 1
    if mode == "bytes":
        # Text that is not UTF-8 is rare, and has a decoder of its own.
        if exact:
            out.globals["escaped"] = made_later(lambda: _make_whole(cls, "escape", _as_bytes))
        else:
            out.globals["escaped"] = made_later(lambda: make_decoder(cls, "escape"))
        out.line("except UnicodeDecodeError:")
        out.line(f"    return escaped({'data' if exact else arguments})")
    out.globals["explain"] = explainer(cls, exact=exact)
    out.line("except (struct_error, ValueError, TypeError, OverflowError):")
    out.line(f"    raise explain({arguments}) from None")
    return out.compile(cls._type)
