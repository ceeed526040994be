# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geographic_msgs as _msg_geographic_msgs
import aioros1.msg.uuid_msgs as _msg_uuid_msgs

class GetGeoPathRequest(_t.Message):
    start: _msg_geographic_msgs.GeoPoint
    goal: _msg_geographic_msgs.GeoPoint
    @_ty.overload
    def __init__(
        self,
        *,
        start: _msg_geographic_msgs.GeoPoint = ...,
        goal: _msg_geographic_msgs.GeoPoint = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        start: _msg_geographic_msgs.GeoPoint,
        goal: _msg_geographic_msgs.GeoPoint,
        /,
    ) -> None: ...

class GetGeoPathResponse(_t.Message):
    success: _b.bool
    status: _b.str
    plan: _msg_geographic_msgs.GeoPath
    network: _msg_uuid_msgs.UniqueID
    start_seg: _msg_uuid_msgs.UniqueID
    goal_seg: _msg_uuid_msgs.UniqueID
    distance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        success: _t.Bool = ...,
        status: _t.Text = ...,
        plan: _msg_geographic_msgs.GeoPath = ...,
        network: _msg_uuid_msgs.UniqueID = ...,
        start_seg: _msg_uuid_msgs.UniqueID = ...,
        goal_seg: _msg_uuid_msgs.UniqueID = ...,
        distance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        success: _t.Bool,
        status: _t.Text,
        plan: _msg_geographic_msgs.GeoPath,
        network: _msg_uuid_msgs.UniqueID,
        start_seg: _msg_uuid_msgs.UniqueID,
        goal_seg: _msg_uuid_msgs.UniqueID,
        distance: _t.Float,
        /,
    ) -> None: ...

class GetGeoPath(_t.Service[GetGeoPathRequest, GetGeoPathResponse]):
    Request: _ty.TypeAlias = GetGeoPathRequest
    Response: _ty.TypeAlias = GetGeoPathResponse

class GetGeographicMapRequest(_t.Message):
    url: _b.str
    bounds: _msg_geographic_msgs.BoundingBox
    @_ty.overload
    def __init__(
        self,
        *,
        url: _t.Text = ...,
        bounds: _msg_geographic_msgs.BoundingBox = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, url: _t.Text, bounds: _msg_geographic_msgs.BoundingBox, /) -> None: ...

class GetGeographicMapResponse(_t.Message):
    success: _b.bool
    status: _b.str
    map: _msg_geographic_msgs.GeographicMap
    @_ty.overload
    def __init__(
        self,
        *,
        success: _t.Bool = ...,
        status: _t.Text = ...,
        map: _msg_geographic_msgs.GeographicMap = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        success: _t.Bool,
        status: _t.Text,
        map: _msg_geographic_msgs.GeographicMap,
        /,
    ) -> None: ...

class GetGeographicMap(_t.Service[GetGeographicMapRequest, GetGeographicMapResponse]):
    Request: _ty.TypeAlias = GetGeographicMapRequest
    Response: _ty.TypeAlias = GetGeographicMapResponse

class GetRoutePlanRequest(_t.Message):
    network: _msg_uuid_msgs.UniqueID
    start: _msg_uuid_msgs.UniqueID
    goal: _msg_uuid_msgs.UniqueID
    @_ty.overload
    def __init__(
        self,
        *,
        network: _msg_uuid_msgs.UniqueID = ...,
        start: _msg_uuid_msgs.UniqueID = ...,
        goal: _msg_uuid_msgs.UniqueID = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        network: _msg_uuid_msgs.UniqueID,
        start: _msg_uuid_msgs.UniqueID,
        goal: _msg_uuid_msgs.UniqueID,
        /,
    ) -> None: ...

class GetRoutePlanResponse(_t.Message):
    success: _b.bool
    status: _b.str
    plan: _msg_geographic_msgs.RoutePath
    @_ty.overload
    def __init__(
        self,
        *,
        success: _t.Bool = ...,
        status: _t.Text = ...,
        plan: _msg_geographic_msgs.RoutePath = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        success: _t.Bool,
        status: _t.Text,
        plan: _msg_geographic_msgs.RoutePath,
        /,
    ) -> None: ...

class GetRoutePlan(_t.Service[GetRoutePlanRequest, GetRoutePlanResponse]):
    Request: _ty.TypeAlias = GetRoutePlanRequest
    Response: _ty.TypeAlias = GetRoutePlanResponse

class UpdateGeographicMapRequest(_t.Message):
    updates: _msg_geographic_msgs.GeographicMapChanges
    @_ty.overload
    def __init__(self, *, updates: _msg_geographic_msgs.GeographicMapChanges = ...) -> None: ...
    @_ty.overload
    def __init__(self, updates: _msg_geographic_msgs.GeographicMapChanges, /) -> None: ...

class UpdateGeographicMapResponse(_t.Message):
    success: _b.bool
    status: _b.str
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., status: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, status: _t.Text, /) -> None: ...

class UpdateGeographicMap(_t.Service[UpdateGeographicMapRequest, UpdateGeographicMapResponse]):
    Request: _ty.TypeAlias = UpdateGeographicMapRequest
    Response: _ty.TypeAlias = UpdateGeographicMapResponse
