# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class Accel(_t.Message):
    linear: _msg_geometry_msgs.Vector3
    angular: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        linear: _msg_geometry_msgs.Vector3 = ...,
        angular: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        linear: _msg_geometry_msgs.Vector3,
        angular: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class AccelStamped(_t.Message):
    header: _msg_std_msgs.Header
    accel: _msg_geometry_msgs.Accel
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        accel: _msg_geometry_msgs.Accel = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        accel: _msg_geometry_msgs.Accel,
        /,
    ) -> None: ...

class AccelWithCovariance(_t.Message):
    accel: _msg_geometry_msgs.Accel
    covariance: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        accel: _msg_geometry_msgs.Accel = ...,
        covariance: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, accel: _msg_geometry_msgs.Accel, covariance: _t.Floats, /) -> None: ...

class AccelWithCovarianceStamped(_t.Message):
    header: _msg_std_msgs.Header
    accel: _msg_geometry_msgs.AccelWithCovariance
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        accel: _msg_geometry_msgs.AccelWithCovariance = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        accel: _msg_geometry_msgs.AccelWithCovariance,
        /,
    ) -> None: ...

class Inertia(_t.Message):
    m: _b.float
    com: _msg_geometry_msgs.Vector3
    ixx: _b.float
    ixy: _b.float
    ixz: _b.float
    iyy: _b.float
    iyz: _b.float
    izz: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        m: _t.Float = ...,
        com: _msg_geometry_msgs.Vector3 = ...,
        ixx: _t.Float = ...,
        ixy: _t.Float = ...,
        ixz: _t.Float = ...,
        iyy: _t.Float = ...,
        iyz: _t.Float = ...,
        izz: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        m: _t.Float,
        com: _msg_geometry_msgs.Vector3,
        ixx: _t.Float,
        ixy: _t.Float,
        ixz: _t.Float,
        iyy: _t.Float,
        iyz: _t.Float,
        izz: _t.Float,
        /,
    ) -> None: ...

class InertiaStamped(_t.Message):
    header: _msg_std_msgs.Header
    inertia: _msg_geometry_msgs.Inertia
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        inertia: _msg_geometry_msgs.Inertia = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        inertia: _msg_geometry_msgs.Inertia,
        /,
    ) -> None: ...

class Point(_t.Message):
    x: _b.float
    y: _b.float
    z: _b.float
    @_ty.overload
    def __init__(self, *, x: _t.Float = ..., y: _t.Float = ..., z: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, x: _t.Float, y: _t.Float, z: _t.Float, /) -> None: ...

class Point32(_t.Message):
    x: _b.float
    y: _b.float
    z: _b.float
    @_ty.overload
    def __init__(self, *, x: _t.Float = ..., y: _t.Float = ..., z: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, x: _t.Float, y: _t.Float, z: _t.Float, /) -> None: ...

class PointStamped(_t.Message):
    header: _msg_std_msgs.Header
    point: _msg_geometry_msgs.Point
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        point: _msg_geometry_msgs.Point = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        point: _msg_geometry_msgs.Point,
        /,
    ) -> None: ...

class Polygon(_t.Message):
    points: _t.ItemList[_msg_geometry_msgs.Point32]
    @_ty.overload
    def __init__(self, *, points: _t.Items[_msg_geometry_msgs.Point32] = ...) -> None: ...
    @_ty.overload
    def __init__(self, points: _t.Items[_msg_geometry_msgs.Point32], /) -> None: ...

class PolygonStamped(_t.Message):
    header: _msg_std_msgs.Header
    polygon: _msg_geometry_msgs.Polygon
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        polygon: _msg_geometry_msgs.Polygon = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        polygon: _msg_geometry_msgs.Polygon,
        /,
    ) -> None: ...

class Pose(_t.Message):
    position: _msg_geometry_msgs.Point
    orientation: _msg_geometry_msgs.Quaternion
    @_ty.overload
    def __init__(
        self,
        *,
        position: _msg_geometry_msgs.Point = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        position: _msg_geometry_msgs.Point,
        orientation: _msg_geometry_msgs.Quaternion,
        /,
    ) -> None: ...

class Pose2D(_t.Message):
    x: _b.float
    y: _b.float
    theta: _b.float
    @_ty.overload
    def __init__(self, *, x: _t.Float = ..., y: _t.Float = ..., theta: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, x: _t.Float, y: _t.Float, theta: _t.Float, /) -> None: ...

class PoseArray(_t.Message):
    header: _msg_std_msgs.Header
    poses: _t.ItemList[_msg_geometry_msgs.Pose]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        poses: _t.Items[_msg_geometry_msgs.Pose] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        poses: _t.Items[_msg_geometry_msgs.Pose],
        /,
    ) -> None: ...

class PoseStamped(_t.Message):
    header: _msg_std_msgs.Header
    pose: _msg_geometry_msgs.Pose
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        pose: _msg_geometry_msgs.Pose = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, pose: _msg_geometry_msgs.Pose, /) -> None: ...

class PoseWithCovariance(_t.Message):
    pose: _msg_geometry_msgs.Pose
    covariance: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        pose: _msg_geometry_msgs.Pose = ...,
        covariance: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, pose: _msg_geometry_msgs.Pose, covariance: _t.Floats, /) -> None: ...

class PoseWithCovarianceStamped(_t.Message):
    header: _msg_std_msgs.Header
    pose: _msg_geometry_msgs.PoseWithCovariance
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        pose: _msg_geometry_msgs.PoseWithCovariance = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        pose: _msg_geometry_msgs.PoseWithCovariance,
        /,
    ) -> None: ...

class Quaternion(_t.Message):
    x: _b.float
    y: _b.float
    z: _b.float
    w: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        x: _t.Float = ...,
        y: _t.Float = ...,
        z: _t.Float = ...,
        w: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, x: _t.Float, y: _t.Float, z: _t.Float, w: _t.Float, /) -> None: ...

class QuaternionStamped(_t.Message):
    header: _msg_std_msgs.Header
    quaternion: _msg_geometry_msgs.Quaternion
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        quaternion: _msg_geometry_msgs.Quaternion = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        quaternion: _msg_geometry_msgs.Quaternion,
        /,
    ) -> None: ...

class Transform(_t.Message):
    translation: _msg_geometry_msgs.Vector3
    rotation: _msg_geometry_msgs.Quaternion
    @_ty.overload
    def __init__(
        self,
        *,
        translation: _msg_geometry_msgs.Vector3 = ...,
        rotation: _msg_geometry_msgs.Quaternion = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        translation: _msg_geometry_msgs.Vector3,
        rotation: _msg_geometry_msgs.Quaternion,
        /,
    ) -> None: ...

class TransformStamped(_t.Message):
    header: _msg_std_msgs.Header
    child_frame_id: _b.str
    transform: _msg_geometry_msgs.Transform
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        child_frame_id: _t.Text = ...,
        transform: _msg_geometry_msgs.Transform = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        child_frame_id: _t.Text,
        transform: _msg_geometry_msgs.Transform,
        /,
    ) -> None: ...

class Twist(_t.Message):
    linear: _msg_geometry_msgs.Vector3
    angular: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        linear: _msg_geometry_msgs.Vector3 = ...,
        angular: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        linear: _msg_geometry_msgs.Vector3,
        angular: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class TwistStamped(_t.Message):
    header: _msg_std_msgs.Header
    twist: _msg_geometry_msgs.Twist
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        twist: _msg_geometry_msgs.Twist = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        twist: _msg_geometry_msgs.Twist,
        /,
    ) -> None: ...

class TwistWithCovariance(_t.Message):
    twist: _msg_geometry_msgs.Twist
    covariance: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        twist: _msg_geometry_msgs.Twist = ...,
        covariance: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, twist: _msg_geometry_msgs.Twist, covariance: _t.Floats, /) -> None: ...

class TwistWithCovarianceStamped(_t.Message):
    header: _msg_std_msgs.Header
    twist: _msg_geometry_msgs.TwistWithCovariance
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        twist: _msg_geometry_msgs.TwistWithCovariance = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        twist: _msg_geometry_msgs.TwistWithCovariance,
        /,
    ) -> None: ...

class Vector3(_t.Message):
    x: _b.float
    y: _b.float
    z: _b.float
    @_ty.overload
    def __init__(self, *, x: _t.Float = ..., y: _t.Float = ..., z: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, x: _t.Float, y: _t.Float, z: _t.Float, /) -> None: ...

class Vector3Stamped(_t.Message):
    header: _msg_std_msgs.Header
    vector: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        vector: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        vector: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class Wrench(_t.Message):
    force: _msg_geometry_msgs.Vector3
    torque: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        force: _msg_geometry_msgs.Vector3 = ...,
        torque: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        force: _msg_geometry_msgs.Vector3,
        torque: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class WrenchStamped(_t.Message):
    header: _msg_std_msgs.Header
    wrench: _msg_geometry_msgs.Wrench
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        wrench: _msg_geometry_msgs.Wrench = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        wrench: _msg_geometry_msgs.Wrench,
        /,
    ) -> None: ...
