# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.sensor_msgs as _msg_sensor_msgs
import aioros1.msg.std_msgs as _msg_std_msgs
import aioros1.msg.vision_msgs as _msg_vision_msgs

class BoundingBox2D(_t.Message):
    center: _msg_geometry_msgs.Pose2D
    size_x: _b.float
    size_y: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        center: _msg_geometry_msgs.Pose2D = ...,
        size_x: _t.Float = ...,
        size_y: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        center: _msg_geometry_msgs.Pose2D,
        size_x: _t.Float,
        size_y: _t.Float,
        /,
    ) -> None: ...

class BoundingBox2DArray(_t.Message):
    header: _msg_std_msgs.Header
    boxes: _t.ItemList[_msg_vision_msgs.BoundingBox2D]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        boxes: _t.Items[_msg_vision_msgs.BoundingBox2D] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        boxes: _t.Items[_msg_vision_msgs.BoundingBox2D],
        /,
    ) -> None: ...

class BoundingBox3D(_t.Message):
    center: _msg_geometry_msgs.Pose
    size: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        center: _msg_geometry_msgs.Pose = ...,
        size: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        center: _msg_geometry_msgs.Pose,
        size: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class BoundingBox3DArray(_t.Message):
    header: _msg_std_msgs.Header
    boxes: _t.ItemList[_msg_vision_msgs.BoundingBox3D]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        boxes: _t.Items[_msg_vision_msgs.BoundingBox3D] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        boxes: _t.Items[_msg_vision_msgs.BoundingBox3D],
        /,
    ) -> None: ...

class Classification2D(_t.Message):
    header: _msg_std_msgs.Header
    results: _t.ItemList[_msg_vision_msgs.ObjectHypothesis]
    source_img: _msg_sensor_msgs.Image
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesis] = ...,
        source_img: _msg_sensor_msgs.Image = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesis],
        source_img: _msg_sensor_msgs.Image,
        /,
    ) -> None: ...

class Classification3D(_t.Message):
    header: _msg_std_msgs.Header
    results: _t.ItemList[_msg_vision_msgs.ObjectHypothesis]
    source_cloud: _msg_sensor_msgs.PointCloud2
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesis] = ...,
        source_cloud: _msg_sensor_msgs.PointCloud2 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesis],
        source_cloud: _msg_sensor_msgs.PointCloud2,
        /,
    ) -> None: ...

class Detection2D(_t.Message):
    header: _msg_std_msgs.Header
    results: _t.ItemList[_msg_vision_msgs.ObjectHypothesisWithPose]
    bbox: _msg_vision_msgs.BoundingBox2D
    source_img: _msg_sensor_msgs.Image
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesisWithPose] = ...,
        bbox: _msg_vision_msgs.BoundingBox2D = ...,
        source_img: _msg_sensor_msgs.Image = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesisWithPose],
        bbox: _msg_vision_msgs.BoundingBox2D,
        source_img: _msg_sensor_msgs.Image,
        /,
    ) -> None: ...

class Detection2DArray(_t.Message):
    header: _msg_std_msgs.Header
    detections: _t.ItemList[_msg_vision_msgs.Detection2D]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        detections: _t.Items[_msg_vision_msgs.Detection2D] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        detections: _t.Items[_msg_vision_msgs.Detection2D],
        /,
    ) -> None: ...

class Detection3D(_t.Message):
    header: _msg_std_msgs.Header
    results: _t.ItemList[_msg_vision_msgs.ObjectHypothesisWithPose]
    bbox: _msg_vision_msgs.BoundingBox3D
    source_cloud: _msg_sensor_msgs.PointCloud2
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesisWithPose] = ...,
        bbox: _msg_vision_msgs.BoundingBox3D = ...,
        source_cloud: _msg_sensor_msgs.PointCloud2 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        results: _t.Items[_msg_vision_msgs.ObjectHypothesisWithPose],
        bbox: _msg_vision_msgs.BoundingBox3D,
        source_cloud: _msg_sensor_msgs.PointCloud2,
        /,
    ) -> None: ...

class Detection3DArray(_t.Message):
    header: _msg_std_msgs.Header
    detections: _t.ItemList[_msg_vision_msgs.Detection3D]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        detections: _t.Items[_msg_vision_msgs.Detection3D] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        detections: _t.Items[_msg_vision_msgs.Detection3D],
        /,
    ) -> None: ...

class ObjectHypothesis(_t.Message):
    id: _b.int
    score: _b.float
    @_ty.overload
    def __init__(self, *, id: _t.Int = ..., score: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, id: _t.Int, score: _t.Float, /) -> None: ...

class ObjectHypothesisWithPose(_t.Message):
    id: _b.int
    score: _b.float
    pose: _msg_geometry_msgs.PoseWithCovariance
    @_ty.overload
    def __init__(
        self,
        *,
        id: _t.Int = ...,
        score: _t.Float = ...,
        pose: _msg_geometry_msgs.PoseWithCovariance = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        id: _t.Int,
        score: _t.Float,
        pose: _msg_geometry_msgs.PoseWithCovariance,
        /,
    ) -> None: ...

class VisionInfo(_t.Message):
    header: _msg_std_msgs.Header
    method: _b.str
    database_location: _b.str
    database_version: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        method: _t.Text = ...,
        database_location: _t.Text = ...,
        database_version: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        method: _t.Text,
        database_location: _t.Text,
        database_version: _t.Int,
        /,
    ) -> None: ...
