# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t

class UniqueID(_t.Message):
    uuid: _t.OctetArray
    @_ty.overload
    def __init__(self, *, uuid: _t.Octets = ...) -> None: ...
    @_ty.overload
    def __init__(self, uuid: _t.Octets, /) -> None: ...
