# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geographic_msgs as _msg_geographic_msgs
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.std_msgs as _msg_std_msgs
import aioros1.msg.uuid_msgs as _msg_uuid_msgs

class BoundingBox(_t.Message):
    min_pt: _msg_geographic_msgs.GeoPoint
    max_pt: _msg_geographic_msgs.GeoPoint
    @_ty.overload
    def __init__(
        self,
        *,
        min_pt: _msg_geographic_msgs.GeoPoint = ...,
        max_pt: _msg_geographic_msgs.GeoPoint = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        min_pt: _msg_geographic_msgs.GeoPoint,
        max_pt: _msg_geographic_msgs.GeoPoint,
        /,
    ) -> None: ...

class GeoPath(_t.Message):
    header: _msg_std_msgs.Header
    poses: _t.ItemList[_msg_geographic_msgs.GeoPoseStamped]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        poses: _t.Items[_msg_geographic_msgs.GeoPoseStamped] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        poses: _t.Items[_msg_geographic_msgs.GeoPoseStamped],
        /,
    ) -> None: ...

class GeoPoint(_t.Message):
    latitude: _b.float
    longitude: _b.float
    altitude: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        altitude: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, latitude: _t.Float, longitude: _t.Float, altitude: _t.Float, /) -> None: ...

class GeoPointStamped(_t.Message):
    header: _msg_std_msgs.Header
    position: _msg_geographic_msgs.GeoPoint
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        position: _msg_geographic_msgs.GeoPoint = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        position: _msg_geographic_msgs.GeoPoint,
        /,
    ) -> None: ...

class GeoPose(_t.Message):
    position: _msg_geographic_msgs.GeoPoint
    orientation: _msg_geometry_msgs.Quaternion
    @_ty.overload
    def __init__(
        self,
        *,
        position: _msg_geographic_msgs.GeoPoint = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        position: _msg_geographic_msgs.GeoPoint,
        orientation: _msg_geometry_msgs.Quaternion,
        /,
    ) -> None: ...

class GeoPoseStamped(_t.Message):
    header: _msg_std_msgs.Header
    pose: _msg_geographic_msgs.GeoPose
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        pose: _msg_geographic_msgs.GeoPose = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        pose: _msg_geographic_msgs.GeoPose,
        /,
    ) -> None: ...

class GeographicMap(_t.Message):
    header: _msg_std_msgs.Header
    id: _msg_uuid_msgs.UniqueID
    bounds: _msg_geographic_msgs.BoundingBox
    points: _t.ItemList[_msg_geographic_msgs.WayPoint]
    features: _t.ItemList[_msg_geographic_msgs.MapFeature]
    props: _t.ItemList[_msg_geographic_msgs.KeyValue]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id: _msg_uuid_msgs.UniqueID = ...,
        bounds: _msg_geographic_msgs.BoundingBox = ...,
        points: _t.Items[_msg_geographic_msgs.WayPoint] = ...,
        features: _t.Items[_msg_geographic_msgs.MapFeature] = ...,
        props: _t.Items[_msg_geographic_msgs.KeyValue] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id: _msg_uuid_msgs.UniqueID,
        bounds: _msg_geographic_msgs.BoundingBox,
        points: _t.Items[_msg_geographic_msgs.WayPoint],
        features: _t.Items[_msg_geographic_msgs.MapFeature],
        props: _t.Items[_msg_geographic_msgs.KeyValue],
        /,
    ) -> None: ...

class GeographicMapChanges(_t.Message):
    header: _msg_std_msgs.Header
    diffs: _msg_geographic_msgs.GeographicMap
    deletes: _t.ItemList[_msg_uuid_msgs.UniqueID]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        diffs: _msg_geographic_msgs.GeographicMap = ...,
        deletes: _t.Items[_msg_uuid_msgs.UniqueID] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        diffs: _msg_geographic_msgs.GeographicMap,
        deletes: _t.Items[_msg_uuid_msgs.UniqueID],
        /,
    ) -> None: ...

class KeyValue(_t.Message):
    key: _b.str
    value: _b.str
    @_ty.overload
    def __init__(self, *, key: _t.Text = ..., value: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, key: _t.Text, value: _t.Text, /) -> None: ...

class MapFeature(_t.Message):
    id: _msg_uuid_msgs.UniqueID
    components: _t.ItemList[_msg_uuid_msgs.UniqueID]
    props: _t.ItemList[_msg_geographic_msgs.KeyValue]
    @_ty.overload
    def __init__(
        self,
        *,
        id: _msg_uuid_msgs.UniqueID = ...,
        components: _t.Items[_msg_uuid_msgs.UniqueID] = ...,
        props: _t.Items[_msg_geographic_msgs.KeyValue] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        id: _msg_uuid_msgs.UniqueID,
        components: _t.Items[_msg_uuid_msgs.UniqueID],
        props: _t.Items[_msg_geographic_msgs.KeyValue],
        /,
    ) -> None: ...

class RouteNetwork(_t.Message):
    header: _msg_std_msgs.Header
    id: _msg_uuid_msgs.UniqueID
    bounds: _msg_geographic_msgs.BoundingBox
    points: _t.ItemList[_msg_geographic_msgs.WayPoint]
    segments: _t.ItemList[_msg_geographic_msgs.RouteSegment]
    props: _t.ItemList[_msg_geographic_msgs.KeyValue]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id: _msg_uuid_msgs.UniqueID = ...,
        bounds: _msg_geographic_msgs.BoundingBox = ...,
        points: _t.Items[_msg_geographic_msgs.WayPoint] = ...,
        segments: _t.Items[_msg_geographic_msgs.RouteSegment] = ...,
        props: _t.Items[_msg_geographic_msgs.KeyValue] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id: _msg_uuid_msgs.UniqueID,
        bounds: _msg_geographic_msgs.BoundingBox,
        points: _t.Items[_msg_geographic_msgs.WayPoint],
        segments: _t.Items[_msg_geographic_msgs.RouteSegment],
        props: _t.Items[_msg_geographic_msgs.KeyValue],
        /,
    ) -> None: ...

class RoutePath(_t.Message):
    header: _msg_std_msgs.Header
    network: _msg_uuid_msgs.UniqueID
    segments: _t.ItemList[_msg_uuid_msgs.UniqueID]
    props: _t.ItemList[_msg_geographic_msgs.KeyValue]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        network: _msg_uuid_msgs.UniqueID = ...,
        segments: _t.Items[_msg_uuid_msgs.UniqueID] = ...,
        props: _t.Items[_msg_geographic_msgs.KeyValue] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        network: _msg_uuid_msgs.UniqueID,
        segments: _t.Items[_msg_uuid_msgs.UniqueID],
        props: _t.Items[_msg_geographic_msgs.KeyValue],
        /,
    ) -> None: ...

class RouteSegment(_t.Message):
    id: _msg_uuid_msgs.UniqueID
    start: _msg_uuid_msgs.UniqueID
    end: _msg_uuid_msgs.UniqueID
    props: _t.ItemList[_msg_geographic_msgs.KeyValue]
    @_ty.overload
    def __init__(
        self,
        *,
        id: _msg_uuid_msgs.UniqueID = ...,
        start: _msg_uuid_msgs.UniqueID = ...,
        end: _msg_uuid_msgs.UniqueID = ...,
        props: _t.Items[_msg_geographic_msgs.KeyValue] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        id: _msg_uuid_msgs.UniqueID,
        start: _msg_uuid_msgs.UniqueID,
        end: _msg_uuid_msgs.UniqueID,
        props: _t.Items[_msg_geographic_msgs.KeyValue],
        /,
    ) -> None: ...

class WayPoint(_t.Message):
    id: _msg_uuid_msgs.UniqueID
    position: _msg_geographic_msgs.GeoPoint
    props: _t.ItemList[_msg_geographic_msgs.KeyValue]
    @_ty.overload
    def __init__(
        self,
        *,
        id: _msg_uuid_msgs.UniqueID = ...,
        position: _msg_geographic_msgs.GeoPoint = ...,
        props: _t.Items[_msg_geographic_msgs.KeyValue] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        id: _msg_uuid_msgs.UniqueID,
        position: _msg_geographic_msgs.GeoPoint,
        props: _t.Items[_msg_geographic_msgs.KeyValue],
        /,
    ) -> None: ...
