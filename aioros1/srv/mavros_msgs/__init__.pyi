# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.mavros_msgs as _msg_mavros_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class CommandAckRequest(_t.Message):
    command: _b.int
    result: _b.int
    progress: _b.int
    result_param2: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        command: _t.Int = ...,
        result: _t.Int = ...,
        progress: _t.Int = ...,
        result_param2: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        command: _t.Int,
        result: _t.Int,
        progress: _t.Int,
        result_param2: _t.Int,
        /,
    ) -> None: ...

class CommandAckResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandAck(_t.Service[CommandAckRequest, CommandAckResponse]):
    Request: _ty.TypeAlias = CommandAckRequest
    Response: _ty.TypeAlias = CommandAckResponse

class CommandBoolRequest(_t.Message):
    value: _b.bool
    @_ty.overload
    def __init__(self, *, value: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, value: _t.Bool, /) -> None: ...

class CommandBoolResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandBool(_t.Service[CommandBoolRequest, CommandBoolResponse]):
    Request: _ty.TypeAlias = CommandBoolRequest
    Response: _ty.TypeAlias = CommandBoolResponse

class CommandHomeRequest(_t.Message):
    current_gps: _b.bool
    yaw: _b.float
    latitude: _b.float
    longitude: _b.float
    altitude: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        current_gps: _t.Bool = ...,
        yaw: _t.Float = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        altitude: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        current_gps: _t.Bool,
        yaw: _t.Float,
        latitude: _t.Float,
        longitude: _t.Float,
        altitude: _t.Float,
        /,
    ) -> None: ...

class CommandHomeResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandHome(_t.Service[CommandHomeRequest, CommandHomeResponse]):
    Request: _ty.TypeAlias = CommandHomeRequest
    Response: _ty.TypeAlias = CommandHomeResponse

class CommandIntRequest(_t.Message):
    broadcast: _b.bool
    frame: _b.int
    command: _b.int
    current: _b.int
    autocontinue: _b.int
    param1: _b.float
    param2: _b.float
    param3: _b.float
    param4: _b.float
    x: _b.int
    y: _b.int
    z: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        broadcast: _t.Bool = ...,
        frame: _t.Int = ...,
        command: _t.Int = ...,
        current: _t.Int = ...,
        autocontinue: _t.Int = ...,
        param1: _t.Float = ...,
        param2: _t.Float = ...,
        param3: _t.Float = ...,
        param4: _t.Float = ...,
        x: _t.Int = ...,
        y: _t.Int = ...,
        z: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        broadcast: _t.Bool,
        frame: _t.Int,
        command: _t.Int,
        current: _t.Int,
        autocontinue: _t.Int,
        param1: _t.Float,
        param2: _t.Float,
        param3: _t.Float,
        param4: _t.Float,
        x: _t.Int,
        y: _t.Int,
        z: _t.Float,
        /,
    ) -> None: ...

class CommandIntResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class CommandInt(_t.Service[CommandIntRequest, CommandIntResponse]):
    Request: _ty.TypeAlias = CommandIntRequest
    Response: _ty.TypeAlias = CommandIntResponse

class CommandLongRequest(_t.Message):
    broadcast: _b.bool
    command: _b.int
    confirmation: _b.int
    param1: _b.float
    param2: _b.float
    param3: _b.float
    param4: _b.float
    param5: _b.float
    param6: _b.float
    param7: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        broadcast: _t.Bool = ...,
        command: _t.Int = ...,
        confirmation: _t.Int = ...,
        param1: _t.Float = ...,
        param2: _t.Float = ...,
        param3: _t.Float = ...,
        param4: _t.Float = ...,
        param5: _t.Float = ...,
        param6: _t.Float = ...,
        param7: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        broadcast: _t.Bool,
        command: _t.Int,
        confirmation: _t.Int,
        param1: _t.Float,
        param2: _t.Float,
        param3: _t.Float,
        param4: _t.Float,
        param5: _t.Float,
        param6: _t.Float,
        param7: _t.Float,
        /,
    ) -> None: ...

class CommandLongResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandLong(_t.Service[CommandLongRequest, CommandLongResponse]):
    Request: _ty.TypeAlias = CommandLongRequest
    Response: _ty.TypeAlias = CommandLongResponse

class CommandTOLRequest(_t.Message):
    min_pitch: _b.float
    yaw: _b.float
    latitude: _b.float
    longitude: _b.float
    altitude: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        min_pitch: _t.Float = ...,
        yaw: _t.Float = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        altitude: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        min_pitch: _t.Float,
        yaw: _t.Float,
        latitude: _t.Float,
        longitude: _t.Float,
        altitude: _t.Float,
        /,
    ) -> None: ...

class CommandTOLResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandTOL(_t.Service[CommandTOLRequest, CommandTOLResponse]):
    Request: _ty.TypeAlias = CommandTOLRequest
    Response: _ty.TypeAlias = CommandTOLResponse

class CommandTOLLocalRequest(_t.Message):
    min_pitch: _b.float
    offset: _b.float
    rate: _b.float
    yaw: _b.float
    position: _msg_geometry_msgs.Vector3
    @_ty.overload
    def __init__(
        self,
        *,
        min_pitch: _t.Float = ...,
        offset: _t.Float = ...,
        rate: _t.Float = ...,
        yaw: _t.Float = ...,
        position: _msg_geometry_msgs.Vector3 = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        min_pitch: _t.Float,
        offset: _t.Float,
        rate: _t.Float,
        yaw: _t.Float,
        position: _msg_geometry_msgs.Vector3,
        /,
    ) -> None: ...

class CommandTOLLocalResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandTOLLocal(_t.Service[CommandTOLLocalRequest, CommandTOLLocalResponse]):
    Request: _ty.TypeAlias = CommandTOLLocalRequest
    Response: _ty.TypeAlias = CommandTOLLocalResponse

class CommandTriggerControlRequest(_t.Message):
    trigger_enable: _b.bool
    sequence_reset: _b.bool
    trigger_pause: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        trigger_enable: _t.Bool = ...,
        sequence_reset: _t.Bool = ...,
        trigger_pause: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        trigger_enable: _t.Bool,
        sequence_reset: _t.Bool,
        trigger_pause: _t.Bool,
        /,
    ) -> None: ...

class CommandTriggerControlResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandTriggerControl(_t.Service[CommandTriggerControlRequest, CommandTriggerControlResponse]):
    Request: _ty.TypeAlias = CommandTriggerControlRequest
    Response: _ty.TypeAlias = CommandTriggerControlResponse

class CommandTriggerIntervalRequest(_t.Message):
    cycle_time: _b.float
    integration_time: _b.float
    @_ty.overload
    def __init__(self, *, cycle_time: _t.Float = ..., integration_time: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, cycle_time: _t.Float, integration_time: _t.Float, /) -> None: ...

class CommandTriggerIntervalResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandTriggerInterval(_t.Service[CommandTriggerIntervalRequest, CommandTriggerIntervalResponse]):
    Request: _ty.TypeAlias = CommandTriggerIntervalRequest
    Response: _ty.TypeAlias = CommandTriggerIntervalResponse

class CommandVtolTransitionRequest(_t.Message):
    STATE_MC: _ty.Final = 3
    STATE_FW: _ty.Final = 4
    header: _msg_std_msgs.Header
    state: _b.int
    @_ty.overload
    def __init__(self, *, header: _msg_std_msgs.Header = ..., state: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, header: _msg_std_msgs.Header, state: _t.Int, /) -> None: ...

class CommandVtolTransitionResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class CommandVtolTransition(_t.Service[CommandVtolTransitionRequest, CommandVtolTransitionResponse]):
    Request: _ty.TypeAlias = CommandVtolTransitionRequest
    Response: _ty.TypeAlias = CommandVtolTransitionResponse

class EndpointAddRequest(_t.Message):
    TYPE_FCU: _ty.Final = 0
    TYPE_GCS: _ty.Final = 1
    TYPE_UAS: _ty.Final = 2
    url: _b.str
    type: _b.int
    @_ty.overload
    def __init__(self, *, url: _t.Text = ..., type: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, url: _t.Text, type: _t.Int, /) -> None: ...

class EndpointAddResponse(_t.Message):
    successful: _b.bool
    reason: _b.str
    id: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        successful: _t.Bool = ...,
        reason: _t.Text = ...,
        id: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, successful: _t.Bool, reason: _t.Text, id: _t.Int, /) -> None: ...

class EndpointAdd(_t.Service[EndpointAddRequest, EndpointAddResponse]):
    Request: _ty.TypeAlias = EndpointAddRequest
    Response: _ty.TypeAlias = EndpointAddResponse

class EndpointDelRequest(_t.Message):
    TYPE_FCU: _ty.Final = 0
    TYPE_GCS: _ty.Final = 1
    TYPE_UAS: _ty.Final = 2
    id: _b.int
    url: _b.str
    type: _b.int
    @_ty.overload
    def __init__(self, *, id: _t.Int = ..., url: _t.Text = ..., type: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, id: _t.Int, url: _t.Text, type: _t.Int, /) -> None: ...

class EndpointDelResponse(_t.Message):
    successful: _b.bool
    @_ty.overload
    def __init__(self, *, successful: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, successful: _t.Bool, /) -> None: ...

class EndpointDel(_t.Service[EndpointDelRequest, EndpointDelResponse]):
    Request: _ty.TypeAlias = EndpointDelRequest
    Response: _ty.TypeAlias = EndpointDelResponse

class FileChecksumRequest(_t.Message):
    file_path: _b.str
    @_ty.overload
    def __init__(self, *, file_path: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, file_path: _t.Text, /) -> None: ...

class FileChecksumResponse(_t.Message):
    crc32: _b.int
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        crc32: _t.Int = ...,
        success: _t.Bool = ...,
        r_errno: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, crc32: _t.Int, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileChecksum(_t.Service[FileChecksumRequest, FileChecksumResponse]):
    Request: _ty.TypeAlias = FileChecksumRequest
    Response: _ty.TypeAlias = FileChecksumResponse

class FileCloseRequest(_t.Message):
    file_path: _b.str
    @_ty.overload
    def __init__(self, *, file_path: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, file_path: _t.Text, /) -> None: ...

class FileCloseResponse(_t.Message):
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., r_errno: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileClose(_t.Service[FileCloseRequest, FileCloseResponse]):
    Request: _ty.TypeAlias = FileCloseRequest
    Response: _ty.TypeAlias = FileCloseResponse

class FileListRequest(_t.Message):
    dir_path: _b.str
    @_ty.overload
    def __init__(self, *, dir_path: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, dir_path: _t.Text, /) -> None: ...

class FileListResponse(_t.Message):
    list: _t.ItemList[_msg_mavros_msgs.FileEntry]
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        list: _t.Items[_msg_mavros_msgs.FileEntry] = ...,
        success: _t.Bool = ...,
        r_errno: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        list: _t.Items[_msg_mavros_msgs.FileEntry],
        success: _t.Bool,
        r_errno: _t.Int,
        /,
    ) -> None: ...

class FileList(_t.Service[FileListRequest, FileListResponse]):
    Request: _ty.TypeAlias = FileListRequest
    Response: _ty.TypeAlias = FileListResponse

class FileMakeDirRequest(_t.Message):
    dir_path: _b.str
    @_ty.overload
    def __init__(self, *, dir_path: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, dir_path: _t.Text, /) -> None: ...

class FileMakeDirResponse(_t.Message):
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., r_errno: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileMakeDir(_t.Service[FileMakeDirRequest, FileMakeDirResponse]):
    Request: _ty.TypeAlias = FileMakeDirRequest
    Response: _ty.TypeAlias = FileMakeDirResponse

class FileOpenRequest(_t.Message):
    MODE_READ: _ty.Final = 0
    MODE_WRITE: _ty.Final = 1
    MODE_CREATE: _ty.Final = 2
    file_path: _b.str
    mode: _b.int
    @_ty.overload
    def __init__(self, *, file_path: _t.Text = ..., mode: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, file_path: _t.Text, mode: _t.Int, /) -> None: ...

class FileOpenResponse(_t.Message):
    size: _b.int
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        size: _t.Int = ...,
        success: _t.Bool = ...,
        r_errno: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, size: _t.Int, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileOpen(_t.Service[FileOpenRequest, FileOpenResponse]):
    Request: _ty.TypeAlias = FileOpenRequest
    Response: _ty.TypeAlias = FileOpenResponse

class FileReadRequest(_t.Message):
    file_path: _b.str
    offset: _b.int
    size: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        file_path: _t.Text = ...,
        offset: _t.Int = ...,
        size: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, file_path: _t.Text, offset: _t.Int, size: _t.Int, /) -> None: ...

class FileReadResponse(_t.Message):
    data: _t.OctetArray
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        data: _t.Octets = ...,
        success: _t.Bool = ...,
        r_errno: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Octets, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileRead(_t.Service[FileReadRequest, FileReadResponse]):
    Request: _ty.TypeAlias = FileReadRequest
    Response: _ty.TypeAlias = FileReadResponse

class FileRemoveRequest(_t.Message):
    file_path: _b.str
    @_ty.overload
    def __init__(self, *, file_path: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, file_path: _t.Text, /) -> None: ...

class FileRemoveResponse(_t.Message):
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., r_errno: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileRemove(_t.Service[FileRemoveRequest, FileRemoveResponse]):
    Request: _ty.TypeAlias = FileRemoveRequest
    Response: _ty.TypeAlias = FileRemoveResponse

class FileRemoveDirRequest(_t.Message):
    dir_path: _b.str
    @_ty.overload
    def __init__(self, *, dir_path: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, dir_path: _t.Text, /) -> None: ...

class FileRemoveDirResponse(_t.Message):
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., r_errno: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileRemoveDir(_t.Service[FileRemoveDirRequest, FileRemoveDirResponse]):
    Request: _ty.TypeAlias = FileRemoveDirRequest
    Response: _ty.TypeAlias = FileRemoveDirResponse

class FileRenameRequest(_t.Message):
    old_path: _b.str
    new_path: _b.str
    @_ty.overload
    def __init__(self, *, old_path: _t.Text = ..., new_path: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, old_path: _t.Text, new_path: _t.Text, /) -> None: ...

class FileRenameResponse(_t.Message):
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., r_errno: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileRename(_t.Service[FileRenameRequest, FileRenameResponse]):
    Request: _ty.TypeAlias = FileRenameRequest
    Response: _ty.TypeAlias = FileRenameResponse

class FileTruncateRequest(_t.Message):
    file_path: _b.str
    length: _b.int
    @_ty.overload
    def __init__(self, *, file_path: _t.Text = ..., length: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, file_path: _t.Text, length: _t.Int, /) -> None: ...

class FileTruncateResponse(_t.Message):
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., r_errno: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileTruncate(_t.Service[FileTruncateRequest, FileTruncateResponse]):
    Request: _ty.TypeAlias = FileTruncateRequest
    Response: _ty.TypeAlias = FileTruncateResponse

class FileWriteRequest(_t.Message):
    file_path: _b.str
    offset: _b.int
    data: _t.OctetArray
    @_ty.overload
    def __init__(
        self,
        *,
        file_path: _t.Text = ...,
        offset: _t.Int = ...,
        data: _t.Octets = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, file_path: _t.Text, offset: _t.Int, data: _t.Octets, /) -> None: ...

class FileWriteResponse(_t.Message):
    success: _b.bool
    r_errno: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., r_errno: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, r_errno: _t.Int, /) -> None: ...

class FileWrite(_t.Service[FileWriteRequest, FileWriteResponse]):
    Request: _ty.TypeAlias = FileWriteRequest
    Response: _ty.TypeAlias = FileWriteResponse

class GimbalGetInformationRequest(_t.Message):
    def __init__(self) -> None: ...

class GimbalGetInformationResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class GimbalGetInformation(_t.Service[GimbalGetInformationRequest, GimbalGetInformationResponse]):
    Request: _ty.TypeAlias = GimbalGetInformationRequest
    Response: _ty.TypeAlias = GimbalGetInformationResponse

class GimbalManagerCameraTrackRequest(_t.Message):
    CAMERA_TRACK_MODE_POINT: _ty.Final = 0
    CAMERA_TRACK_MODE_RECTANGLE: _ty.Final = 1
    CAMERA_TRACK_MODE_STOP_TRACKING: _ty.Final = 2
    mode: _b.int
    x: _b.float
    y: _b.float
    radius: _b.float
    top_left_x: _b.float
    top_left_y: _b.float
    bottom_right_x: _b.float
    bottom_right_y: _b.float
    @_ty.overload
    def __init__(
        self,
        *,
        mode: _t.Int = ...,
        x: _t.Float = ...,
        y: _t.Float = ...,
        radius: _t.Float = ...,
        top_left_x: _t.Float = ...,
        top_left_y: _t.Float = ...,
        bottom_right_x: _t.Float = ...,
        bottom_right_y: _t.Float = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        mode: _t.Int,
        x: _t.Float,
        y: _t.Float,
        radius: _t.Float,
        top_left_x: _t.Float,
        top_left_y: _t.Float,
        bottom_right_x: _t.Float,
        bottom_right_y: _t.Float,
        /,
    ) -> None: ...

class GimbalManagerCameraTrackResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class GimbalManagerCameraTrack(_t.Service[GimbalManagerCameraTrackRequest, GimbalManagerCameraTrackResponse]):
    Request: _ty.TypeAlias = GimbalManagerCameraTrackRequest
    Response: _ty.TypeAlias = GimbalManagerCameraTrackResponse

class GimbalManagerConfigureRequest(_t.Message):
    sysid_primary: _b.int
    compid_primary: _b.int
    sysid_secondary: _b.int
    compid_secondary: _b.int
    gimbal_device_id: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        sysid_primary: _t.Int = ...,
        compid_primary: _t.Int = ...,
        sysid_secondary: _t.Int = ...,
        compid_secondary: _t.Int = ...,
        gimbal_device_id: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        sysid_primary: _t.Int,
        compid_primary: _t.Int,
        sysid_secondary: _t.Int,
        compid_secondary: _t.Int,
        gimbal_device_id: _t.Int,
        /,
    ) -> None: ...

class GimbalManagerConfigureResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class GimbalManagerConfigure(_t.Service[GimbalManagerConfigureRequest, GimbalManagerConfigureResponse]):
    Request: _ty.TypeAlias = GimbalManagerConfigureRequest
    Response: _ty.TypeAlias = GimbalManagerConfigureResponse

class GimbalManagerPitchyawRequest(_t.Message):
    GIMBAL_MANAGER_FLAGS_RETRACT: _ty.Final = 1
    GIMBAL_MANAGER_FLAGS_NEUTRAL: _ty.Final = 2
    GIMBAL_MANAGER_FLAGS_ROLL_LOCK: _ty.Final = 4
    GIMBAL_MANAGER_FLAGS_PITCH_LOCK: _ty.Final = 8
    GIMBAL_MANAGER_FLAGS_YAW_LOCK: _ty.Final = 16
    pitch: _b.float
    yaw: _b.float
    pitch_rate: _b.float
    yaw_rate: _b.float
    flags: _b.int
    gimbal_device_id: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        pitch: _t.Float = ...,
        yaw: _t.Float = ...,
        pitch_rate: _t.Float = ...,
        yaw_rate: _t.Float = ...,
        flags: _t.Int = ...,
        gimbal_device_id: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        pitch: _t.Float,
        yaw: _t.Float,
        pitch_rate: _t.Float,
        yaw_rate: _t.Float,
        flags: _t.Int,
        gimbal_device_id: _t.Int,
        /,
    ) -> None: ...

class GimbalManagerPitchyawResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class GimbalManagerPitchyaw(_t.Service[GimbalManagerPitchyawRequest, GimbalManagerPitchyawResponse]):
    Request: _ty.TypeAlias = GimbalManagerPitchyawRequest
    Response: _ty.TypeAlias = GimbalManagerPitchyawResponse

class GimbalManagerSetRoiRequest(_t.Message):
    ROI_MODE_LOCATION: _ty.Final = 0
    ROI_MODE_WP_NEXT_OFFSET: _ty.Final = 1
    ROI_MODE_SYSID: _ty.Final = 2
    ROI_MODE_NONE: _ty.Final = 3
    mode: _b.int
    gimbal_device_id: _b.int
    latitude: _b.float
    longitude: _b.float
    altitude: _b.float
    pitch_offset: _b.float
    roll_offset: _b.float
    yaw_offset: _b.float
    sysid: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        mode: _t.Int = ...,
        gimbal_device_id: _t.Int = ...,
        latitude: _t.Float = ...,
        longitude: _t.Float = ...,
        altitude: _t.Float = ...,
        pitch_offset: _t.Float = ...,
        roll_offset: _t.Float = ...,
        yaw_offset: _t.Float = ...,
        sysid: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        mode: _t.Int,
        gimbal_device_id: _t.Int,
        latitude: _t.Float,
        longitude: _t.Float,
        altitude: _t.Float,
        pitch_offset: _t.Float,
        roll_offset: _t.Float,
        yaw_offset: _t.Float,
        sysid: _t.Int,
        /,
    ) -> None: ...

class GimbalManagerSetRoiResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class GimbalManagerSetRoi(_t.Service[GimbalManagerSetRoiRequest, GimbalManagerSetRoiResponse]):
    Request: _ty.TypeAlias = GimbalManagerSetRoiRequest
    Response: _ty.TypeAlias = GimbalManagerSetRoiResponse

class LogRequestDataRequest(_t.Message):
    id: _b.int
    offset: _b.int
    count: _b.int
    @_ty.overload
    def __init__(self, *, id: _t.Int = ..., offset: _t.Int = ..., count: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, id: _t.Int, offset: _t.Int, count: _t.Int, /) -> None: ...

class LogRequestDataResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class LogRequestData(_t.Service[LogRequestDataRequest, LogRequestDataResponse]):
    Request: _ty.TypeAlias = LogRequestDataRequest
    Response: _ty.TypeAlias = LogRequestDataResponse

class LogRequestEndRequest(_t.Message):
    def __init__(self) -> None: ...

class LogRequestEndResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class LogRequestEnd(_t.Service[LogRequestEndRequest, LogRequestEndResponse]):
    Request: _ty.TypeAlias = LogRequestEndRequest
    Response: _ty.TypeAlias = LogRequestEndResponse

class LogRequestListRequest(_t.Message):
    start: _b.int
    end: _b.int
    @_ty.overload
    def __init__(self, *, start: _t.Int = ..., end: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, start: _t.Int, end: _t.Int, /) -> None: ...

class LogRequestListResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class LogRequestList(_t.Service[LogRequestListRequest, LogRequestListResponse]):
    Request: _ty.TypeAlias = LogRequestListRequest
    Response: _ty.TypeAlias = LogRequestListResponse

class MessageIntervalRequest(_t.Message):
    message_id: _b.int
    message_rate: _b.float
    @_ty.overload
    def __init__(self, *, message_id: _t.Int = ..., message_rate: _t.Float = ...) -> None: ...
    @_ty.overload
    def __init__(self, message_id: _t.Int, message_rate: _t.Float, /) -> None: ...

class MessageIntervalResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class MessageInterval(_t.Service[MessageIntervalRequest, MessageIntervalResponse]):
    Request: _ty.TypeAlias = MessageIntervalRequest
    Response: _ty.TypeAlias = MessageIntervalResponse

class MountConfigureRequest(_t.Message):
    MODE_RETRACT: _ty.Final = 0
    MODE_NEUTRAL: _ty.Final = 1
    MODE_MAVLINK_TARGETING: _ty.Final = 2
    MODE_RC_TARGETING: _ty.Final = 3
    MODE_GPS_POINT: _ty.Final = 4
    INPUT_ANGLE_BODY_FRAME: _ty.Final = 0
    INPUT_ANGULAR_RATE: _ty.Final = 1
    INPUT_ANGLE_ABSOLUTE_FRAME: _ty.Final = 2
    header: _msg_std_msgs.Header
    mode: _b.int
    stabilize_roll: _b.bool
    stabilize_pitch: _b.bool
    stabilize_yaw: _b.bool
    roll_input: _b.int
    pitch_input: _b.int
    yaw_input: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        mode: _t.Int = ...,
        stabilize_roll: _t.Bool = ...,
        stabilize_pitch: _t.Bool = ...,
        stabilize_yaw: _t.Bool = ...,
        roll_input: _t.Int = ...,
        pitch_input: _t.Int = ...,
        yaw_input: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        mode: _t.Int,
        stabilize_roll: _t.Bool,
        stabilize_pitch: _t.Bool,
        stabilize_yaw: _t.Bool,
        roll_input: _t.Int,
        pitch_input: _t.Int,
        yaw_input: _t.Int,
        /,
    ) -> None: ...

class MountConfigureResponse(_t.Message):
    success: _b.bool
    result: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., result: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, result: _t.Int, /) -> None: ...

class MountConfigure(_t.Service[MountConfigureRequest, MountConfigureResponse]):
    Request: _ty.TypeAlias = MountConfigureRequest
    Response: _ty.TypeAlias = MountConfigureResponse

class ParamGetRequest(_t.Message):
    param_id: _b.str
    @_ty.overload
    def __init__(self, *, param_id: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, param_id: _t.Text, /) -> None: ...

class ParamGetResponse(_t.Message):
    success: _b.bool
    value: _msg_mavros_msgs.ParamValue
    @_ty.overload
    def __init__(
        self,
        *,
        success: _t.Bool = ...,
        value: _msg_mavros_msgs.ParamValue = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, value: _msg_mavros_msgs.ParamValue, /) -> None: ...

class ParamGet(_t.Service[ParamGetRequest, ParamGetResponse]):
    Request: _ty.TypeAlias = ParamGetRequest
    Response: _ty.TypeAlias = ParamGetResponse

class ParamPullRequest(_t.Message):
    force_pull: _b.bool
    @_ty.overload
    def __init__(self, *, force_pull: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, force_pull: _t.Bool, /) -> None: ...

class ParamPullResponse(_t.Message):
    success: _b.bool
    param_received: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., param_received: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, param_received: _t.Int, /) -> None: ...

class ParamPull(_t.Service[ParamPullRequest, ParamPullResponse]):
    Request: _ty.TypeAlias = ParamPullRequest
    Response: _ty.TypeAlias = ParamPullResponse

class ParamPushRequest(_t.Message):
    def __init__(self) -> None: ...

class ParamPushResponse(_t.Message):
    success: _b.bool
    param_transfered: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., param_transfered: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, param_transfered: _t.Int, /) -> None: ...

class ParamPush(_t.Service[ParamPushRequest, ParamPushResponse]):
    Request: _ty.TypeAlias = ParamPushRequest
    Response: _ty.TypeAlias = ParamPushResponse

class ParamSetRequest(_t.Message):
    param_id: _b.str
    value: _msg_mavros_msgs.ParamValue
    @_ty.overload
    def __init__(
        self,
        *,
        param_id: _t.Text = ...,
        value: _msg_mavros_msgs.ParamValue = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, param_id: _t.Text, value: _msg_mavros_msgs.ParamValue, /) -> None: ...

class ParamSetResponse(_t.Message):
    success: _b.bool
    value: _msg_mavros_msgs.ParamValue
    @_ty.overload
    def __init__(
        self,
        *,
        success: _t.Bool = ...,
        value: _msg_mavros_msgs.ParamValue = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, value: _msg_mavros_msgs.ParamValue, /) -> None: ...

class ParamSet(_t.Service[ParamSetRequest, ParamSetResponse]):
    Request: _ty.TypeAlias = ParamSetRequest
    Response: _ty.TypeAlias = ParamSetResponse

class SetMavFrameRequest(_t.Message):
    FRAME_GLOBAL: _ty.Final = 0
    FRAME_LOCAL_NED: _ty.Final = 1
    FRAME_MISSION: _ty.Final = 2
    FRAME_GLOBAL_RELATIVE_ALT: _ty.Final = 3
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
    mav_frame: _b.int
    @_ty.overload
    def __init__(self, *, mav_frame: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, mav_frame: _t.Int, /) -> None: ...

class SetMavFrameResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class SetMavFrame(_t.Service[SetMavFrameRequest, SetMavFrameResponse]):
    Request: _ty.TypeAlias = SetMavFrameRequest
    Response: _ty.TypeAlias = SetMavFrameResponse

class SetModeRequest(_t.Message):
    MAV_MODE_PREFLIGHT: _ty.Final = 0
    MAV_MODE_STABILIZE_DISARMED: _ty.Final = 80
    MAV_MODE_STABILIZE_ARMED: _ty.Final = 208
    MAV_MODE_MANUAL_DISARMED: _ty.Final = 64
    MAV_MODE_MANUAL_ARMED: _ty.Final = 192
    MAV_MODE_GUIDED_DISARMED: _ty.Final = 88
    MAV_MODE_GUIDED_ARMED: _ty.Final = 216
    MAV_MODE_AUTO_DISARMED: _ty.Final = 92
    MAV_MODE_AUTO_ARMED: _ty.Final = 220
    MAV_MODE_TEST_DISARMED: _ty.Final = 66
    MAV_MODE_TEST_ARMED: _ty.Final = 194
    base_mode: _b.int
    custom_mode: _b.str
    @_ty.overload
    def __init__(self, *, base_mode: _t.Int = ..., custom_mode: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, base_mode: _t.Int, custom_mode: _t.Text, /) -> None: ...

class SetModeResponse(_t.Message):
    mode_sent: _b.bool
    @_ty.overload
    def __init__(self, *, mode_sent: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, mode_sent: _t.Bool, /) -> None: ...

class SetMode(_t.Service[SetModeRequest, SetModeResponse]):
    Request: _ty.TypeAlias = SetModeRequest
    Response: _ty.TypeAlias = SetModeResponse

class StreamRateRequest(_t.Message):
    STREAM_ALL: _ty.Final = 0
    STREAM_RAW_SENSORS: _ty.Final = 1
    STREAM_EXTENDED_STATUS: _ty.Final = 2
    STREAM_RC_CHANNELS: _ty.Final = 3
    STREAM_RAW_CONTROLLER: _ty.Final = 4
    STREAM_POSITION: _ty.Final = 6
    STREAM_EXTRA1: _ty.Final = 10
    STREAM_EXTRA2: _ty.Final = 11
    STREAM_EXTRA3: _ty.Final = 12
    stream_id: _b.int
    message_rate: _b.int
    on_off: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        stream_id: _t.Int = ...,
        message_rate: _t.Int = ...,
        on_off: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, stream_id: _t.Int, message_rate: _t.Int, on_off: _t.Bool, /) -> None: ...

class StreamRateResponse(_t.Message):
    def __init__(self) -> None: ...

class StreamRate(_t.Service[StreamRateRequest, StreamRateResponse]):
    Request: _ty.TypeAlias = StreamRateRequest
    Response: _ty.TypeAlias = StreamRateResponse

class VehicleInfoGetRequest(_t.Message):
    GET_MY_SYSID: _ty.Final = 0
    GET_MY_COMPID: _ty.Final = 0
    sysid: _b.int
    compid: _b.int
    get_all: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        sysid: _t.Int = ...,
        compid: _t.Int = ...,
        get_all: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(self, sysid: _t.Int, compid: _t.Int, get_all: _t.Bool, /) -> None: ...

class VehicleInfoGetResponse(_t.Message):
    success: _b.bool
    vehicles: _t.ItemList[_msg_mavros_msgs.VehicleInfo]
    @_ty.overload
    def __init__(
        self,
        *,
        success: _t.Bool = ...,
        vehicles: _t.Items[_msg_mavros_msgs.VehicleInfo] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        success: _t.Bool,
        vehicles: _t.Items[_msg_mavros_msgs.VehicleInfo],
        /,
    ) -> None: ...

class VehicleInfoGet(_t.Service[VehicleInfoGetRequest, VehicleInfoGetResponse]):
    Request: _ty.TypeAlias = VehicleInfoGetRequest
    Response: _ty.TypeAlias = VehicleInfoGetResponse

class WaypointClearRequest(_t.Message):
    def __init__(self) -> None: ...

class WaypointClearResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class WaypointClear(_t.Service[WaypointClearRequest, WaypointClearResponse]):
    Request: _ty.TypeAlias = WaypointClearRequest
    Response: _ty.TypeAlias = WaypointClearResponse

class WaypointPullRequest(_t.Message):
    def __init__(self) -> None: ...

class WaypointPullResponse(_t.Message):
    success: _b.bool
    wp_received: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., wp_received: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, wp_received: _t.Int, /) -> None: ...

class WaypointPull(_t.Service[WaypointPullRequest, WaypointPullResponse]):
    Request: _ty.TypeAlias = WaypointPullRequest
    Response: _ty.TypeAlias = WaypointPullResponse

class WaypointPushRequest(_t.Message):
    start_index: _b.int
    waypoints: _t.ItemList[_msg_mavros_msgs.Waypoint]
    @_ty.overload
    def __init__(
        self,
        *,
        start_index: _t.Int = ...,
        waypoints: _t.Items[_msg_mavros_msgs.Waypoint] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        start_index: _t.Int,
        waypoints: _t.Items[_msg_mavros_msgs.Waypoint],
        /,
    ) -> None: ...

class WaypointPushResponse(_t.Message):
    success: _b.bool
    wp_transfered: _b.int
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ..., wp_transfered: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, wp_transfered: _t.Int, /) -> None: ...

class WaypointPush(_t.Service[WaypointPushRequest, WaypointPushResponse]):
    Request: _ty.TypeAlias = WaypointPushRequest
    Response: _ty.TypeAlias = WaypointPushResponse

class WaypointSetCurrentRequest(_t.Message):
    wp_seq: _b.int
    @_ty.overload
    def __init__(self, *, wp_seq: _t.Int = ...) -> None: ...
    @_ty.overload
    def __init__(self, wp_seq: _t.Int, /) -> None: ...

class WaypointSetCurrentResponse(_t.Message):
    success: _b.bool
    @_ty.overload
    def __init__(self, *, success: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, success: _t.Bool, /) -> None: ...

class WaypointSetCurrent(_t.Service[WaypointSetCurrentRequest, WaypointSetCurrentResponse]):
    Request: _ty.TypeAlias = WaypointSetCurrentRequest
    Response: _ty.TypeAlias = WaypointSetCurrentResponse
