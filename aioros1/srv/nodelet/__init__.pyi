# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t

class NodeletListRequest(_t.Message):
    def __init__(self) -> None: ...

class NodeletListResponse(_t.Message):
    nodelets: _t.TextList
    @_ty.overload
    def __init__(self, *, nodelets: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, nodelets: _t.Texts, /) -> None: ...

class NodeletList(_t.Service[NodeletListRequest, NodeletListResponse]):
    Request: _ty.TypeAlias = NodeletListRequest
    Response: _ty.TypeAlias = NodeletListResponse

class NodeletLoadRequest(_t.Message):
    name: _b.str
    type: _b.str
    remap_source_args: _t.TextList
    remap_target_args: _t.TextList
    my_argv: _t.TextList
    bond_id: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Text = ...,
        type: _t.Text = ...,
        remap_source_args: _t.Texts = ...,
        remap_target_args: _t.Texts = ...,
        my_argv: _t.Texts = ...,
        bond_id: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        name: _t.Text,
        type: _t.Text,
        remap_source_args: _t.Texts,
        remap_target_args: _t.Texts,
        my_argv: _t.Texts,
        bond_id: _t.Text,
        /,
    ) -> None: ...

class NodeletLoadResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class NodeletLoad(_t.Service[NodeletLoadRequest, NodeletLoadResponse]):
    Request: _ty.TypeAlias = NodeletLoadRequest
    Response: _ty.TypeAlias = NodeletLoadResponse

class NodeletUnloadRequest(_t.Message):
    name: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, /) -> None: ...

class NodeletUnloadResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class NodeletUnload(_t.Service[NodeletUnloadRequest, NodeletUnloadResponse]):
    Request: _ty.TypeAlias = NodeletUnloadRequest
    Response: _ty.TypeAlias = NodeletUnloadResponse
