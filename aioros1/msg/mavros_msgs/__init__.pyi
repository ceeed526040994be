# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geographic_msgs as _msg_geographic_msgs
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.mavros_msgs as _msg_mavros_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class ADSBVehicle(_t.Message):
    ALT_PRESSURE_QNH: _ty.Final = 0
    ALT_GEOMETRIC: _ty.Final = 1
    EMITTER_NO_INFO: _ty.Final = 0
    EMITTER_LIGHT: _ty.Final = 1
    EMITTER_SMALL: _ty.Final = 2
    EMITTER_LARGE: _ty.Final = 3
    EMITTER_HIGH_VORTEX_LARGE: _ty.Final = 4
    EMITTER_HEAVY: _ty.Final = 5
    EMITTER_HIGHLY_MANUV: _ty.Final = 6
    EMITTER_ROTOCRAFT: _ty.Final = 7
    EMITTER_UNASSIGNED: _ty.Final = 8
    EMITTER_GLIDER: _ty.Final = 9
    EMITTER_LIGHTER_AIR: _ty.Final = 10
    EMITTER_PARACHUTE: _ty.Final = 11
    EMITTER_ULTRA_LIGHT: _ty.Final = 12
    EMITTER_UNASSIGNED2: _ty.Final = 13
    EMITTER_UAV: _ty.Final = 14
    EMITTER_SPACE: _ty.Final = 15
    EMITTER_UNASSGINED3: _ty.Final = 16
    EMITTER_EMERGENCY_SURFACE: _ty.Final = 17
    EMITTER_SERVICE_SURFACE: _ty.Final = 18
    EMITTER_POINT_OBSTACLE: _ty.Final = 19
    FLAG_VALID_COORDS: _ty.Final = 1
    FLAG_VALID_ALTITUDE: _ty.Final = 2
    FLAG_VALID_HEADING: _ty.Final = 4
    FLAG_VALID_VELOCITY: _ty.Final = 8
    FLAG_VALID_CALLSIGN: _ty.Final = 16
    FLAG_VALID_SQUAWK: _ty.Final = 32
    FLAG_SIMULATED: _ty.Final = 64
    FLAG_VERTICAL_VELOCITY_VALID: _ty.Final = 128
    FLAG_BARO_VALID: _ty.Final = 256
    FLAG_SOURCE_UAT: _ty.Final = 32768
    header: _msg_std_msgs.Header
    ICAO_address: _b.int
    callsign: _b.str
    latitude: _b.float
    longitude: _b.float
    altitude: _b.float
    heading: _b.float
    hor_velocity: _b.float
    ver_velocity: _b.float
    altitude_type: _b.int
    emitter_type: _b.int
    tslc: _t.Duration
    flags: _b.int
    squawk: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        ICAO_address: _t.Int = ...,
        callsign: _t.Text = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        altitude: _t.Float = ...,
        heading: _t.Float = ...,
        hor_velocity: _t.Float = ...,
        ver_velocity: _t.Float = ...,
        altitude_type: _t.Int = ...,
        emitter_type: _t.Int = ...,
        tslc: _t.Duration = ...,
        flags: _t.Int = ...,
        squawk: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        ICAO_address: _t.Int,
        callsign: _t.Text,
        latitude: _t.Float,
        longitude: _t.Float,
        altitude: _t.Float,
        heading: _t.Float,
        hor_velocity: _t.Float,
        ver_velocity: _t.Float,
        altitude_type: _t.Int,
        emitter_type: _t.Int,
        tslc: _t.Duration,
        flags: _t.Int,
        squawk: _t.Int,
        /,
    ) -> None: ...

class ActuatorControl(_t.Message):
    PX4_MIX_FLIGHT_CONTROL: _ty.Final = 0
    PX4_MIX_FLIGHT_CONTROL_VTOL_ALT: _ty.Final = 1
    PX4_MIX_PAYLOAD: _ty.Final = 2
    PX4_MIX_MANUAL_PASSTHROUGH: _ty.Final = 3
    header: _msg_std_msgs.Header
    group_mix: _b.int
    controls: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        group_mix: _t.Int = ...,
        controls: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        group_mix: _t.Int,
        controls: _t.Floats,
        /,
    ) -> None: ...

class Altitude(_t.Message):
    header: _msg_std_msgs.Header
    monotonic: _b.float
    amsl: _b.float
    local: _b.float
    relative: _b.float
    terrain: _b.float
    bottom_clearance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        monotonic: _t.Float = ...,
        amsl: _t.Float = ...,
        local: _t.Float = ...,
        relative: _t.Float = ...,
        terrain: _t.Float = ...,
        bottom_clearance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        monotonic: _t.Float,
        amsl: _t.Float,
        local: _t.Float,
        relative: _t.Float,
        terrain: _t.Float,
        bottom_clearance: _t.Float,
        /,
    ) -> None: ...

class AttitudeTarget(_t.Message):
    IGNORE_ROLL_RATE: _ty.Final = 1
    IGNORE_PITCH_RATE: _ty.Final = 2
    IGNORE_YAW_RATE: _ty.Final = 4
    IGNORE_THRUST: _ty.Final = 64
    IGNORE_ATTITUDE: _ty.Final = 128
    header: _msg_std_msgs.Header
    type_mask: _b.int
    orientation: _msg_geometry_msgs.Quaternion
    body_rate: _msg_geometry_msgs.Vector3
    thrust: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        type_mask: _t.Int = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
        body_rate: _msg_geometry_msgs.Vector3 = ...,
        thrust: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        type_mask: _t.Int,
        orientation: _msg_geometry_msgs.Quaternion,
        body_rate: _msg_geometry_msgs.Vector3,
        thrust: _t.Float,
        /,
    ) -> None: ...

class BatteryStatus(_t.Message):
    header: _msg_std_msgs.Header
    voltage: _b.float
    current: _b.float
    remaining: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        voltage: _t.Float = ...,
        current: _t.Float = ...,
        remaining: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        voltage: _t.Float,
        current: _t.Float,
        remaining: _t.Float,
        /,
    ) -> None: ...

class CamIMUStamp(_t.Message):
    frame_stamp: _t.Time
    frame_seq_id: _b.int
    @_ty.overload
    def __init__(self, *, frame_stamp: _t.Time = ..., frame_seq_id: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, frame_stamp: _t.Time, frame_seq_id: _t.Int, /) -> None: ...

class CameraImageCaptured(_t.Message):
    header: _msg_std_msgs.Header
    orientation: _msg_geometry_msgs.Quaternion
    geo: _msg_geographic_msgs.GeoPoint
    relative_alt: _b.float
    image_index: _b.int
    capture_result: _b.int
    file_url: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
        geo: _msg_geographic_msgs.GeoPoint = ...,
        relative_alt: _t.Float = ...,
        image_index: _t.Int = ...,
        capture_result: _t.Int = ...,
        file_url: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        orientation: _msg_geometry_msgs.Quaternion,
        geo: _msg_geographic_msgs.GeoPoint,
        relative_alt: _t.Float,
        image_index: _t.Int,
        capture_result: _t.Int,
        file_url: _t.Text,
        /,
    ) -> None: ...

class CellularStatus(_t.Message):
    status: _b.int
    failure_reason: _b.int
    type: _b.int
    quality: _b.int
    mcc: _b.int
    mnc: _b.int
    lac: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        status: _t.Int = ...,
        failure_reason: _t.Int = ...,
        type: _t.Int = ...,
        quality: _t.Int = ...,
        mcc: _t.Int = ...,
        mnc: _t.Int = ...,
        lac: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        status: _t.Int,
        failure_reason: _t.Int,
        type: _t.Int,
        quality: _t.Int,
        mcc: _t.Int,
        mnc: _t.Int,
        lac: _t.Int,
        /,
    ) -> None: ...

class CommandCode(_t.Message):
    AIRFRAME_CONFIGURATION: _ty.Final = 2520
    ARM_AUTHORIZATION_REQUEST: _ty.Final = 3001
    CAMERA_TRACK_POINT: _ty.Final = 2004
    CAMERA_TRACK_RECTANGLE: _ty.Final = 2005
    CAMERA_STOP_TRACKING: _ty.Final = 2010
    CAN_FORWARD: _ty.Final = 32000
    COMPONENT_ARM_DISARM: _ty.Final = 400
    CONDITION_DELAY: _ty.Final = 112
    CONDITION_CHANGE_ALT: _ty.Final = 113
    CONDITION_DISTANCE: _ty.Final = 114
    CONDITION_YAW: _ty.Final = 115
    CONDITION_LAST: _ty.Final = 159
    CONTROL_HIGH_LATENCY: _ty.Final = 2600
    DO_FOLLOW: _ty.Final = 32
    DO_FOLLOW_REPOSITION: _ty.Final = 33
    DO_SET_MODE: _ty.Final = 176
    DO_JUMP: _ty.Final = 177
    DO_CHANGE_SPEED: _ty.Final = 178
    DO_SET_HOME: _ty.Final = 179
    DO_SET_PARAMETER: _ty.Final = 180
    DO_SET_RELAY: _ty.Final = 181
    DO_REPEAT_RELAY: _ty.Final = 182
    DO_SET_SERVO: _ty.Final = 183
    DO_REPEAT_SERVO: _ty.Final = 184
    DO_FLIGHTTERMINATION: _ty.Final = 185
    DO_CHANGE_ALTITUDE: _ty.Final = 186
    DO_RETURN_PATH_START: _ty.Final = 188
    DO_LAND_START: _ty.Final = 189
    DO_RALLY_LAND: _ty.Final = 190
    DO_GO_AROUND: _ty.Final = 191
    DO_REPOSITION: _ty.Final = 192
    DO_PAUSE_CONTINUE: _ty.Final = 193
    DO_SET_REVERSE: _ty.Final = 194
    DO_SET_ROI_LOCATION: _ty.Final = 195
    DO_SET_ROI_WPNEXT_OFFSET: _ty.Final = 196
    DO_SET_ROI_NONE: _ty.Final = 197
    DO_SET_ROI_SYSID: _ty.Final = 198
    DO_CONTROL_VIDEO: _ty.Final = 200
    DO_SET_ROI: _ty.Final = 201
    DO_DIGICAM_CONFIGURE: _ty.Final = 202
    DO_DIGICAM_CONTROL: _ty.Final = 203
    DO_MOUNT_CONFIGURE: _ty.Final = 204
    DO_MOUNT_CONTROL: _ty.Final = 205
    DO_SET_CAM_TRIGG_DIST: _ty.Final = 206
    DO_FENCE_ENABLE: _ty.Final = 207
    DO_PARACHUTE: _ty.Final = 208
    DO_MOTOR_TEST: _ty.Final = 209
    DO_INVERTED_FLIGHT: _ty.Final = 210
    DO_GRIPPER: _ty.Final = 211
    DO_AUTOTUNE_ENABLE: _ty.Final = 212
    DO_SET_CAM_TRIGG_INTERVAL: _ty.Final = 214
    DO_MOUNT_CONTROL_QUAT: _ty.Final = 220
    DO_GUIDED_MASTER: _ty.Final = 221
    DO_GUIDED_LIMITS: _ty.Final = 222
    DO_ENGINE_CONTROL: _ty.Final = 223
    DO_SET_MISSION_CURRENT: _ty.Final = 224
    DO_LAST: _ty.Final = 240
    DO_JUMP_TAG: _ty.Final = 601
    DO_GIMBAL_MANAGER_PITCHYAW: _ty.Final = 1000
    DO_GIMBAL_MANAGER_CONFIGURE: _ty.Final = 1001
    DO_TRIGGER_CONTROL: _ty.Final = 2003
    DO_VTOL_TRANSITION: _ty.Final = 3000
    DO_SET_SAFETY_SWITCH_STATE: _ty.Final = 5300
    DO_ADSB_OUT_IDENT: _ty.Final = 10001
    DO_WINCH: _ty.Final = 42600
    EXTERNAL_POSITION_ESTIMATE: _ty.Final = 43003
    FIXED_MAG_CAL_YAW: _ty.Final = 42006
    GET_HOME_POSITION: _ty.Final = 410
    GET_MESSAGE_INTERVAL: _ty.Final = 510
    IMAGE_START_CAPTURE: _ty.Final = 2000
    IMAGE_STOP_CAPTURE: _ty.Final = 2001
    JUMP_TAG: _ty.Final = 600
    LOGGING_START: _ty.Final = 2510
    LOGGING_STOP: _ty.Final = 2511
    MISSION_START: _ty.Final = 300
    NAV_WAYPOINT: _ty.Final = 16
    NAV_LOITER_UNLIM: _ty.Final = 17
    NAV_LOITER_TURNS: _ty.Final = 18
    NAV_LOITER_TIME: _ty.Final = 19
    NAV_RETURN_TO_LAUNCH: _ty.Final = 20
    NAV_LAND: _ty.Final = 21
    NAV_TAKEOFF: _ty.Final = 22
    NAV_LAND_LOCAL: _ty.Final = 23
    NAV_TAKEOFF_LOCAL: _ty.Final = 24
    NAV_FOLLOW: _ty.Final = 25
    NAV_CONTINUE_AND_CHANGE_ALT: _ty.Final = 30
    NAV_LOITER_TO_ALT: _ty.Final = 31
    NAV_ROI: _ty.Final = 80
    NAV_PATHPLANNING: _ty.Final = 81
    NAV_SPLINE_WAYPOINT: _ty.Final = 82
    NAV_VTOL_TAKEOFF: _ty.Final = 84
    NAV_VTOL_LAND: _ty.Final = 85
    NAV_GUIDED_ENABLE: _ty.Final = 92
    NAV_DELAY: _ty.Final = 93
    NAV_PAYLOAD_PLACE: _ty.Final = 94
    NAV_LAST: _ty.Final = 95
    NAV_SET_YAW_SPEED: _ty.Final = 213
    NAV_FENCE_RETURN_POINT: _ty.Final = 5000
    NAV_FENCE_POLYGON_VERTEX_INCLUSION: _ty.Final = 5001
    NAV_FENCE_POLYGON_VERTEX_EXCLUSION: _ty.Final = 5002
    NAV_FENCE_CIRCLE_INCLUSION: _ty.Final = 5003
    NAV_FENCE_CIRCLE_EXCLUSION: _ty.Final = 5004
    NAV_RALLY_POINT: _ty.Final = 5100
    OBLIQUE_SURVEY: _ty.Final = 260
    OVERRIDE_GOTO: _ty.Final = 252
    PANORAMA_CREATE: _ty.Final = 2800
    PAYLOAD_PREPARE_DEPLOY: _ty.Final = 30001
    PAYLOAD_CONTROL_DEPLOY: _ty.Final = 30002
    PREFLIGHT_CALIBRATION: _ty.Final = 241
    PREFLIGHT_SET_SENSOR_OFFSETS: _ty.Final = 242
    PREFLIGHT_UAVCAN: _ty.Final = 243
    PREFLIGHT_STORAGE: _ty.Final = 245
    PREFLIGHT_REBOOT_SHUTDOWN: _ty.Final = 246
    REQUEST_MESSAGE: _ty.Final = 512
    REQUEST_PROTOCOL_VERSION: _ty.Final = 519
    REQUEST_AUTOPILOT_CAPABILITIES: _ty.Final = 520
    REQUEST_CAMERA_INFORMATION: _ty.Final = 521
    REQUEST_CAMERA_SETTINGS: _ty.Final = 522
    REQUEST_STORAGE_INFORMATION: _ty.Final = 525
    REQUEST_CAMERA_CAPTURE_STATUS: _ty.Final = 527
    REQUEST_FLIGHT_INFORMATION: _ty.Final = 528
    REQUEST_VIDEO_STREAM_INFORMATION: _ty.Final = 2504
    REQUEST_VIDEO_STREAM_STATUS: _ty.Final = 2505
    RESET_CAMERA_SETTINGS: _ty.Final = 529
    RUN_PREARM_CHECKS: _ty.Final = 401
    SET_MESSAGE_INTERVAL: _ty.Final = 511
    SET_CAMERA_MODE: _ty.Final = 530
    SET_CAMERA_ZOOM: _ty.Final = 531
    SET_CAMERA_FOCUS: _ty.Final = 532
    SET_STORAGE_USAGE: _ty.Final = 533
    SET_CAMERA_SOURCE: _ty.Final = 534
    SET_GUIDED_SUBMODE_STANDARD: _ty.Final = 4000
    SET_GUIDED_SUBMODE_CIRCLE: _ty.Final = 4001
    START_RX_PAIR: _ty.Final = 500
    STORAGE_FORMAT: _ty.Final = 526
    UAVCAN_GET_NODE_INFO: _ty.Final = 5200
    VIDEO_START_CAPTURE: _ty.Final = 2500
    VIDEO_STOP_CAPTURE: _ty.Final = 2501
    VIDEO_START_STREAMING: _ty.Final = 2502
    VIDEO_STOP_STREAMING: _ty.Final = 2503
    def __init__(self) -> None: ...

class CompanionProcessStatus(_t.Message):
    MAV_STATE_UNINIT: _ty.Final = 0
    MAV_STATE_BOOT: _ty.Final = 1
    MAV_STATE_CALIBRATING: _ty.Final = 2
    MAV_STATE_STANDBY: _ty.Final = 3
    MAV_STATE_ACTIVE: _ty.Final = 4
    MAV_STATE_CRITICAL: _ty.Final = 5
    MAV_STATE_EMERGENCY: _ty.Final = 6
    MAV_STATE_POWEROFF: _ty.Final = 7
    MAV_STATE_FLIGHT_TERMINATION: _ty.Final = 8
    MAV_COMP_ID_OBSTACLE_AVOIDANCE: _ty.Final = 196
    MAV_COMP_ID_VISUAL_INERTIAL_ODOMETRY: _ty.Final = 197
    header: _msg_std_msgs.Header
    state: _b.int
    component: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        state: _t.Int = ...,
        component: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        state: _t.Int,
        component: _t.Int,
        /,
    ) -> None: ...

class DebugValue(_t.Message):
    TYPE_DEBUG: _ty.Final = 0
    TYPE_DEBUG_VECT: _ty.Final = 1
    TYPE_DEBUG_FLOAT_ARRAY: _ty.Final = 2
    TYPE_NAMED_VALUE_FLOAT: _ty.Final = 3
    TYPE_NAMED_VALUE_INT: _ty.Final = 4
    header: _msg_std_msgs.Header
    index: _b.int
    array_id: _b.int
    name: _b.str
    value_float: _b.float
    value_int: _b.int
    data: _t.FloatArray
    type: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        index: _t.Int = ...,
        array_id: _t.Int = ...,
        name: _t.Text = ...,
        value_float: _t.Float = ...,
        value_int: _t.Int = ...,
        data: _t.Floats = ...,
        type: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        index: _t.Int,
        array_id: _t.Int,
        name: _t.Text,
        value_float: _t.Float,
        value_int: _t.Int,
        data: _t.Floats,
        type: _t.Int,
        /,
    ) -> None: ...

class ESCInfo(_t.Message):
    header: _msg_std_msgs.Header
    counter: _b.int
    count: _b.int
    connection_type: _b.int
    info: _b.int
    esc_info: _t.ItemList[_msg_mavros_msgs.ESCInfoItem]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        counter: _t.Int = ...,
        count: _t.Int = ...,
        connection_type: _t.Int = ...,
        info: _t.Int = ...,
        esc_info: _t.Items[_msg_mavros_msgs.ESCInfoItem] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        counter: _t.Int,
        count: _t.Int,
        connection_type: _t.Int,
        info: _t.Int,
        esc_info: _t.Items[_msg_mavros_msgs.ESCInfoItem],
        /,
    ) -> None: ...

class ESCInfoItem(_t.Message):
    header: _msg_std_msgs.Header
    failure_flags: _b.int
    error_count: _b.int
    temperature: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        failure_flags: _t.Int = ...,
        error_count: _t.Int = ...,
        temperature: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        failure_flags: _t.Int,
        error_count: _t.Int,
        temperature: _t.Int,
        /,
    ) -> None: ...

class ESCStatus(_t.Message):
    header: _msg_std_msgs.Header
    esc_status: _t.ItemList[_msg_mavros_msgs.ESCStatusItem]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        esc_status: _t.Items[_msg_mavros_msgs.ESCStatusItem] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        esc_status: _t.Items[_msg_mavros_msgs.ESCStatusItem],
        /,
    ) -> None: ...

class ESCStatusItem(_t.Message):
    header: _msg_std_msgs.Header
    rpm: _b.int
    voltage: _b.float
    current: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        rpm: _t.Int = ...,
        voltage: _t.Float = ...,
        current: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        rpm: _t.Int,
        voltage: _t.Float,
        current: _t.Float,
        /,
    ) -> None: ...

class ESCTelemetry(_t.Message):
    header: _msg_std_msgs.Header
    esc_telemetry: _t.ItemList[_msg_mavros_msgs.ESCTelemetryItem]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        esc_telemetry: _t.Items[_msg_mavros_msgs.ESCTelemetryItem] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        esc_telemetry: _t.Items[_msg_mavros_msgs.ESCTelemetryItem],
        /,
    ) -> None: ...

class ESCTelemetryItem(_t.Message):
    header: _msg_std_msgs.Header
    temperature: _b.float
    voltage: _b.float
    current: _b.float
    totalcurrent: _b.float
    rpm: _b.int
    count: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        temperature: _t.Float = ...,
        voltage: _t.Float = ...,
        current: _t.Float = ...,
        totalcurrent: _t.Float = ...,
        rpm: _t.Int = ...,
        count: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        temperature: _t.Float,
        voltage: _t.Float,
        current: _t.Float,
        totalcurrent: _t.Float,
        rpm: _t.Int,
        count: _t.Int,
        /,
    ) -> None: ...

class EstimatorStatus(_t.Message):
    header: _msg_std_msgs.Header
    attitude_status_flag: _b.bool
    velocity_horiz_status_flag: _b.bool
    velocity_vert_status_flag: _b.bool
    pos_horiz_rel_status_flag: _b.bool
    pos_horiz_abs_status_flag: _b.bool
    pos_vert_abs_status_flag: _b.bool
    pos_vert_agl_status_flag: _b.bool
    const_pos_mode_status_flag: _b.bool
    pred_pos_horiz_rel_status_flag: _b.bool
    pred_pos_horiz_abs_status_flag: _b.bool
    gps_glitch_status_flag: _b.bool
    accel_error_status_flag: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        attitude_status_flag: _t.Bool = ...,
        velocity_horiz_status_flag: _t.Bool = ...,
        velocity_vert_status_flag: _t.Bool = ...,
        pos_horiz_rel_status_flag: _t.Bool = ...,
        pos_horiz_abs_status_flag: _t.Bool = ...,
        pos_vert_abs_status_flag: _t.Bool = ...,
        pos_vert_agl_status_flag: _t.Bool = ...,
        const_pos_mode_status_flag: _t.Bool = ...,
        pred_pos_horiz_rel_status_flag: _t.Bool = ...,
        pred_pos_horiz_abs_status_flag: _t.Bool = ...,
        gps_glitch_status_flag: _t.Bool = ...,
        accel_error_status_flag: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        attitude_status_flag: _t.Bool,
        velocity_horiz_status_flag: _t.Bool,
        velocity_vert_status_flag: _t.Bool,
        pos_horiz_rel_status_flag: _t.Bool,
        pos_horiz_abs_status_flag: _t.Bool,
        pos_vert_abs_status_flag: _t.Bool,
        pos_vert_agl_status_flag: _t.Bool,
        const_pos_mode_status_flag: _t.Bool,
        pred_pos_horiz_rel_status_flag: _t.Bool,
        pred_pos_horiz_abs_status_flag: _t.Bool,
        gps_glitch_status_flag: _t.Bool,
        accel_error_status_flag: _t.Bool,
        /,
    ) -> None: ...

class ExtendedState(_t.Message):
    VTOL_STATE_UNDEFINED: _ty.Final = 0
    VTOL_STATE_TRANSITION_TO_FW: _ty.Final = 1
    VTOL_STATE_TRANSITION_TO_MC: _ty.Final = 2
    VTOL_STATE_MC: _ty.Final = 3
    VTOL_STATE_FW: _ty.Final = 4
    LANDED_STATE_UNDEFINED: _ty.Final = 0
    LANDED_STATE_ON_GROUND: _ty.Final = 1
    LANDED_STATE_IN_AIR: _ty.Final = 2
    LANDED_STATE_TAKEOFF: _ty.Final = 3
    LANDED_STATE_LANDING: _ty.Final = 4
    header: _msg_std_msgs.Header
    vtol_state: _b.int
    landed_state: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        vtol_state: _t.Int = ...,
        landed_state: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        vtol_state: _t.Int,
        landed_state: _t.Int,
        /,
    ) -> None: ...

class FileEntry(_t.Message):
    TYPE_FILE: _ty.Final = 0
    TYPE_DIRECTORY: _ty.Final = 1
    name: _b.str
    type: _b.int
    size: _b.int
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., type: _t.Int = ..., size: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, type: _t.Int, size: _t.Int, /) -> None: ...

class GPSINPUT(_t.Message):
    GPS_FIX_TYPE_NO_GPS: _ty.Final = 0
    GPS_FIX_TYPE_NO_FIX: _ty.Final = 1
    GPS_FIX_TYPE_2D_FIX: _ty.Final = 2
    GPS_FIX_TYPE_3D_FIX: _ty.Final = 3
    GPS_FIX_TYPE_DGPS: _ty.Final = 4
    GPS_FIX_TYPE_RTK_FLOATR: _ty.Final = 5
    GPS_FIX_TYPE_RTK_FIXEDR: _ty.Final = 6
    GPS_FIX_TYPE_STATIC: _ty.Final = 7
    GPS_FIX_TYPE_PPP: _ty.Final = 8
    header: _msg_std_msgs.Header
    fix_type: _b.int
    gps_id: _b.int
    ignore_flags: _b.int
    time_week_ms: _b.int
    time_week: _b.int
    lat: _b.int
    lon: _b.int
    alt: _b.float
    hdop: _b.float
    vdop: _b.float
    vn: _b.float
    ve: _b.float
    vd: _b.float
    speed_accuracy: _b.float
    horiz_accuracy: _b.float
    vert_accuracy: _b.float
    satellites_visible: _b.int
    yaw: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        fix_type: _t.Int = ...,
        gps_id: _t.Int = ...,
        ignore_flags: _t.Int = ...,
        time_week_ms: _t.Int = ...,
        time_week: _t.Int = ...,
        lat: _t.Int = ...,
        lon: _t.Int = ...,
        alt: _t.Float = ...,
        hdop: _t.Float = ...,
        vdop: _t.Float = ...,
        vn: _t.Float = ...,
        ve: _t.Float = ...,
        vd: _t.Float = ...,
        speed_accuracy: _t.Float = ...,
        horiz_accuracy: _t.Float = ...,
        vert_accuracy: _t.Float = ...,
        satellites_visible: _t.Int = ...,
        yaw: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        fix_type: _t.Int,
        gps_id: _t.Int,
        ignore_flags: _t.Int,
        time_week_ms: _t.Int,
        time_week: _t.Int,
        lat: _t.Int,
        lon: _t.Int,
        alt: _t.Float,
        hdop: _t.Float,
        vdop: _t.Float,
        vn: _t.Float,
        ve: _t.Float,
        vd: _t.Float,
        speed_accuracy: _t.Float,
        horiz_accuracy: _t.Float,
        vert_accuracy: _t.Float,
        satellites_visible: _t.Int,
        yaw: _t.Int,
        /,
    ) -> None: ...

class GPSRAW(_t.Message):
    GPS_FIX_TYPE_NO_GPS: _ty.Final = 0
    GPS_FIX_TYPE_NO_FIX: _ty.Final = 1
    GPS_FIX_TYPE_2D_FIX: _ty.Final = 2
    GPS_FIX_TYPE_3D_FIX: _ty.Final = 3
    GPS_FIX_TYPE_DGPS: _ty.Final = 4
    GPS_FIX_TYPE_RTK_FLOAT: _ty.Final = 5
    GPS_FIX_TYPE_RTK_FIXED: _ty.Final = 6
    GPS_FIX_TYPE_STATIC: _ty.Final = 7
    GPS_FIX_TYPE_PPP: _ty.Final = 8
    header: _msg_std_msgs.Header
    fix_type: _b.int
    lat: _b.int
    lon: _b.int
    alt: _b.int
    eph: _b.int
    epv: _b.int
    vel: _b.int
    cog: _b.int
    satellites_visible: _b.int
    alt_ellipsoid: _b.int
    h_acc: _b.int
    v_acc: _b.int
    vel_acc: _b.int
    hdg_acc: _b.int
    yaw: _b.int
    dgps_numch: _b.int
    dgps_age: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        fix_type: _t.Int = ...,
        lat: _t.Int = ...,
        lon: _t.Int = ...,
        alt: _t.Int = ...,
        eph: _t.Int = ...,
        epv: _t.Int = ...,
        vel: _t.Int = ...,
        cog: _t.Int = ...,
        satellites_visible: _t.Int = ...,
        alt_ellipsoid: _t.Int = ...,
        h_acc: _t.Int = ...,
        v_acc: _t.Int = ...,
        vel_acc: _t.Int = ...,
        hdg_acc: _t.Int = ...,
        yaw: _t.Int = ...,
        dgps_numch: _t.Int = ...,
        dgps_age: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        fix_type: _t.Int,
        lat: _t.Int,
        lon: _t.Int,
        alt: _t.Int,
        eph: _t.Int,
        epv: _t.Int,
        vel: _t.Int,
        cog: _t.Int,
        satellites_visible: _t.Int,
        alt_ellipsoid: _t.Int,
        h_acc: _t.Int,
        v_acc: _t.Int,
        vel_acc: _t.Int,
        hdg_acc: _t.Int,
        yaw: _t.Int,
        dgps_numch: _t.Int,
        dgps_age: _t.Int,
        /,
    ) -> None: ...

class GPSRTK(_t.Message):
    header: _msg_std_msgs.Header
    rtk_receiver_id: _b.int
    wn: _b.int
    tow: _b.int
    rtk_health: _b.int
    rtk_rate: _b.int
    nsats: _b.int
    baseline_a: _b.int
    baseline_b: _b.int
    baseline_c: _b.int
    accuracy: _b.int
    iar_num_hypotheses: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        rtk_receiver_id: _t.Int = ...,
        wn: _t.Int = ...,
        tow: _t.Int = ...,
        rtk_health: _t.Int = ...,
        rtk_rate: _t.Int = ...,
        nsats: _t.Int = ...,
        baseline_a: _t.Int = ...,
        baseline_b: _t.Int = ...,
        baseline_c: _t.Int = ...,
        accuracy: _t.Int = ...,
        iar_num_hypotheses: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        rtk_receiver_id: _t.Int,
        wn: _t.Int,
        tow: _t.Int,
        rtk_health: _t.Int,
        rtk_rate: _t.Int,
        nsats: _t.Int,
        baseline_a: _t.Int,
        baseline_b: _t.Int,
        baseline_c: _t.Int,
        accuracy: _t.Int,
        iar_num_hypotheses: _t.Int,
        /,
    ) -> None: ...

class GimbalDeviceAttitudeStatus(_t.Message):
    FLAGS_RETRACT: _ty.Final = 1
    FLAGS_NEUTRAL: _ty.Final = 2
    FLAGS_ROLL_LOCK: _ty.Final = 4
    FLAGS_PITCH_LOCK: _ty.Final = 8
    FLAGS_YAW_LOCK: _ty.Final = 16
    ERROR_FLAGS_AT_ROLL_LIMIT: _ty.Final = 1
    ERROR_FLAGS_AT_PITCH_LIMIT: _ty.Final = 2
    ERROR_FLAGS_AT_YAW_LIMIT: _ty.Final = 4
    ERROR_FLAGS_ENCODER_ERROR: _ty.Final = 8
    ERROR_FLAGS_POWER_ERROR: _ty.Final = 16
    ERROR_FLAGS_MOTOR_ERROR: _ty.Final = 32
    ERROR_FLAGS_SOFTWARE_ERROR: _ty.Final = 64
    ERROR_FLAGS_COMMS_ERROR: _ty.Final = 128
    ERROR_FLAGS_CALIBRATION_RUNNING: _ty.Final = 256
    header: _msg_std_msgs.Header
    target_system: _b.int
    target_component: _b.int
    flags: _b.int
    q: _msg_geometry_msgs.Quaternion
    angular_velocity_x: _b.float
    angular_velocity_y: _b.float
    angular_velocity_z: _b.float
    failure_flags: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        target_system: _t.Int = ...,
        target_component: _t.Int = ...,
        flags: _t.Int = ...,
        q: _msg_geometry_msgs.Quaternion = ...,
        angular_velocity_x: _t.Float = ...,
        angular_velocity_y: _t.Float = ...,
        angular_velocity_z: _t.Float = ...,
        failure_flags: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        target_system: _t.Int,
        target_component: _t.Int,
        flags: _t.Int,
        q: _msg_geometry_msgs.Quaternion,
        angular_velocity_x: _t.Float,
        angular_velocity_y: _t.Float,
        angular_velocity_z: _t.Float,
        failure_flags: _t.Int,
        /,
    ) -> None: ...

class GimbalDeviceInformation(_t.Message):
    CAP_FLAGS_HAS_RETRACT: _ty.Final = 1
    CAP_FLAGS_HAS_NEUTRAL: _ty.Final = 2
    CAP_FLAGS_HAS_ROLL_AXIS: _ty.Final = 4
    CAP_FLAGS_HAS_ROLL_FOLLOW: _ty.Final = 8
    CAP_FLAGS_HAS_ROLL_LOCK: _ty.Final = 16
    CAP_FLAGS_HAS_PITCH_AXIS: _ty.Final = 32
    CAP_FLAGS_HAS_PITCH_FOLLOW: _ty.Final = 64
    CAP_FLAGS_HAS_PITCH_LOCK: _ty.Final = 128
    CAP_FLAGS_HAS_YAW_AXIS: _ty.Final = 256
    CAP_FLAGS_HAS_YAW_FOLLOW: _ty.Final = 512
    CAP_FLAGS_HAS_YAW_LOCK: _ty.Final = 1024
    CAP_FLAGS_SUPPORTS_INFINITE_YAW: _ty.Final = 2048
    header: _msg_std_msgs.Header
    vendor_name: _b.str
    model_name: _b.str
    custom_name: _b.str
    firmware_version: _b.int
    hardware_version: _b.int
    uid: _b.int
    cap_flags: _b.int
    custom_cap_flags: _b.int
    roll_min: _b.float
    roll_max: _b.float
    pitch_min: _b.float
    pitch_max: _b.float
    yaw_min: _b.float
    yaw_max: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        vendor_name: _t.Text = ...,
        model_name: _t.Text = ...,
        custom_name: _t.Text = ...,
        firmware_version: _t.Int = ...,
        hardware_version: _t.Int = ...,
        uid: _t.Int = ...,
        cap_flags: _t.Int = ...,
        custom_cap_flags: _t.Int = ...,
        roll_min: _t.Float = ...,
        roll_max: _t.Float = ...,
        pitch_min: _t.Float = ...,
        pitch_max: _t.Float = ...,
        yaw_min: _t.Float = ...,
        yaw_max: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        vendor_name: _t.Text,
        model_name: _t.Text,
        custom_name: _t.Text,
        firmware_version: _t.Int,
        hardware_version: _t.Int,
        uid: _t.Int,
        cap_flags: _t.Int,
        custom_cap_flags: _t.Int,
        roll_min: _t.Float,
        roll_max: _t.Float,
        pitch_min: _t.Float,
        pitch_max: _t.Float,
        yaw_min: _t.Float,
        yaw_max: _t.Float,
        /,
    ) -> None: ...

class GimbalDeviceSetAttitude(_t.Message):
    FLAGS_RETRACT: _ty.Final = 1
    FLAGS_NEUTRAL: _ty.Final = 2
    FLAGS_ROLL_LOCK: _ty.Final = 4
    FLAGS_PITCH_LOCK: _ty.Final = 8
    FLAGS_YAW_LOCK: _ty.Final = 16
    target_system: _b.int
    target_component: _b.int
    flags: _b.int
    q: _msg_geometry_msgs.Quaternion
    angular_velocity_x: _b.float
    angular_velocity_y: _b.float
    angular_velocity_z: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        target_system: _t.Int = ...,
        target_component: _t.Int = ...,
        flags: _t.Int = ...,
        q: _msg_geometry_msgs.Quaternion = ...,
        angular_velocity_x: _t.Float = ...,
        angular_velocity_y: _t.Float = ...,
        angular_velocity_z: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        target_system: _t.Int,
        target_component: _t.Int,
        flags: _t.Int,
        q: _msg_geometry_msgs.Quaternion,
        angular_velocity_x: _t.Float,
        angular_velocity_y: _t.Float,
        angular_velocity_z: _t.Float,
        /,
    ) -> None: ...

class GimbalManagerInformation(_t.Message):
    CAP_FLAGS_HAS_RETRACT: _ty.Final = 1
    CAP_FLAGS_HAS_NEUTRAL: _ty.Final = 2
    CAP_FLAGS_HAS_ROLL_AXIS: _ty.Final = 4
    CAP_FLAGS_HAS_ROLL_FOLLOW: _ty.Final = 8
    CAP_FLAGS_HAS_ROLL_LOCK: _ty.Final = 16
    CAP_FLAGS_HAS_PITCH_AXIS: _ty.Final = 32
    CAP_FLAGS_HAS_PITCH_FOLLOW: _ty.Final = 64
    CAP_FLAGS_HAS_PITCH_LOCK: _ty.Final = 128
    CAP_FLAGS_HAS_YAW_AXIS: _ty.Final = 256
    CAP_FLAGS_HAS_YAW_FOLLOW: _ty.Final = 512
    CAP_FLAGS_HAS_YAW_LOCK: _ty.Final = 1024
    CAP_FLAGS_SUPPORTS_INFINITE_YAW: _ty.Final = 2048
    CAP_FLAGS_CAN_POINT_LOCATION_LOCAL: _ty.Final = 65536
    CAP_FLAGS_CAN_POINT_LOCATION_GLOBAL: _ty.Final = 131072
    header: _msg_std_msgs.Header
    cap_flags: _b.int
    gimbal_device_id: _b.int
    roll_min: _b.float
    roll_max: _b.float
    pitch_min: _b.float
    pitch_max: _b.float
    yaw_min: _b.float
    yaw_max: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        cap_flags: _t.Int = ...,
        gimbal_device_id: _t.Int = ...,
        roll_min: _t.Float = ...,
        roll_max: _t.Float = ...,
        pitch_min: _t.Float = ...,
        pitch_max: _t.Float = ...,
        yaw_min: _t.Float = ...,
        yaw_max: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        cap_flags: _t.Int,
        gimbal_device_id: _t.Int,
        roll_min: _t.Float,
        roll_max: _t.Float,
        pitch_min: _t.Float,
        pitch_max: _t.Float,
        yaw_min: _t.Float,
        yaw_max: _t.Float,
        /,
    ) -> None: ...

class GimbalManagerSetAttitude(_t.Message):
    GIMBAL_MANAGER_FLAGS_RETRACT: _ty.Final = 1
    GIMBAL_MANAGER_FLAGS_NEUTRAL: _ty.Final = 2
    GIMBAL_MANAGER_FLAGS_ROLL_LOCK: _ty.Final = 4
    GIMBAL_MANAGER_FLAGS_PITCH_LOCK: _ty.Final = 8
    GIMBAL_MANAGER_FLAGS_YAW_LOCK: _ty.Final = 16
    target_system: _b.int
    target_component: _b.int
    flags: _b.int
    gimbal_device_id: _b.int
    q: _msg_geometry_msgs.Quaternion
    angular_velocity_x: _b.float
    angular_velocity_y: _b.float
    angular_velocity_z: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        target_system: _t.Int = ...,
        target_component: _t.Int = ...,
        flags: _t.Int = ...,
        gimbal_device_id: _t.Int = ...,
        q: _msg_geometry_msgs.Quaternion = ...,
        angular_velocity_x: _t.Float = ...,
        angular_velocity_y: _t.Float = ...,
        angular_velocity_z: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        target_system: _t.Int,
        target_component: _t.Int,
        flags: _t.Int,
        gimbal_device_id: _t.Int,
        q: _msg_geometry_msgs.Quaternion,
        angular_velocity_x: _t.Float,
        angular_velocity_y: _t.Float,
        angular_velocity_z: _t.Float,
        /,
    ) -> None: ...

class GimbalManagerSetPitchyaw(_t.Message):
    GIMBAL_MANAGER_FLAGS_RETRACT: _ty.Final = 1
    GIMBAL_MANAGER_FLAGS_NEUTRAL: _ty.Final = 2
    GIMBAL_MANAGER_FLAGS_ROLL_LOCK: _ty.Final = 4
    GIMBAL_MANAGER_FLAGS_PITCH_LOCK: _ty.Final = 8
    GIMBAL_MANAGER_FLAGS_YAW_LOCK: _ty.Final = 16
    target_system: _b.int
    target_component: _b.int
    flags: _b.int
    gimbal_device_id: _b.int
    pitch: _b.float
    yaw: _b.float
    pitch_rate: _b.float
    yaw_rate: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        target_system: _t.Int = ...,
        target_component: _t.Int = ...,
        flags: _t.Int = ...,
        gimbal_device_id: _t.Int = ...,
        pitch: _t.Float = ...,
        yaw: _t.Float = ...,
        pitch_rate: _t.Float = ...,
        yaw_rate: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        target_system: _t.Int,
        target_component: _t.Int,
        flags: _t.Int,
        gimbal_device_id: _t.Int,
        pitch: _t.Float,
        yaw: _t.Float,
        pitch_rate: _t.Float,
        yaw_rate: _t.Float,
        /,
    ) -> None: ...

class GimbalManagerStatus(_t.Message):
    GIMBAL_MANAGER_FLAGS_RETRACT: _ty.Final = 1
    GIMBAL_MANAGER_FLAGS_NEUTRAL: _ty.Final = 2
    GIMBAL_MANAGER_FLAGS_ROLL_LOCK: _ty.Final = 4
    GIMBAL_MANAGER_FLAGS_PITCH_LOCK: _ty.Final = 8
    GIMBAL_MANAGER_FLAGS_YAW_LOCK: _ty.Final = 16
    header: _msg_std_msgs.Header
    flags: _b.int
    gimbal_device_id: _b.int
    sysid_primary: _b.int
    compid_primary: _b.int
    sysid_secondary: _b.int
    compid_secondary: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        flags: _t.Int = ...,
        gimbal_device_id: _t.Int = ...,
        sysid_primary: _t.Int = ...,
        compid_primary: _t.Int = ...,
        sysid_secondary: _t.Int = ...,
        compid_secondary: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        flags: _t.Int,
        gimbal_device_id: _t.Int,
        sysid_primary: _t.Int,
        compid_primary: _t.Int,
        sysid_secondary: _t.Int,
        compid_secondary: _t.Int,
        /,
    ) -> None: ...

class GlobalPositionTarget(_t.Message):
    FRAME_GLOBAL_INT: _ty.Final = 5
    FRAME_GLOBAL_REL_ALT: _ty.Final = 6
    FRAME_GLOBAL_TERRAIN_ALT: _ty.Final = 11
    IGNORE_LATITUDE: _ty.Final = 1
    IGNORE_LONGITUDE: _ty.Final = 2
    IGNORE_ALTITUDE: _ty.Final = 4
    IGNORE_VX: _ty.Final = 8
    IGNORE_VY: _ty.Final = 16
    IGNORE_VZ: _ty.Final = 32
    IGNORE_AFX: _ty.Final = 64
    IGNORE_AFY: _ty.Final = 128
    IGNORE_AFZ: _ty.Final = 256
    FORCE: _ty.Final = 512
    IGNORE_YAW: _ty.Final = 1024
    IGNORE_YAW_RATE: _ty.Final = 2048
    header: _msg_std_msgs.Header
    coordinate_frame: _b.int
    type_mask: _b.int
    latitude: _b.float
    longitude: _b.float
    altitude: _b.float
    velocity: _msg_geometry_msgs.Vector3
    acceleration_or_force: _msg_geometry_msgs.Vector3
    yaw: _b.float
    yaw_rate: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        coordinate_frame: _t.Int = ...,
        type_mask: _t.Int = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        altitude: _t.Float = ...,
        velocity: _msg_geometry_msgs.Vector3 = ...,
        acceleration_or_force: _msg_geometry_msgs.Vector3 = ...,
        yaw: _t.Float = ...,
        yaw_rate: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        coordinate_frame: _t.Int,
        type_mask: _t.Int,
        latitude: _t.Float,
        longitude: _t.Float,
        altitude: _t.Float,
        velocity: _msg_geometry_msgs.Vector3,
        acceleration_or_force: _msg_geometry_msgs.Vector3,
        yaw: _t.Float,
        yaw_rate: _t.Float,
        /,
    ) -> None: ...

class HilActuatorControls(_t.Message):
    header: _msg_std_msgs.Header
    controls: _t.FloatArray
    mode: _b.int
    flags: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        controls: _t.Floats = ...,
        mode: _t.Int = ...,
        flags: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        controls: _t.Floats,
        mode: _t.Int,
        flags: _t.Int,
        /,
    ) -> None: ...

class HilControls(_t.Message):
    header: _msg_std_msgs.Header
    roll_ailerons: _b.float
    pitch_elevator: _b.float
    yaw_rudder: _b.float
    throttle: _b.float
    aux1: _b.float
    aux2: _b.float
    aux3: _b.float
    aux4: _b.float
    mode: _b.int
    nav_mode: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        roll_ailerons: _t.Float = ...,
        pitch_elevator: _t.Float = ...,
        yaw_rudder: _t.Float = ...,
        throttle: _t.Float = ...,
        aux1: _t.Float = ...,
        aux2: _t.Float = ...,
        aux3: _t.Float = ...,
        aux4: _t.Float = ...,
        mode: _t.Int = ...,
        nav_mode: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        roll_ailerons: _t.Float,
        pitch_elevator: _t.Float,
        yaw_rudder: _t.Float,
        throttle: _t.Float,
        aux1: _t.Float,
        aux2: _t.Float,
        aux3: _t.Float,
        aux4: _t.Float,
        mode: _t.Int,
        nav_mode: _t.Int,
        /,
    ) -> None: ...

class HilGPS(_t.Message):
    header: _msg_std_msgs.Header
    fix_type: _b.int
    geo: _msg_geographic_msgs.GeoPoint
    eph: _b.int
    epv: _b.int
    vel: _b.int
    vn: _b.int
    ve: _b.int
    vd: _b.int
    cog: _b.int
    satellites_visible: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        fix_type: _t.Int = ...,
        geo: _msg_geographic_msgs.GeoPoint = ...,
        eph: _t.Int = ...,
        epv: _t.Int = ...,
        vel: _t.Int = ...,
        vn: _t.Int = ...,
        ve: _t.Int = ...,
        vd: _t.Int = ...,
        cog: _t.Int = ...,
        satellites_visible: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        fix_type: _t.Int,
        geo: _msg_geographic_msgs.GeoPoint,
        eph: _t.Int,
        epv: _t.Int,
        vel: _t.Int,
        vn: _t.Int,
        ve: _t.Int,
        vd: _t.Int,
        cog: _t.Int,
        satellites_visible: _t.Int,
        /,
    ) -> None: ...

class HilSensor(_t.Message):
    header: _msg_std_msgs.Header
    acc: _msg_geometry_msgs.Vector3
    gyro: _msg_geometry_msgs.Vector3
    mag: _msg_geometry_msgs.Vector3
    abs_pressure: _b.float
    diff_pressure: _b.float
    pressure_alt: _b.float
    temperature: _b.float
    fields_updated: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        acc: _msg_geometry_msgs.Vector3 = ...,
        gyro: _msg_geometry_msgs.Vector3 = ...,
        mag: _msg_geometry_msgs.Vector3 = ...,
        abs_pressure: _t.Float = ...,
        diff_pressure: _t.Float = ...,
        pressure_alt: _t.Float = ...,
        temperature: _t.Float = ...,
        fields_updated: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        acc: _msg_geometry_msgs.Vector3,
        gyro: _msg_geometry_msgs.Vector3,
        mag: _msg_geometry_msgs.Vector3,
        abs_pressure: _t.Float,
        diff_pressure: _t.Float,
        pressure_alt: _t.Float,
        temperature: _t.Float,
        fields_updated: _t.Int,
        /,
    ) -> None: ...

class HilStateQuaternion(_t.Message):
    header: _msg_std_msgs.Header
    orientation: _msg_geometry_msgs.Quaternion
    angular_velocity: _msg_geometry_msgs.Vector3
    linear_acceleration: _msg_geometry_msgs.Vector3
    linear_velocity: _msg_geometry_msgs.Vector3
    geo: _msg_geographic_msgs.GeoPoint
    ind_airspeed: _b.float
    true_airspeed: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
        angular_velocity: _msg_geometry_msgs.Vector3 = ...,
        linear_acceleration: _msg_geometry_msgs.Vector3 = ...,
        linear_velocity: _msg_geometry_msgs.Vector3 = ...,
        geo: _msg_geographic_msgs.GeoPoint = ...,
        ind_airspeed: _t.Float = ...,
        true_airspeed: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        orientation: _msg_geometry_msgs.Quaternion,
        angular_velocity: _msg_geometry_msgs.Vector3,
        linear_acceleration: _msg_geometry_msgs.Vector3,
        linear_velocity: _msg_geometry_msgs.Vector3,
        geo: _msg_geographic_msgs.GeoPoint,
        ind_airspeed: _t.Float,
        true_airspeed: _t.Float,
        /,
    ) -> None: ...

class HomePosition(_t.Message):
    header: _msg_std_msgs.Header
    geo: _msg_geographic_msgs.GeoPoint
    position: _msg_geometry_msgs.Point
    orientation: _msg_geometry_msgs.Quaternion
    approach: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        geo: _msg_geographic_msgs.GeoPoint = ...,
        position: _msg_geometry_msgs.Point = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
        approach: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        geo: _msg_geographic_msgs.GeoPoint,
        position: _msg_geometry_msgs.Point,
        orientation: _msg_geometry_msgs.Quaternion,
        approach: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class LandingTarget(_t.Message):
    GLOBAL: _ty.Final = 0
    LOCAL_NED: _ty.Final = 2
    MISSION: _ty.Final = 3
    GLOBAL_RELATIVE_ALT: _ty.Final = 4
    LOCAL_ENU: _ty.Final = 5
    GLOBAL_INT: _ty.Final = 6
    GLOBAL_RELATIVE_ALT_INT: _ty.Final = 7
    LOCAL_OFFSET_NED: _ty.Final = 8
    BODY_NED: _ty.Final = 9
    BODY_OFFSET_NED: _ty.Final = 10
    GLOBAL_TERRAIN_ALT: _ty.Final = 11
    GLOBAL_TERRAIN_ALT_INT: _ty.Final = 12
    LIGHT_BEACON: _ty.Final = 0
    RADIO_BEACON: _ty.Final = 1
    VISION_FIDUCIAL: _ty.Final = 2
    VISION_OTHER: _ty.Final = 3
    header: _msg_std_msgs.Header
    target_num: _b.int
    frame: _b.int
    angle: _t.FloatArray
    distance: _b.float
    size: _t.FloatArray
    pose: _msg_geometry_msgs.Pose
    type: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        target_num: _t.Int = ...,
        frame: _t.Int = ...,
        angle: _t.Floats = ...,
        distance: _t.Float = ...,
        size: _t.Floats = ...,
        pose: _msg_geometry_msgs.Pose = ...,
        type: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        target_num: _t.Int,
        frame: _t.Int,
        angle: _t.Floats,
        distance: _t.Float,
        size: _t.Floats,
        pose: _msg_geometry_msgs.Pose,
        type: _t.Int,
        /,
    ) -> None: ...

class LogData(_t.Message):
    header: _msg_std_msgs.Header
    id: _b.int
    offset: _b.int
    data: _t.OctetArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id: _t.Int = ...,
        offset: _t.Int = ...,
        data: _t.Octets = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id: _t.Int,
        offset: _t.Int,
        data: _t.Octets,
        /,
    ) -> None: ...

class LogEntry(_t.Message):
    header: _msg_std_msgs.Header
    id: _b.int
    num_logs: _b.int
    last_log_num: _b.int
    time_utc: _t.Time
    size: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id: _t.Int = ...,
        num_logs: _t.Int = ...,
        last_log_num: _t.Int = ...,
        time_utc: _t.Time = ...,
        size: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id: _t.Int,
        num_logs: _t.Int,
        last_log_num: _t.Int,
        time_utc: _t.Time,
        size: _t.Int,
        /,
    ) -> None: ...

class MagnetometerReporter(_t.Message):
    header: _msg_std_msgs.Header
    report: _b.int
    confidence: _b.float
    compass_id: _b.int
    cal_mask: _b.int
    cal_status: _b.int
    autosaved: _b.int
    fitness: _b.float
    ofs_x: _b.float
    ofs_y: _b.float
    ofs_z: _b.float
    diag_x: _b.float
    diag_y: _b.float
    diag_z: _b.float
    offdiag_x: _b.float
    offdiag_y: _b.float
    offdiag_z: _b.float
    orientation_confidence: _b.float
    old_orientation: _b.int
    new_orientation: _b.int
    scale_factor: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        report: _t.Int = ...,
        confidence: _t.Float = ...,
        compass_id: _t.Int = ...,
        cal_mask: _t.Int = ...,
        cal_status: _t.Int = ...,
        autosaved: _t.Int = ...,
        fitness: _t.Float = ...,
        ofs_x: _t.Float = ...,
        ofs_y: _t.Float = ...,
        ofs_z: _t.Float = ...,
        diag_x: _t.Float = ...,
        diag_y: _t.Float = ...,
        diag_z: _t.Float = ...,
        offdiag_x: _t.Float = ...,
        offdiag_y: _t.Float = ...,
        offdiag_z: _t.Float = ...,
        orientation_confidence: _t.Float = ...,
        old_orientation: _t.Int = ...,
        new_orientation: _t.Int = ...,
        scale_factor: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        report: _t.Int,
        confidence: _t.Float,
        compass_id: _t.Int,
        cal_mask: _t.Int,
        cal_status: _t.Int,
        autosaved: _t.Int,
        fitness: _t.Float,
        ofs_x: _t.Float,
        ofs_y: _t.Float,
        ofs_z: _t.Float,
        diag_x: _t.Float,
        diag_y: _t.Float,
        diag_z: _t.Float,
        offdiag_x: _t.Float,
        offdiag_y: _t.Float,
        offdiag_z: _t.Float,
        orientation_confidence: _t.Float,
        old_orientation: _t.Int,
        new_orientation: _t.Int,
        scale_factor: _t.Float,
        /,
    ) -> None: ...

class ManualControl(_t.Message):
    header: _msg_std_msgs.Header
    x: _b.float
    y: _b.float
    z: _b.float
    r: _b.float
    buttons: _b.int
    buttons2: _b.int
    enabled_extensions: _b.int
    s: _b.float
    t: _b.float
    aux1: _b.float
    aux2: _b.float
    aux3: _b.float
    aux4: _b.float
    aux5: _b.float
    aux6: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        x: _t.Float = ...,
        y: _t.Float = ...,
        z: _t.Float = ...,
        r: _t.Float = ...,
        buttons: _t.Int = ...,
        buttons2: _t.Int = ...,
        enabled_extensions: _t.Int = ...,
        s: _t.Float = ...,
        t: _t.Float = ...,
        aux1: _t.Float = ...,
        aux2: _t.Float = ...,
        aux3: _t.Float = ...,
        aux4: _t.Float = ...,
        aux5: _t.Float = ...,
        aux6: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        x: _t.Float,
        y: _t.Float,
        z: _t.Float,
        r: _t.Float,
        buttons: _t.Int,
        buttons2: _t.Int,
        enabled_extensions: _t.Int,
        s: _t.Float,
        t: _t.Float,
        aux1: _t.Float,
        aux2: _t.Float,
        aux3: _t.Float,
        aux4: _t.Float,
        aux5: _t.Float,
        aux6: _t.Float,
        /,
    ) -> None: ...

class Mavlink(_t.Message):
    FRAMING_OK: _ty.Final = 1
    FRAMING_BAD_CRC: _ty.Final = 2
    FRAMING_BAD_SIGNATURE: _ty.Final = 3
    MAVLINK_V10: _ty.Final = 254
    MAVLINK_V20: _ty.Final = 253
    header: _msg_std_msgs.Header
    framing_status: _b.int
    magic: _b.int
    len: _b.int
    incompat_flags: _b.int
    compat_flags: _b.int
    seq: _b.int
    sysid: _b.int
    compid: _b.int
    msgid: _b.int
    checksum: _b.int
    payload64: _t.IntArray
    signature: _t.OctetArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        framing_status: _t.Int = ...,
        magic: _t.Int = ...,
        len: _t.Int = ...,
        incompat_flags: _t.Int = ...,
        compat_flags: _t.Int = ...,
        seq: _t.Int = ...,
        sysid: _t.Int = ...,
        compid: _t.Int = ...,
        msgid: _t.Int = ...,
        checksum: _t.Int = ...,
        payload64: _t.Ints = ...,
        signature: _t.Octets = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        framing_status: _t.Int,
        magic: _t.Int,
        len: _t.Int,
        incompat_flags: _t.Int,
        compat_flags: _t.Int,
        seq: _t.Int,
        sysid: _t.Int,
        compid: _t.Int,
        msgid: _t.Int,
        checksum: _t.Int,
        payload64: _t.Ints,
        signature: _t.Octets,
        /,
    ) -> None: ...

class MountControl(_t.Message):
    MAV_MOUNT_MODE_RETRACT: _ty.Final = 0
    MAV_MOUNT_MODE_NEUTRAL: _ty.Final = 1
    MAV_MOUNT_MODE_MAVLINK_TARGETING: _ty.Final = 2
    MAV_MOUNT_MODE_RC_TARGETING: _ty.Final = 3
    MAV_MOUNT_MODE_GPS_POINT: _ty.Final = 4
    header: _msg_std_msgs.Header
    mode: _b.int
    pitch: _b.float
    roll: _b.float
    yaw: _b.float
    altitude: _b.float
    latitude: _b.float
    longitude: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        mode: _t.Int = ...,
        pitch: _t.Float = ...,
        roll: _t.Float = ...,
        yaw: _t.Float = ...,
        altitude: _t.Float = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        mode: _t.Int,
        pitch: _t.Float,
        roll: _t.Float,
        yaw: _t.Float,
        altitude: _t.Float,
        latitude: _t.Float,
        longitude: _t.Float,
        /,
    ) -> None: ...

class NavControllerOutput(_t.Message):
    header: _msg_std_msgs.Header
    nav_roll: _b.float
    nav_pitch: _b.float
    nav_bearing: _b.int
    target_bearing: _b.int
    wp_dist: _b.int
    alt_error: _b.float
    aspd_error: _b.float
    xtrack_error: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        nav_roll: _t.Float = ...,
        nav_pitch: _t.Float = ...,
        nav_bearing: _t.Int = ...,
        target_bearing: _t.Int = ...,
        wp_dist: _t.Int = ...,
        alt_error: _t.Float = ...,
        aspd_error: _t.Float = ...,
        xtrack_error: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        nav_roll: _t.Float,
        nav_pitch: _t.Float,
        nav_bearing: _t.Int,
        target_bearing: _t.Int,
        wp_dist: _t.Int,
        alt_error: _t.Float,
        aspd_error: _t.Float,
        xtrack_error: _t.Float,
        /,
    ) -> None: ...

class OnboardComputerStatus(_t.Message):
    header: _msg_std_msgs.Header
    component: _b.int
    uptime: _b.int
    type: _b.int
    cpu_cores: _t.OctetArray
    cpu_combined: _t.OctetArray
    gpu_cores: _t.OctetArray
    gpu_combined: _t.OctetArray
    temperature_board: _b.int
    temperature_core: _t.IntArray
    fan_speed: _t.IntArray
    ram_usage: _b.int
    ram_total: _b.int
    storage_type: _t.IntArray
    storage_usage: _t.IntArray
    storage_total: _t.IntArray
    link_type: _t.IntArray
    link_tx_rate: _t.IntArray
    link_rx_rate: _t.IntArray
    link_tx_max: _t.IntArray
    link_rx_max: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        component: _t.Int = ...,
        uptime: _t.Int = ...,
        type: _t.Int = ...,
        cpu_cores: _t.Octets = ...,
        cpu_combined: _t.Octets = ...,
        gpu_cores: _t.Octets = ...,
        gpu_combined: _t.Octets = ...,
        temperature_board: _t.Int = ...,
        temperature_core: _t.Ints = ...,
        fan_speed: _t.Ints = ...,
        ram_usage: _t.Int = ...,
        ram_total: _t.Int = ...,
        storage_type: _t.Ints = ...,
        storage_usage: _t.Ints = ...,
        storage_total: _t.Ints = ...,
        link_type: _t.Ints = ...,
        link_tx_rate: _t.Ints = ...,
        link_rx_rate: _t.Ints = ...,
        link_tx_max: _t.Ints = ...,
        link_rx_max: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        component: _t.Int,
        uptime: _t.Int,
        type: _t.Int,
        cpu_cores: _t.Octets,
        cpu_combined: _t.Octets,
        gpu_cores: _t.Octets,
        gpu_combined: _t.Octets,
        temperature_board: _t.Int,
        temperature_core: _t.Ints,
        fan_speed: _t.Ints,
        ram_usage: _t.Int,
        ram_total: _t.Int,
        storage_type: _t.Ints,
        storage_usage: _t.Ints,
        storage_total: _t.Ints,
        link_type: _t.Ints,
        link_tx_rate: _t.Ints,
        link_rx_rate: _t.Ints,
        link_tx_max: _t.Ints,
        link_rx_max: _t.Ints,
        /,
    ) -> None: ...

class OpenDroneIDBasicID(_t.Message):
    ID_TYPE_NONE: _ty.Final = 0
    ID_TYPE_SERIAL_NUMBER: _ty.Final = 1
    ID_TYPE_CAA_REGISTRATION_ID: _ty.Final = 2
    ID_TYPE_UTM_ASSIGNED_UUID: _ty.Final = 3
    ID_TYPE_SPECIFIC_SESSION_ID: _ty.Final = 4
    UA_TYPE_NONE: _ty.Final = 0
    UA_TYPE_AEROPLANE: _ty.Final = 1
    UA_TYPE_HELICOPTER_OR_MULTIROTOR: _ty.Final = 2
    UA_TYPE_GYROPLANE: _ty.Final = 3
    UA_TYPE_HYBRID_LIFT: _ty.Final = 4
    UA_TYPE_ORNITHOPTER: _ty.Final = 5
    UA_TYPE_GLIDER: _ty.Final = 6
    UA_TYPE_KITE: _ty.Final = 7
    UA_TYPE_FREE_BALLOON: _ty.Final = 8
    UA_TYPE_CAPTIVE_BALLOON: _ty.Final = 9
    UA_TYPE_AIRSHIP: _ty.Final = 10
    UA_TYPE_FREE_FALL_PARACHUTE: _ty.Final = 11
    UA_TYPE_ROCKET: _ty.Final = 12
    UA_TYPE_TETHERED_POWERED_AIRCRAFT: _ty.Final = 13
    UA_TYPE_GROUND_OBSTACLE: _ty.Final = 14
    UA_TYPE_OTHER: _ty.Final = 15
    header: _msg_std_msgs.Header
    id_or_mac: _b.str
    id_type: _b.int
    ua_type: _b.int
    uas_id: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id_or_mac: _t.Text = ...,
        id_type: _t.Int = ...,
        ua_type: _t.Int = ...,
        uas_id: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id_or_mac: _t.Text,
        id_type: _t.Int,
        ua_type: _t.Int,
        uas_id: _t.Text,
        /,
    ) -> None: ...

class OpenDroneIDOperatorID(_t.Message):
    ID_TYPE_CAA: _ty.Final = 0
    header: _msg_std_msgs.Header
    id_or_mac: _b.str
    operator_id_type: _b.int
    operator_id: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id_or_mac: _t.Text = ...,
        operator_id_type: _t.Int = ...,
        operator_id: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id_or_mac: _t.Text,
        operator_id_type: _t.Int,
        operator_id: _t.Text,
        /,
    ) -> None: ...

class OpenDroneIDSelfID(_t.Message):
    DESC_TYPE_TEXT: _ty.Final = 0
    DESC_TYPE_EMERGENCY: _ty.Final = 1
    DESC_TYPE_EXTENDED_STATUS: _ty.Final = 2
    header: _msg_std_msgs.Header
    id_or_mac: _b.str
    description_type: _b.int
    description: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id_or_mac: _t.Text = ...,
        description_type: _t.Int = ...,
        description: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id_or_mac: _t.Text,
        description_type: _t.Int,
        description: _t.Text,
        /,
    ) -> None: ...

class OpenDroneIDSystem(_t.Message):
    LOCATION_TYPE_TAKEOFF: _ty.Final = 0
    LOCATION_TYPE_LIVE_GNSS: _ty.Final = 1
    LOCATION_TYPE_FIXED: _ty.Final = 2
    CLASSIFICATION_TYPE_UNDECLARED: _ty.Final = 0
    CLASSIFICATION_TYPE_EU: _ty.Final = 1
    header: _msg_std_msgs.Header
    id_or_mac: _b.str
    operator_location_type: _b.int
    classification_type: _b.int
    operator_latitude: _b.int
    operator_longitude: _b.int
    area_count: _b.int
    area_radius: _b.int
    area_ceiling: _b.float
    area_floor: _b.float
    category_eu: _b.int
    class_eu: _b.int
    operator_altitude_geo: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        id_or_mac: _t.Text = ...,
        operator_location_type: _t.Int = ...,
        classification_type: _t.Int = ...,
        operator_latitude: _t.Int = ...,
        operator_longitude: _t.Int = ...,
        area_count: _t.Int = ...,
        area_radius: _t.Int = ...,
        area_ceiling: _t.Float = ...,
        area_floor: _t.Float = ...,
        category_eu: _t.Int = ...,
        class_eu: _t.Int = ...,
        operator_altitude_geo: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        id_or_mac: _t.Text,
        operator_location_type: _t.Int,
        classification_type: _t.Int,
        operator_latitude: _t.Int,
        operator_longitude: _t.Int,
        area_count: _t.Int,
        area_radius: _t.Int,
        area_ceiling: _t.Float,
        area_floor: _t.Float,
        category_eu: _t.Int,
        class_eu: _t.Int,
        operator_altitude_geo: _t.Float,
        /,
    ) -> None: ...

class OpenDroneIDSystemUpdate(_t.Message):
    header: _msg_std_msgs.Header
    operator_latitude: _b.int
    operator_longitude: _b.int
    operator_altitude_geo: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        operator_latitude: _t.Int = ...,
        operator_longitude: _t.Int = ...,
        operator_altitude_geo: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        operator_latitude: _t.Int,
        operator_longitude: _t.Int,
        operator_altitude_geo: _t.Float,
        /,
    ) -> None: ...

class OpticalFlow(_t.Message):
    header: _msg_std_msgs.Header
    flow: _msg_geometry_msgs.Vector3
    flow_comp_m: _msg_geometry_msgs.Vector3
    quality: _b.int
    ground_distance: _b.float
    flow_rate: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        flow: _msg_geometry_msgs.Vector3 = ...,
        flow_comp_m: _msg_geometry_msgs.Vector3 = ...,
        quality: _t.Int = ...,
        ground_distance: _t.Float = ...,
        flow_rate: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        flow: _msg_geometry_msgs.Vector3,
        flow_comp_m: _msg_geometry_msgs.Vector3,
        quality: _t.Int,
        ground_distance: _t.Float,
        flow_rate: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class OpticalFlowRad(_t.Message):
    header: _msg_std_msgs.Header
    integration_time_us: _b.int
    integrated_x: _b.float
    integrated_y: _b.float
    integrated_xgyro: _b.float
    integrated_ygyro: _b.float
    integrated_zgyro: _b.float
    temperature: _b.int
    quality: _b.int
    time_delta_distance_us: _b.int
    distance: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        integration_time_us: _t.Int = ...,
        integrated_x: _t.Float = ...,
        integrated_y: _t.Float = ...,
        integrated_xgyro: _t.Float = ...,
        integrated_ygyro: _t.Float = ...,
        integrated_zgyro: _t.Float = ...,
        temperature: _t.Int = ...,
        quality: _t.Int = ...,
        time_delta_distance_us: _t.Int = ...,
        distance: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        integration_time_us: _t.Int,
        integrated_x: _t.Float,
        integrated_y: _t.Float,
        integrated_xgyro: _t.Float,
        integrated_ygyro: _t.Float,
        integrated_zgyro: _t.Float,
        temperature: _t.Int,
        quality: _t.Int,
        time_delta_distance_us: _t.Int,
        distance: _t.Float,
        /,
    ) -> None: ...

class OverrideRCIn(_t.Message):
    CHAN_RELEASE: _ty.Final = 0
    CHAN_NOCHANGE: _ty.Final = 65535
    channels: _t.IntArray
    @_ty.overload
    def __init__(self, *, channels: _t.Ints = ...) -> None: ...
    @_ty.overload
    def __init__(self, channels: _t.Ints, /) -> None: ...

class Param(_t.Message):
    header: _msg_std_msgs.Header
    param_id: _b.str
    value: _msg_mavros_msgs.ParamValue
    param_index: _b.int
    param_count: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        param_id: _t.Text = ...,
        value: _msg_mavros_msgs.ParamValue = ...,
        param_index: _t.Int = ...,
        param_count: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        param_id: _t.Text,
        value: _msg_mavros_msgs.ParamValue,
        param_index: _t.Int,
        param_count: _t.Int,
        /,
    ) -> None: ...

class ParamValue(_t.Message):
    integer: _b.int
    real: _b.float
    @_ty.overload
    def __init__(self, *, integer: _t.Int = ..., real: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, integer: _t.Int, real: _t.Float, /) -> None: ...

class PlayTuneV2(_t.Message):
    QBASIC1_1: _ty.Final = 1
    MML_MODERN: _ty.Final = 2
    format: _b.int
    tune: _b.str
    @_ty.overload
    def __init__(self, *, format: _t.Int = ..., tune: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, format: _t.Int, tune: _t.Text, /) -> None: ...

class PositionTarget(_t.Message):
    FRAME_LOCAL_NED: _ty.Final = 1
    FRAME_LOCAL_OFFSET_NED: _ty.Final = 7
    FRAME_BODY_NED: _ty.Final = 8
    FRAME_BODY_OFFSET_NED: _ty.Final = 9
    IGNORE_PX: _ty.Final = 1
    IGNORE_PY: _ty.Final = 2
    IGNORE_PZ: _ty.Final = 4
    IGNORE_VX: _ty.Final = 8
    IGNORE_VY: _ty.Final = 16
    IGNORE_VZ: _ty.Final = 32
    IGNORE_AFX: _ty.Final = 64
    IGNORE_AFY: _ty.Final = 128
    IGNORE_AFZ: _ty.Final = 256
    FORCE: _ty.Final = 512
    IGNORE_YAW: _ty.Final = 1024
    IGNORE_YAW_RATE: _ty.Final = 2048
    header: _msg_std_msgs.Header
    coordinate_frame: _b.int
    type_mask: _b.int
    position: _msg_geometry_msgs.Point
    velocity: _msg_geometry_msgs.Vector3
    acceleration_or_force: _msg_geometry_msgs.Vector3
    yaw: _b.float
    yaw_rate: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        coordinate_frame: _t.Int = ...,
        type_mask: _t.Int = ...,
        position: _msg_geometry_msgs.Point = ...,
        velocity: _msg_geometry_msgs.Vector3 = ...,
        acceleration_or_force: _msg_geometry_msgs.Vector3 = ...,
        yaw: _t.Float = ...,
        yaw_rate: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        coordinate_frame: _t.Int,
        type_mask: _t.Int,
        position: _msg_geometry_msgs.Point,
        velocity: _msg_geometry_msgs.Vector3,
        acceleration_or_force: _msg_geometry_msgs.Vector3,
        yaw: _t.Float,
        yaw_rate: _t.Float,
        /,
    ) -> None: ...

class RCIn(_t.Message):
    header: _msg_std_msgs.Header
    rssi: _b.int
    channels: _t.IntArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        rssi: _t.Int = ...,
        channels: _t.Ints = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        rssi: _t.Int,
        channels: _t.Ints,
        /,
    ) -> None: ...

class RCOut(_t.Message):
    header: _msg_std_msgs.Header
    channels: _t.IntArray
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., channels: _t.Ints = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, channels: _t.Ints, /) -> None: ...

class RTCM(_t.Message):
    header: _msg_std_msgs.Header
    data: _t.OctetArray
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., data: _t.Octets = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, data: _t.Octets, /) -> None: ...

class RTKBaseline(_t.Message):
    RTK_BASELINE_COORDINATE_SYSTEM_ECEF: _ty.Final = 0
    RTK_BASELINE_COORDINATE_SYSTEM_NED: _ty.Final = 1
    header: _msg_std_msgs.Header
    time_last_baseline_ms: _b.int
    rtk_receiver_id: _b.int
    wn: _b.int
    tow: _b.int
    rtk_health: _b.int
    rtk_rate: _b.int
    nsats: _b.int
    baseline_coords_type: _b.int
    baseline_a_mm: _b.int
    baseline_b_mm: _b.int
    baseline_c_mm: _b.int
    accuracy: _b.int
    iar_num_hypotheses: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        time_last_baseline_ms: _t.Int = ...,
        rtk_receiver_id: _t.Int = ...,
        wn: _t.Int = ...,
        tow: _t.Int = ...,
        rtk_health: _t.Int = ...,
        rtk_rate: _t.Int = ...,
        nsats: _t.Int = ...,
        baseline_coords_type: _t.Int = ...,
        baseline_a_mm: _t.Int = ...,
        baseline_b_mm: _t.Int = ...,
        baseline_c_mm: _t.Int = ...,
        accuracy: _t.Int = ...,
        iar_num_hypotheses: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        time_last_baseline_ms: _t.Int,
        rtk_receiver_id: _t.Int,
        wn: _t.Int,
        tow: _t.Int,
        rtk_health: _t.Int,
        rtk_rate: _t.Int,
        nsats: _t.Int,
        baseline_coords_type: _t.Int,
        baseline_a_mm: _t.Int,
        baseline_b_mm: _t.Int,
        baseline_c_mm: _t.Int,
        accuracy: _t.Int,
        iar_num_hypotheses: _t.Int,
        /,
    ) -> None: ...

class RadioStatus(_t.Message):
    header: _msg_std_msgs.Header
    rssi: _b.int
    remrssi: _b.int
    txbuf: _b.int
    noise: _b.int
    remnoise: _b.int
    rxerrors: _b.int
    fixed: _b.int
    rssi_dbm: _b.float
    remrssi_dbm: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        rssi: _t.Int = ...,
        remrssi: _t.Int = ...,
        txbuf: _t.Int = ...,
        noise: _t.Int = ...,
        remnoise: _t.Int = ...,
        rxerrors: _t.Int = ...,
        fixed: _t.Int = ...,
        rssi_dbm: _t.Float = ...,
        remrssi_dbm: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        rssi: _t.Int,
        remrssi: _t.Int,
        txbuf: _t.Int,
        noise: _t.Int,
        remnoise: _t.Int,
        rxerrors: _t.Int,
        fixed: _t.Int,
        rssi_dbm: _t.Float,
        remrssi_dbm: _t.Float,
        /,
    ) -> None: ...

class State(_t.Message):
    MODE_APM_PLANE_MANUAL: _ty.Final = "MANUAL"
    MODE_APM_PLANE_CIRCLE: _ty.Final = "CIRCLE"
    MODE_APM_PLANE_STABILIZE: _ty.Final = "STABILIZE"
    MODE_APM_PLANE_TRAINING: _ty.Final = "TRAINING"
    MODE_APM_PLANE_ACRO: _ty.Final = "ACRO"
    MODE_APM_PLANE_FBWA: _ty.Final = "FBWA"
    MODE_APM_PLANE_FBWB: _ty.Final = "FBWB"
    MODE_APM_PLANE_CRUISE: _ty.Final = "CRUISE"
    MODE_APM_PLANE_AUTOTUNE: _ty.Final = "AUTOTUNE"
    MODE_APM_PLANE_AUTO: _ty.Final = "AUTO"
    MODE_APM_PLANE_RTL: _ty.Final = "RTL"
    MODE_APM_PLANE_LOITER: _ty.Final = "LOITER"
    MODE_APM_PLANE_LAND: _ty.Final = "LAND"
    MODE_APM_PLANE_GUIDED: _ty.Final = "GUIDED"
    MODE_APM_PLANE_INITIALISING: _ty.Final = "INITIALISING"
    MODE_APM_PLANE_QSTABILIZE: _ty.Final = "QSTABILIZE"
    MODE_APM_PLANE_QHOVER: _ty.Final = "QHOVER"
    MODE_APM_PLANE_QLOITER: _ty.Final = "QLOITER"
    MODE_APM_PLANE_QLAND: _ty.Final = "QLAND"
    MODE_APM_PLANE_QRTL: _ty.Final = "QRTL"
    MODE_APM_COPTER_STABILIZE: _ty.Final = "STABILIZE"
    MODE_APM_COPTER_ACRO: _ty.Final = "ACRO"
    MODE_APM_COPTER_ALT_HOLD: _ty.Final = "ALT_HOLD"
    MODE_APM_COPTER_AUTO: _ty.Final = "AUTO"
    MODE_APM_COPTER_GUIDED: _ty.Final = "GUIDED"
    MODE_APM_COPTER_LOITER: _ty.Final = "LOITER"
    MODE_APM_COPTER_RTL: _ty.Final = "RTL"
    MODE_APM_COPTER_CIRCLE: _ty.Final = "CIRCLE"
    MODE_APM_COPTER_POSITION: _ty.Final = "POSITION"
    MODE_APM_COPTER_LAND: _ty.Final = "LAND"
    MODE_APM_COPTER_OF_LOITER: _ty.Final = "OF_LOITER"
    MODE_APM_COPTER_DRIFT: _ty.Final = "DRIFT"
    MODE_APM_COPTER_SPORT: _ty.Final = "SPORT"
    MODE_APM_COPTER_FLIP: _ty.Final = "FLIP"
    MODE_APM_COPTER_AUTOTUNE: _ty.Final = "AUTOTUNE"
    MODE_APM_COPTER_POSHOLD: _ty.Final = "POSHOLD"
    MODE_APM_COPTER_BRAKE: _ty.Final = "BRAKE"
    MODE_APM_COPTER_THROW: _ty.Final = "THROW"
    MODE_APM_COPTER_AVOID_ADSB: _ty.Final = "AVOID_ADSB"
    MODE_APM_COPTER_GUIDED_NOGPS: _ty.Final = "GUIDED_NOGPS"
    MODE_APM_ROVER_MANUAL: _ty.Final = "MANUAL"
    MODE_APM_ROVER_LEARNING: _ty.Final = "LEARNING"
    MODE_APM_ROVER_STEERING: _ty.Final = "STEERING"
    MODE_APM_ROVER_HOLD: _ty.Final = "HOLD"
    MODE_APM_ROVER_AUTO: _ty.Final = "AUTO"
    MODE_APM_ROVER_RTL: _ty.Final = "RTL"
    MODE_APM_ROVER_GUIDED: _ty.Final = "GUIDED"
    MODE_APM_ROVER_INITIALISING: _ty.Final = "INITIALISING"
    MODE_PX4_MANUAL: _ty.Final = "MANUAL"
    MODE_PX4_ACRO: _ty.Final = "ACRO"
    MODE_PX4_ALTITUDE: _ty.Final = "ALTCTL"
    MODE_PX4_POSITION: _ty.Final = "POSCTL"
    MODE_PX4_OFFBOARD: _ty.Final = "OFFBOARD"
    MODE_PX4_STABILIZED: _ty.Final = "STABILIZED"
    MODE_PX4_RATTITUDE: _ty.Final = "RATTITUDE"
    MODE_PX4_MISSION: _ty.Final = "AUTO.MISSION"
    MODE_PX4_LOITER: _ty.Final = "AUTO.LOITER"
    MODE_PX4_RTL: _ty.Final = "AUTO.RTL"
    MODE_PX4_LAND: _ty.Final = "AUTO.LAND"
    MODE_PX4_RTGS: _ty.Final = "AUTO.RTGS"
    MODE_PX4_READY: _ty.Final = "AUTO.READY"
    MODE_PX4_TAKEOFF: _ty.Final = "AUTO.TAKEOFF"
    header: _msg_std_msgs.Header
    connected: _b.bool
    armed: _b.bool
    guided: _b.bool
    manual_input: _b.bool
    mode: _b.str
    system_status: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        connected: _t.Bool = ...,
        armed: _t.Bool = ...,
        guided: _t.Bool = ...,
        manual_input: _t.Bool = ...,
        mode: _t.Text = ...,
        system_status: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        connected: _t.Bool,
        armed: _t.Bool,
        guided: _t.Bool,
        manual_input: _t.Bool,
        mode: _t.Text,
        system_status: _t.Int,
        /,
    ) -> None: ...

class StatusEvent(_t.Message):
    EMERGENCY: _ty.Final = 0
    ALERT: _ty.Final = 1
    CRITICAL: _ty.Final = 2
    ERROR: _ty.Final = 3
    WARNING: _ty.Final = 4
    NOTICE: _ty.Final = 5
    INFO: _ty.Final = 6
    DEBUG: _ty.Final = 7
    header: _msg_std_msgs.Header
    severity: _b.int
    px4_id: _b.int
    arguments: _t.OctetArray
    sequence: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        severity: _t.Int = ...,
        px4_id: _t.Int = ...,
        arguments: _t.Octets = ...,
        sequence: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        severity: _t.Int,
        px4_id: _t.Int,
        arguments: _t.Octets,
        sequence: _t.Int,
        /,
    ) -> None: ...

class StatusText(_t.Message):
    EMERGENCY: _ty.Final = 0
    ALERT: _ty.Final = 1
    CRITICAL: _ty.Final = 2
    ERROR: _ty.Final = 3
    WARNING: _ty.Final = 4
    NOTICE: _ty.Final = 5
    INFO: _ty.Final = 6
    DEBUG: _ty.Final = 7
    header: _msg_std_msgs.Header
    severity: _b.int
    text: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        severity: _t.Int = ...,
        text: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        severity: _t.Int,
        text: _t.Text,
        /,
    ) -> None: ...

class SysStatus(_t.Message):
    header: _msg_std_msgs.Header
    sensors_present: _b.int
    sensors_enabled: _b.int
    sensors_health: _b.int
    load: _b.int
    voltage_battery: _b.int
    current_battery: _b.int
    battery_remaining: _b.int
    drop_rate_comm: _b.int
    errors_comm: _b.int
    errors_count1: _b.int
    errors_count2: _b.int
    errors_count3: _b.int
    errors_count4: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        sensors_present: _t.Int = ...,
        sensors_enabled: _t.Int = ...,
        sensors_health: _t.Int = ...,
        load: _t.Int = ...,
        voltage_battery: _t.Int = ...,
        current_battery: _t.Int = ...,
        battery_remaining: _t.Int = ...,
        drop_rate_comm: _t.Int = ...,
        errors_comm: _t.Int = ...,
        errors_count1: _t.Int = ...,
        errors_count2: _t.Int = ...,
        errors_count3: _t.Int = ...,
        errors_count4: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        sensors_present: _t.Int,
        sensors_enabled: _t.Int,
        sensors_health: _t.Int,
        load: _t.Int,
        voltage_battery: _t.Int,
        current_battery: _t.Int,
        battery_remaining: _t.Int,
        drop_rate_comm: _t.Int,
        errors_comm: _t.Int,
        errors_count1: _t.Int,
        errors_count2: _t.Int,
        errors_count3: _t.Int,
        errors_count4: _t.Int,
        /,
    ) -> None: ...

class TerrainReport(_t.Message):
    header: _msg_std_msgs.Header
    latitude: _b.float
    longitude: _b.float
    spacing: _b.int
    terrain_height: _b.float
    current_height: _b.float
    pending: _b.int
    loaded: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        spacing: _t.Int = ...,
        terrain_height: _t.Float = ...,
        current_height: _t.Float = ...,
        pending: _t.Int = ...,
        loaded: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        latitude: _t.Float,
        longitude: _t.Float,
        spacing: _t.Int,
        terrain_height: _t.Float,
        current_height: _t.Float,
        pending: _t.Int,
        loaded: _t.Int,
        /,
    ) -> None: ...

class Thrust(_t.Message):
    header: _msg_std_msgs.Header
    thrust: _b.float
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., thrust: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, thrust: _t.Float, /) -> None: ...

class TimesyncStatus(_t.Message):
    header: _msg_std_msgs.Header
    remote_timestamp_ns: _b.int
    observed_offset_ns: _b.int
    estimated_offset_ns: _b.int
    round_trip_time_ms: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        remote_timestamp_ns: _t.Int = ...,
        observed_offset_ns: _t.Int = ...,
        estimated_offset_ns: _t.Int = ...,
        round_trip_time_ms: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        remote_timestamp_ns: _t.Int,
        observed_offset_ns: _t.Int,
        estimated_offset_ns: _t.Int,
        round_trip_time_ms: _t.Float,
        /,
    ) -> None: ...

class Trajectory(_t.Message):
    MAV_TRAJECTORY_REPRESENTATION_WAYPOINTS: _ty.Final = 0
    MAV_TRAJECTORY_REPRESENTATION_BEZIER: _ty.Final = 1
    header: _msg_std_msgs.Header
    type: _b.int
    point_1: _msg_mavros_msgs.PositionTarget
    point_2: _msg_mavros_msgs.PositionTarget
    point_3: _msg_mavros_msgs.PositionTarget
    point_4: _msg_mavros_msgs.PositionTarget
    point_5: _msg_mavros_msgs.PositionTarget
    point_valid: _t.OctetArray
    command: _t.IntArray
    time_horizon: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        type: _t.Int = ...,
        point_1: _msg_mavros_msgs.PositionTarget = ...,
        point_2: _msg_mavros_msgs.PositionTarget = ...,
        point_3: _msg_mavros_msgs.PositionTarget = ...,
        point_4: _msg_mavros_msgs.PositionTarget = ...,
        point_5: _msg_mavros_msgs.PositionTarget = ...,
        point_valid: _t.Octets = ...,
        command: _t.Ints = ...,
        time_horizon: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        type: _t.Int,
        point_1: _msg_mavros_msgs.PositionTarget,
        point_2: _msg_mavros_msgs.PositionTarget,
        point_3: _msg_mavros_msgs.PositionTarget,
        point_4: _msg_mavros_msgs.PositionTarget,
        point_5: _msg_mavros_msgs.PositionTarget,
        point_valid: _t.Octets,
        command: _t.Ints,
        time_horizon: _t.Floats,
        /,
    ) -> None: ...

class Tunnel(_t.Message):
    PAYLOAD_TYPE_UNKNOWN: _ty.Final = 0
    PAYLOAD_TYPE_STORM32_RESERVED0: _ty.Final = 200
    PAYLOAD_TYPE_STORM32_RESERVED1: _ty.Final = 201
    PAYLOAD_TYPE_STORM32_RESERVED2: _ty.Final = 202
    PAYLOAD_TYPE_STORM32_RESERVED3: _ty.Final = 203
    PAYLOAD_TYPE_STORM32_RESERVED4: _ty.Final = 204
    PAYLOAD_TYPE_STORM32_RESERVED5: _ty.Final = 205
    PAYLOAD_TYPE_STORM32_RESERVED6: _ty.Final = 206
    PAYLOAD_TYPE_STORM32_RESERVED7: _ty.Final = 207
    PAYLOAD_TYPE_STORM32_RESERVED8: _ty.Final = 208
    PAYLOAD_TYPE_STORM32_RESERVED9: _ty.Final = 209
    target_system: _b.int
    target_component: _b.int
    payload_type: _b.int
    payload_length: _b.int
    payload: _t.OctetArray
    @_ty.overload
    def __init__(
        self,
        *,
        target_system: _t.Int = ...,
        target_component: _t.Int = ...,
        payload_type: _t.Int = ...,
        payload_length: _t.Int = ...,
        payload: _t.Octets = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        target_system: _t.Int,
        target_component: _t.Int,
        payload_type: _t.Int,
        payload_length: _t.Int,
        payload: _t.Octets,
        /,
    ) -> None: ...

class VFR_HUD(_t.Message):
    header: _msg_std_msgs.Header
    airspeed: _b.float
    groundspeed: _b.float
    heading: _b.int
    throttle: _b.float
    altitude: _b.float
    climb: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        airspeed: _t.Float = ...,
        groundspeed: _t.Float = ...,
        heading: _t.Int = ...,
        throttle: _t.Float = ...,
        altitude: _t.Float = ...,
        climb: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        airspeed: _t.Float,
        groundspeed: _t.Float,
        heading: _t.Int,
        throttle: _t.Float,
        altitude: _t.Float,
        climb: _t.Float,
        /,
    ) -> None: ...

class VehicleInfo(_t.Message):
    HAVE_INFO_HEARTBEAT: _ty.Final = 1
    HAVE_INFO_AUTOPILOT_VERSION: _ty.Final = 2
    header: _msg_std_msgs.Header
    available_info: _b.int
    sysid: _b.int
    compid: _b.int
    autopilot: _b.int
    type: _b.int
    system_status: _b.int
    base_mode: _b.int
    custom_mode: _b.int
    mode: _b.str
    mode_id: _b.int
    capabilities: _b.int
    flight_sw_version: _b.int
    middleware_sw_version: _b.int
    os_sw_version: _b.int
    board_version: _b.int
    flight_custom_version: _b.str
    vendor_id: _b.int
    product_id: _b.int
    uid: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        available_info: _t.Int = ...,
        sysid: _t.Int = ...,
        compid: _t.Int = ...,
        autopilot: _t.Int = ...,
        type: _t.Int = ...,
        system_status: _t.Int = ...,
        base_mode: _t.Int = ...,
        custom_mode: _t.Int = ...,
        mode: _t.Text = ...,
        mode_id: _t.Int = ...,
        capabilities: _t.Int = ...,
        flight_sw_version: _t.Int = ...,
        middleware_sw_version: _t.Int = ...,
        os_sw_version: _t.Int = ...,
        board_version: _t.Int = ...,
        flight_custom_version: _t.Text = ...,
        vendor_id: _t.Int = ...,
        product_id: _t.Int = ...,
        uid: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        available_info: _t.Int,
        sysid: _t.Int,
        compid: _t.Int,
        autopilot: _t.Int,
        type: _t.Int,
        system_status: _t.Int,
        base_mode: _t.Int,
        custom_mode: _t.Int,
        mode: _t.Text,
        mode_id: _t.Int,
        capabilities: _t.Int,
        flight_sw_version: _t.Int,
        middleware_sw_version: _t.Int,
        os_sw_version: _t.Int,
        board_version: _t.Int,
        flight_custom_version: _t.Text,
        vendor_id: _t.Int,
        product_id: _t.Int,
        uid: _t.Int,
        /,
    ) -> None: ...

class Vibration(_t.Message):
    header: _msg_std_msgs.Header
    vibration: _msg_geometry_msgs.Vector3
    clipping: _t.FloatArray
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        vibration: _msg_geometry_msgs.Vector3 = ...,
        clipping: _t.Floats = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        vibration: _msg_geometry_msgs.Vector3,
        clipping: _t.Floats,
        /,
    ) -> None: ...

class Waypoint(_t.Message):
    FRAME_GLOBAL: _ty.Final = 0
    FRAME_LOCAL_NED: _ty.Final = 1
    FRAME_MISSION: _ty.Final = 2
    FRAME_GLOBAL_REL_ALT: _ty.Final = 3
    FRAME_LOCAL_ENU: _ty.Final = 4
    FRAME_GLOBAL_INT: _ty.Final = 5
    FRAME_GLOBAL_RELATIVE_ALT_INT: _ty.Final = 6
    FRAME_LOCAL_OFFSET_NED: _ty.Final = 7
    FRAME_BODY_NED: _ty.Final = 8
    FRAME_BODY_OFFSET_NED: _ty.Final = 9
    FRAME_GLOBAL_TERRAIN_ALT: _ty.Final = 10
    FRAME_GLOBAL_TERRAIN_ALT_INT: _ty.Final = 11
    FRAME_BODY_FRD: _ty.Final = 12
    FRAME_RESERVED_13: _ty.Final = 13
    FRAME_RESERVED_14: _ty.Final = 14
    FRAME_RESERVED_15: _ty.Final = 15
    FRAME_RESERVED_16: _ty.Final = 16
    FRAME_RESERVED_17: _ty.Final = 17
    FRAME_RESERVED_18: _ty.Final = 18
    FRAME_RESERVED_19: _ty.Final = 19
    FRAME_LOCAL_FRD: _ty.Final = 20
    FRAME_LOCAL_FLU: _ty.Final = 21
    frame: _b.int
    command: _b.int
    is_current: _b.bool
    autocontinue: _b.bool
    param1: _b.float
    param2: _b.float
    param3: _b.float
    param4: _b.float
    x_lat: _b.float
    y_long: _b.float
    z_alt: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        frame: _t.Int = ...,
        command: _t.Int = ...,
        is_current: _t.Bool = ...,
        autocontinue: _t.Bool = ...,
        param1: _t.Float = ...,
        param2: _t.Float = ...,
        param3: _t.Float = ...,
        param4: _t.Float = ...,
        x_lat: _t.Float = ...,
        y_long: _t.Float = ...,
        z_alt: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        frame: _t.Int,
        command: _t.Int,
        is_current: _t.Bool,
        autocontinue: _t.Bool,
        param1: _t.Float,
        param2: _t.Float,
        param3: _t.Float,
        param4: _t.Float,
        x_lat: _t.Float,
        y_long: _t.Float,
        z_alt: _t.Float,
        /,
    ) -> None: ...

class WaypointList(_t.Message):
    current_seq: _b.int
    waypoints: _t.ItemList[_msg_mavros_msgs.Waypoint]
    @_ty.overload
    def __init__(
        self,
        *,
        current_seq: _t.Int = ...,
        waypoints: _t.Items[_msg_mavros_msgs.Waypoint] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        current_seq: _t.Int,
        waypoints: _t.Items[_msg_mavros_msgs.Waypoint],
        /,
    ) -> None: ...

class WaypointReached(_t.Message):
    header: _msg_std_msgs.Header
    wp_seq: _b.int
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., wp_seq: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, wp_seq: _t.Int, /) -> None: ...

class WheelOdomStamped(_t.Message):
    header: _msg_std_msgs.Header
    data: _t.FloatArray
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., data: _t.Floats = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, data: _t.Floats, /) -> None: ...
