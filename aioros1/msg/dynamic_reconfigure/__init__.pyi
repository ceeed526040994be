# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.dynamic_reconfigure as _msg_dynamic_reconfigure

class BoolParameter(_t.Message):
    name: _b.str
    value: _b.bool
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., value: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, value: _t.Bool, /) -> None: ...

class Config(_t.Message):
    bools: _t.ItemList[_msg_dynamic_reconfigure.BoolParameter]
    ints: _t.ItemList[_msg_dynamic_reconfigure.IntParameter]
    strs: _t.ItemList[_msg_dynamic_reconfigure.StrParameter]
    doubles: _t.ItemList[_msg_dynamic_reconfigure.DoubleParameter]
    groups: _t.ItemList[_msg_dynamic_reconfigure.GroupState]
    @_ty.overload
    def __init__(
        self,
        *,
        bools: _t.Items[_msg_dynamic_reconfigure.BoolParameter] = ...,
        ints: _t.Items[_msg_dynamic_reconfigure.IntParameter] = ...,
        strs: _t.Items[_msg_dynamic_reconfigure.StrParameter] = ...,
        doubles: _t.Items[_msg_dynamic_reconfigure.DoubleParameter] = ...,
        groups: _t.Items[_msg_dynamic_reconfigure.GroupState] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        bools: _t.Items[_msg_dynamic_reconfigure.BoolParameter],
        ints: _t.Items[_msg_dynamic_reconfigure.IntParameter],
        strs: _t.Items[_msg_dynamic_reconfigure.StrParameter],
        doubles: _t.Items[_msg_dynamic_reconfigure.DoubleParameter],
        groups: _t.Items[_msg_dynamic_reconfigure.GroupState],
        /,
    ) -> None: ...

class ConfigDescription(_t.Message):
    groups: _t.ItemList[_msg_dynamic_reconfigure.Group]
    max: _msg_dynamic_reconfigure.Config
    min: _msg_dynamic_reconfigure.Config
    dflt: _msg_dynamic_reconfigure.Config
    @_ty.overload
    def __init__(
        self,
        *,
        groups: _t.Items[_msg_dynamic_reconfigure.Group] = ...,
        max: _msg_dynamic_reconfigure.Config = ...,
        min: _msg_dynamic_reconfigure.Config = ...,
        dflt: _msg_dynamic_reconfigure.Config = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        groups: _t.Items[_msg_dynamic_reconfigure.Group],
        max: _msg_dynamic_reconfigure.Config,
        min: _msg_dynamic_reconfigure.Config,
        dflt: _msg_dynamic_reconfigure.Config,
        /,
    ) -> None: ...

class DoubleParameter(_t.Message):
    name: _b.str
    value: _b.float
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., value: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, value: _t.Float, /) -> None: ...

class Group(_t.Message):
    name: _b.str
    type: _b.str
    parameters: _t.ItemList[_msg_dynamic_reconfigure.ParamDescription]
    parent: _b.int
    id: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Text = ...,
        type: _t.Text = ...,
        parameters: _t.Items[_msg_dynamic_reconfigure.ParamDescription] = ...,
        parent: _t.Int = ...,
        id: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        name: _t.Text,
        type: _t.Text,
        parameters: _t.Items[_msg_dynamic_reconfigure.ParamDescription],
        parent: _t.Int,
        id: _t.Int,
        /,
    ) -> None: ...

class GroupState(_t.Message):
    name: _b.str
    state: _b.bool
    id: _b.int
    parent: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Text = ...,
        state: _t.Bool = ...,
        id: _t.Int = ...,
        parent: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, state: _t.Bool, id: _t.Int, parent: _t.Int, /) -> None: ...

class IntParameter(_t.Message):
    name: _b.str
    value: _b.int
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., value: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, value: _t.Int, /) -> None: ...

class ParamDescription(_t.Message):
    name: _b.str
    type: _b.str
    level: _b.int
    description: _b.str
    edit_method: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Text = ...,
        type: _t.Text = ...,
        level: _t.Int = ...,
        description: _t.Text = ...,
        edit_method: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        name: _t.Text,
        type: _t.Text,
        level: _t.Int,
        description: _t.Text,
        edit_method: _t.Text,
        /,
    ) -> None: ...

class SensorLevels(_t.Message):
    RECONFIGURE_CLOSE: _ty.Final = 3
    RECONFIGURE_STOP: _ty.Final = 1
    RECONFIGURE_RUNNING: _ty.Final = 0
    def __init__(self) -> None: ...

class StrParameter(_t.Message):
    name: _b.str
    value: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., value: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, value: _t.Text, /) -> None: ...
