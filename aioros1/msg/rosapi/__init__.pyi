# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class TypeDef(_t.Message):
    type: _b.str
    fieldnames: _t.TextList
    fieldtypes: _t.TextList
    fieldarraylen: _t.IntArray
    examples: _t.TextList
    constnames: _t.TextList
    constvalues: _t.TextList
    @_ty.overload
    def __init__(
        self,
        *,
        type: _t.Text = ...,
        fieldnames: _t.Texts = ...,
        fieldtypes: _t.Texts = ...,
        fieldarraylen: _t.Ints = ...,
        examples: _t.Texts = ...,
        constnames: _t.Texts = ...,
        constvalues: _t.Texts = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        type: _t.Text,
        fieldnames: _t.Texts,
        fieldtypes: _t.Texts,
        fieldarraylen: _t.Ints,
        examples: _t.Texts,
        constnames: _t.Texts,
        constvalues: _t.Texts,
        /,
    ) -> None: ...
