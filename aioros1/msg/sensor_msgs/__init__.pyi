# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.sensor_msgs as _msg_sensor_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class BatteryState(_t.Message):
    POWER_SUPPLY_STATUS_UNKNOWN: _ty.Final = 0
    POWER_SUPPLY_STATUS_CHARGING: _ty.Final = 1
    POWER_SUPPLY_STATUS_DISCHARGING: _ty.Final = 2
    POWER_SUPPLY_STATUS_NOT_CHARGING: _ty.Final = 3
    POWER_SUPPLY_STATUS_FULL: _ty.Final = 4
    POWER_SUPPLY_HEALTH_UNKNOWN: _ty.Final = 0
    POWER_SUPPLY_HEALTH_GOOD: _ty.Final = 1
    POWER_SUPPLY_HEALTH_OVERHEAT: _ty.Final = 2
    POWER_SUPPLY_HEALTH_DEAD: _ty.Final = 3
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: _ty.Final = 4
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: _ty.Final = 5
    POWER_SUPPLY_HEALTH_COLD: _ty.Final = 6
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: _ty.Final = 7
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: _ty.Final = 8
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: _ty.Final = 0
    POWER_SUPPLY_TECHNOLOGY_NIMH: _ty.Final = 1
    POWER_SUPPLY_TECHNOLOGY_LION: _ty.Final = 2
    POWER_SUPPLY_TECHNOLOGY_LIPO: _ty.Final = 3
    POWER_SUPPLY_TECHNOLOGY_LIFE: _ty.Final = 4
    POWER_SUPPLY_TECHNOLOGY_NICD: _ty.Final = 5
    POWER_SUPPLY_TECHNOLOGY_LIMN: _ty.Final = 6
    header: _msg_std_msgs.Header
    voltage: _b.float
    temperature: _b.float
    current: _b.float
    charge: _b.float
    capacity: _b.float
    design_capacity: _b.float
    percentage: _b.float
    power_supply_status: _b.int
    power_supply_health: _b.int
    power_supply_technology: _b.int
    present: _b.bool
    cell_voltage: _t.FloatArray
    cell_temperature: _t.FloatArray
    location: _b.str
    serial_number: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        voltage: _t.Float = ...,
        temperature: _t.Float = ...,
        current: _t.Float = ...,
        charge: _t.Float = ...,
        capacity: _t.Float = ...,
        design_capacity: _t.Float = ...,
        percentage: _t.Float = ...,
        power_supply_status: _t.Int = ...,
        power_supply_health: _t.Int = ...,
        power_supply_technology: _t.Int = ...,
        present: _t.Bool = ...,
        cell_voltage: _t.Floats = ...,
        cell_temperature: _t.Floats = ...,
        location: _t.Text = ...,
        serial_number: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        voltage: _t.Float,
        temperature: _t.Float,
        current: _t.Float,
        charge: _t.Float,
        capacity: _t.Float,
        design_capacity: _t.Float,
        percentage: _t.Float,
        power_supply_status: _t.Int,
        power_supply_health: _t.Int,
        power_supply_technology: _t.Int,
        present: _t.Bool,
        cell_voltage: _t.Floats,
        cell_temperature: _t.Floats,
        location: _t.Text,
        serial_number: _t.Text,
        /,
    ) -> None: ...

class CameraInfo(_t.Message):
    header: _msg_std_msgs.Header
    height: _b.int
    width: _b.int
    distortion_model: _b.str
    D: _t.FloatArray
    K: _t.FloatArray
    R: _t.FloatArray
    P: _t.FloatArray
    binning_x: _b.int
    binning_y: _b.int
    roi: _msg_sensor_msgs.RegionOfInterest
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        height: _t.Int = ...,
        width: _t.Int = ...,
        distortion_model: _t.Text = ...,
        D: _t.Floats = ...,
        K: _t.Floats = ...,
        R: _t.Floats = ...,
        P: _t.Floats = ...,
        binning_x: _t.Int = ...,
        binning_y: _t.Int = ...,
        roi: _msg_sensor_msgs.RegionOfInterest = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        height: _t.Int,
        width: _t.Int,
        distortion_model: _t.Text,
        D: _t.Floats,
        K: _t.Floats,
        R: _t.Floats,
        P: _t.Floats,
        binning_x: _t.Int,
        binning_y: _t.Int,
        roi: _msg_sensor_msgs.RegionOfInterest,
        /,
    ) -> None: ...

class ChannelFloat32(_t.Message):
    name: _b.str
    values: _t.FloatArray
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., values: _t.Floats = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, values: _t.Floats, /) -> None: ...

class CompressedImage(_t.Message):
    header: _msg_std_msgs.Header
    format: _b.str
    data: _t.OctetArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        format: _t.Text = ...,
        data: _t.Octets = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        format: _t.Text,
        data: _t.Octets,
        /,
    ) -> None: ...

class FluidPressure(_t.Message):
    header: _msg_std_msgs.Header
    fluid_pressure: _b.float
    variance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        fluid_pressure: _t.Float = ...,
        variance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        fluid_pressure: _t.Float,
        variance: _t.Float,
        /,
    ) -> None: ...

class Illuminance(_t.Message):
    header: _msg_std_msgs.Header
    illuminance: _b.float
    variance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        illuminance: _t.Float = ...,
        variance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        illuminance: _t.Float,
        variance: _t.Float,
        /,
    ) -> None: ...

class Image(_t.Message):
    header: _msg_std_msgs.Header
    height: _b.int
    width: _b.int
    encoding: _b.str
    is_bigendian: _b.int
    step: _b.int
    data: _t.OctetArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        height: _t.Int = ...,
        width: _t.Int = ...,
        encoding: _t.Text = ...,
        is_bigendian: _t.Int = ...,
        step: _t.Int = ...,
        data: _t.Octets = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        height: _t.Int,
        width: _t.Int,
        encoding: _t.Text,
        is_bigendian: _t.Int,
        step: _t.Int,
        data: _t.Octets,
        /,
    ) -> None: ...

class Imu(_t.Message):
    header: _msg_std_msgs.Header
    orientation: _msg_geometry_msgs.Quaternion
    orientation_covariance: _t.FloatArray
    angular_velocity: _msg_geometry_msgs.Vector3
    angular_velocity_covariance: _t.FloatArray
    linear_acceleration: _msg_geometry_msgs.Vector3
    linear_acceleration_covariance: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
        orientation_covariance: _t.Floats = ...,
        angular_velocity: _msg_geometry_msgs.Vector3 = ...,
        angular_velocity_covariance: _t.Floats = ...,
        linear_acceleration: _msg_geometry_msgs.Vector3 = ...,
        linear_acceleration_covariance: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        orientation: _msg_geometry_msgs.Quaternion,
        orientation_covariance: _t.Floats,
        angular_velocity: _msg_geometry_msgs.Vector3,
        angular_velocity_covariance: _t.Floats,
        linear_acceleration: _msg_geometry_msgs.Vector3,
        linear_acceleration_covariance: _t.Floats,
        /,
    ) -> None: ...

class JointState(_t.Message):
    header: _msg_std_msgs.Header
    name: _t.TextList
    position: _t.FloatArray
    velocity: _t.FloatArray
    effort: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        name: _t.Texts = ...,
        position: _t.Floats = ...,
        velocity: _t.Floats = ...,
        effort: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        name: _t.Texts,
        position: _t.Floats,
        velocity: _t.Floats,
        effort: _t.Floats,
        /,
    ) -> None: ...

class Joy(_t.Message):
    header: _msg_std_msgs.Header
    axes: _t.FloatArray
    buttons: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        axes: _t.Floats = ...,
        buttons: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        axes: _t.Floats,
        buttons: _t.Ints,
        /,
    ) -> None: ...

class JoyFeedback(_t.Message):
    TYPE_LED: _ty.Final = 0
    TYPE_RUMBLE: _ty.Final = 1
    TYPE_BUZZER: _ty.Final = 2
    type: _b.int
    id: _b.int
    intensity: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        type: _t.Int = ...,
        id: _t.Int = ...,
        intensity: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Int, id: _t.Int, intensity: _t.Float, /) -> None: ...

class JoyFeedbackArray(_t.Message):
    array: _t.ItemList[_msg_sensor_msgs.JoyFeedback]
    @_ty.overload
    def __init__(self, *, array: _t.Items[_msg_sensor_msgs.JoyFeedback] = ...) -> None: ...
    @_ty.overload
    def __init__(self, array: _t.Items[_msg_sensor_msgs.JoyFeedback], /) -> None: ...

class LaserEcho(_t.Message):
    echoes: _t.FloatArray
    @_ty.overload
    def __init__(self, *, echoes: _t.Floats = ...) -> None: ...
    @_ty.overload
    def __init__(self, echoes: _t.Floats, /) -> None: ...

class LaserScan(_t.Message):
    header: _msg_std_msgs.Header
    angle_min: _b.float
    angle_max: _b.float
    angle_increment: _b.float
    time_increment: _b.float
    scan_time: _b.float
    range_min: _b.float
    range_max: _b.float
    ranges: _t.FloatArray
    intensities: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        angle_min: _t.Float = ...,
        angle_max: _t.Float = ...,
        angle_increment: _t.Float = ...,
        time_increment: _t.Float = ...,
        scan_time: _t.Float = ...,
        range_min: _t.Float = ...,
        range_max: _t.Float = ...,
        ranges: _t.Floats = ...,
        intensities: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        angle_min: _t.Float,
        angle_max: _t.Float,
        angle_increment: _t.Float,
        time_increment: _t.Float,
        scan_time: _t.Float,
        range_min: _t.Float,
        range_max: _t.Float,
        ranges: _t.Floats,
        intensities: _t.Floats,
        /,
    ) -> None: ...

class MagneticField(_t.Message):
    header: _msg_std_msgs.Header
    magnetic_field: _msg_geometry_msgs.Vector3
    magnetic_field_covariance: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        magnetic_field: _msg_geometry_msgs.Vector3 = ...,
        magnetic_field_covariance: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        magnetic_field: _msg_geometry_msgs.Vector3,
        magnetic_field_covariance: _t.Floats,
        /,
    ) -> None: ...

class MultiDOFJointState(_t.Message):
    header: _msg_std_msgs.Header
    joint_names: _t.TextList
    transforms: _t.ItemList[_msg_geometry_msgs.Transform]
    twist: _t.ItemList[_msg_geometry_msgs.Twist]
    wrench: _t.ItemList[_msg_geometry_msgs.Wrench]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        joint_names: _t.Texts = ...,
        transforms: _t.Items[_msg_geometry_msgs.Transform] = ...,
        twist: _t.Items[_msg_geometry_msgs.Twist] = ...,
        wrench: _t.Items[_msg_geometry_msgs.Wrench] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        joint_names: _t.Texts,
        transforms: _t.Items[_msg_geometry_msgs.Transform],
        twist: _t.Items[_msg_geometry_msgs.Twist],
        wrench: _t.Items[_msg_geometry_msgs.Wrench],
        /,
    ) -> None: ...

class MultiEchoLaserScan(_t.Message):
    header: _msg_std_msgs.Header
    angle_min: _b.float
    angle_max: _b.float
    angle_increment: _b.float
    time_increment: _b.float
    scan_time: _b.float
    range_min: _b.float
    range_max: _b.float
    ranges: _t.ItemList[_msg_sensor_msgs.LaserEcho]
    intensities: _t.ItemList[_msg_sensor_msgs.LaserEcho]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        angle_min: _t.Float = ...,
        angle_max: _t.Float = ...,
        angle_increment: _t.Float = ...,
        time_increment: _t.Float = ...,
        scan_time: _t.Float = ...,
        range_min: _t.Float = ...,
        range_max: _t.Float = ...,
        ranges: _t.Items[_msg_sensor_msgs.LaserEcho] = ...,
        intensities: _t.Items[_msg_sensor_msgs.LaserEcho] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        angle_min: _t.Float,
        angle_max: _t.Float,
        angle_increment: _t.Float,
        time_increment: _t.Float,
        scan_time: _t.Float,
        range_min: _t.Float,
        range_max: _t.Float,
        ranges: _t.Items[_msg_sensor_msgs.LaserEcho],
        intensities: _t.Items[_msg_sensor_msgs.LaserEcho],
        /,
    ) -> None: ...

class NavSatFix(_t.Message):
    COVARIANCE_TYPE_UNKNOWN: _ty.Final = 0
    COVARIANCE_TYPE_APPROXIMATED: _ty.Final = 1
    COVARIANCE_TYPE_DIAGONAL_KNOWN: _ty.Final = 2
    COVARIANCE_TYPE_KNOWN: _ty.Final = 3
    header: _msg_std_msgs.Header
    status: _msg_sensor_msgs.NavSatStatus
    latitude: _b.float
    longitude: _b.float
    altitude: _b.float
    position_covariance: _t.FloatArray
    position_covariance_type: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        status: _msg_sensor_msgs.NavSatStatus = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        altitude: _t.Float = ...,
        position_covariance: _t.Floats = ...,
        position_covariance_type: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        status: _msg_sensor_msgs.NavSatStatus,
        latitude: _t.Float,
        longitude: _t.Float,
        altitude: _t.Float,
        position_covariance: _t.Floats,
        position_covariance_type: _t.Int,
        /,
    ) -> None: ...

class NavSatStatus(_t.Message):
    STATUS_NO_FIX: _ty.Final = -1
    STATUS_FIX: _ty.Final = 0
    STATUS_SBAS_FIX: _ty.Final = 1
    STATUS_GBAS_FIX: _ty.Final = 2
    SERVICE_GPS: _ty.Final = 1
    SERVICE_GLONASS: _ty.Final = 2
    SERVICE_COMPASS: _ty.Final = 4
    SERVICE_GALILEO: _ty.Final = 8
    status: _b.int
    service: _b.int
    @_ty.overload
    def __init__(self, *, status: _t.Int = ..., service: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, status: _t.Int, service: _t.Int, /) -> None: ...

class PointCloud(_t.Message):
    header: _msg_std_msgs.Header
    points: _t.ItemList[_msg_geometry_msgs.Point32]
    channels: _t.ItemList[_msg_sensor_msgs.ChannelFloat32]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        points: _t.Items[_msg_geometry_msgs.Point32] = ...,
        channels: _t.Items[_msg_sensor_msgs.ChannelFloat32] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        points: _t.Items[_msg_geometry_msgs.Point32],
        channels: _t.Items[_msg_sensor_msgs.ChannelFloat32],
        /,
    ) -> None: ...

class PointCloud2(_t.Message):
    header: _msg_std_msgs.Header
    height: _b.int
    width: _b.int
    fields: _t.ItemList[_msg_sensor_msgs.PointField]
    is_bigendian: _b.bool
    point_step: _b.int
    row_step: _b.int
    data: _t.OctetArray
    is_dense: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        height: _t.Int = ...,
        width: _t.Int = ...,
        fields: _t.Items[_msg_sensor_msgs.PointField] = ...,
        is_bigendian: _t.Bool = ...,
        point_step: _t.Int = ...,
        row_step: _t.Int = ...,
        data: _t.Octets = ...,
        is_dense: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        height: _t.Int,
        width: _t.Int,
        fields: _t.Items[_msg_sensor_msgs.PointField],
        is_bigendian: _t.Bool,
        point_step: _t.Int,
        row_step: _t.Int,
        data: _t.Octets,
        is_dense: _t.Bool,
        /,
    ) -> None: ...

class PointField(_t.Message):
    INT8: _ty.Final = 1
    UINT8: _ty.Final = 2
    INT16: _ty.Final = 3
    UINT16: _ty.Final = 4
    INT32: _ty.Final = 5
    UINT32: _ty.Final = 6
    FLOAT32: _ty.Final = 7
    FLOAT64: _ty.Final = 8
    name: _b.str
    offset: _b.int
    datatype: _b.int
    count: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Text = ...,
        offset: _t.Int = ...,
        datatype: _t.Int = ...,
        count: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        name: _t.Text,
        offset: _t.Int,
        datatype: _t.Int,
        count: _t.Int,
        /,
    ) -> None: ...

class Range(_t.Message):
    ULTRASOUND: _ty.Final = 0
    INFRARED: _ty.Final = 1
    header: _msg_std_msgs.Header
    radiation_type: _b.int
    field_of_view: _b.float
    min_range: _b.float
    max_range: _b.float
    range: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        radiation_type: _t.Int = ...,
        field_of_view: _t.Float = ...,
        min_range: _t.Float = ...,
        max_range: _t.Float = ...,
        range: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        radiation_type: _t.Int,
        field_of_view: _t.Float,
        min_range: _t.Float,
        max_range: _t.Float,
        range: _t.Float,
        /,
    ) -> None: ...

class RegionOfInterest(_t.Message):
    x_offset: _b.int
    y_offset: _b.int
    height: _b.int
    width: _b.int
    do_rectify: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        x_offset: _t.Int = ...,
        y_offset: _t.Int = ...,
        height: _t.Int = ...,
        width: _t.Int = ...,
        do_rectify: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        x_offset: _t.Int,
        y_offset: _t.Int,
        height: _t.Int,
        width: _t.Int,
        do_rectify: _t.Bool,
        /,
    ) -> None: ...

class RelativeHumidity(_t.Message):
    header: _msg_std_msgs.Header
    relative_humidity: _b.float
    variance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        relative_humidity: _t.Float = ...,
        variance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        relative_humidity: _t.Float,
        variance: _t.Float,
        /,
    ) -> None: ...

class Temperature(_t.Message):
    header: _msg_std_msgs.Header
    temperature: _b.float
    variance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        temperature: _t.Float = ...,
        variance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        temperature: _t.Float,
        variance: _t.Float,
        /,
    ) -> None: ...

class TimeReference(_t.Message):
    header: _msg_std_msgs.Header
    time_ref: _t.Time
    source: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        time_ref: _t.Time = ...,
        source: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        time_ref: _t.Time,
        source: _t.Text,
        /,
    ) -> None: ...
