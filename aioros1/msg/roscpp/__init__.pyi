# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class Logger(_t.Message):
    name: _b.str
    level: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., level: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, level: _t.Text, /) -> None: ...
