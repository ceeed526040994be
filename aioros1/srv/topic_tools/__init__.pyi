# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class DemuxAddRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class DemuxAddResponse(_t.Message):
    def __init__(self) -> None: ...

class DemuxAdd(_t.Service[DemuxAddRequest, DemuxAddResponse]):
    Request: _ty.TypeAlias = DemuxAddRequest
    Response: _ty.TypeAlias = DemuxAddResponse

class DemuxDeleteRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class DemuxDeleteResponse(_t.Message):
    def __init__(self) -> None: ...

class DemuxDelete(_t.Service[DemuxDeleteRequest, DemuxDeleteResponse]):
    Request: _ty.TypeAlias = DemuxDeleteRequest
    Response: _ty.TypeAlias = DemuxDeleteResponse

class DemuxListRequest(_t.Message):
    def __init__(self) -> None: ...

class DemuxListResponse(_t.Message):
    topics: _t.TextList
    @_ty.overload
    def __init__(self, *, topics: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, topics: _t.Texts, /) -> None: ...

class DemuxList(_t.Service[DemuxListRequest, DemuxListResponse]):
    Request: _ty.TypeAlias = DemuxListRequest
    Response: _ty.TypeAlias = DemuxListResponse

class DemuxSelectRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class DemuxSelectResponse(_t.Message):
    prev_topic: _b.str
    @_ty.overload
    def __init__(self, *, prev_topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, prev_topic: _t.Text, /) -> None: ...

class DemuxSelect(_t.Service[DemuxSelectRequest, DemuxSelectResponse]):
    Request: _ty.TypeAlias = DemuxSelectRequest
    Response: _ty.TypeAlias = DemuxSelectResponse

class MuxAddRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class MuxAddResponse(_t.Message):
    def __init__(self) -> None: ...

class MuxAdd(_t.Service[MuxAddRequest, MuxAddResponse]):
    Request: _ty.TypeAlias = MuxAddRequest
    Response: _ty.TypeAlias = MuxAddResponse

class MuxDeleteRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class MuxDeleteResponse(_t.Message):
    def __init__(self) -> None: ...

class MuxDelete(_t.Service[MuxDeleteRequest, MuxDeleteResponse]):
    Request: _ty.TypeAlias = MuxDeleteRequest
    Response: _ty.TypeAlias = MuxDeleteResponse

class MuxListRequest(_t.Message):
    def __init__(self) -> None: ...

class MuxListResponse(_t.Message):
    topics: _t.TextList
    @_ty.overload
    def __init__(self, *, topics: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, topics: _t.Texts, /) -> None: ...

class MuxList(_t.Service[MuxListRequest, MuxListResponse]):
    Request: _ty.TypeAlias = MuxListRequest
    Response: _ty.TypeAlias = MuxListResponse

class MuxSelectRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class MuxSelectResponse(_t.Message):
    prev_topic: _b.str
    @_ty.overload
    def __init__(self, *, prev_topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, prev_topic: _t.Text, /) -> None: ...

class MuxSelect(_t.Service[MuxSelectRequest, MuxSelectResponse]):
    Request: _ty.TypeAlias = MuxSelectRequest
    Response: _ty.TypeAlias = MuxSelectResponse
