# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs

class tfMessage(_t.Message):
    transforms: _t.ItemList[_msg_geometry_msgs.TransformStamped]
    @_ty.overload
    def __init__(
        self,
        *,
        transforms: _t.Items[_msg_geometry_msgs.TransformStamped] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, transforms: _t.Items[_msg_geometry_msgs.TransformStamped], /) -> None: ...
