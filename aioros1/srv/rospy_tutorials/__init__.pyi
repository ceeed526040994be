# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class AddTwoIntsRequest(_t.Message):
    a: _b.int
    b: _b.int
    @_ty.overload
    def __init__(self, *, a: _t.Int = ..., b: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, a: _t.Int, b: _t.Int, /) -> None: ...

class AddTwoIntsResponse(_t.Message):
    sum: _b.int
    @_ty.overload
    def __init__(self, *, sum: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, sum: _t.Int, /) -> None: ...

class AddTwoInts(_t.Service[AddTwoIntsRequest, AddTwoIntsResponse]):
    Request: _ty.TypeAlias = AddTwoIntsRequest
    Response: _ty.TypeAlias = AddTwoIntsResponse

class BadTwoIntsRequest(_t.Message):
    a: _b.int
    b: _b.int
    @_ty.overload
    def __init__(self, *, a: _t.Int = ..., b: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, a: _t.Int, b: _t.Int, /) -> None: ...

class BadTwoIntsResponse(_t.Message):
    sum: _b.int
    @_ty.overload
    def __init__(self, *, sum: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, sum: _t.Int, /) -> None: ...

class BadTwoInts(_t.Service[BadTwoIntsRequest, BadTwoIntsResponse]):
    Request: _ty.TypeAlias = BadTwoIntsRequest
    Response: _ty.TypeAlias = BadTwoIntsResponse
