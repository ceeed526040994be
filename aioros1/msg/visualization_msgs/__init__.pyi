# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.geometry_msgs as _msg_geometry_msgs
import aioros1.msg.std_msgs as _msg_std_msgs
import aioros1.msg.visualization_msgs as _msg_visualization_msgs

class ImageMarker(_t.Message):
    CIRCLE: _ty.Final = 0
    LINE_STRIP: _ty.Final = 1
    LINE_LIST: _ty.Final = 2
    POLYGON: _ty.Final = 3
    POINTS: _ty.Final = 4
    ADD: _ty.Final = 0
    REMOVE: _ty.Final = 1
    header: _msg_std_msgs.Header
    ns: _b.str
    id: _b.int
    type: _b.int
    action: _b.int
    position: _msg_geometry_msgs.Point
    scale: _b.float
    outline_color: _msg_std_msgs.ColorRGBA
    filled: _b.int
    fill_color: _msg_std_msgs.ColorRGBA
    lifetime: _t.Duration
    points: _t.ItemList[_msg_geometry_msgs.Point]
    outline_colors: _t.ItemList[_msg_std_msgs.ColorRGBA]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        ns: _t.Text = ...,
        id: _t.Int = ...,
        type: _t.Int = ...,
        action: _t.Int = ...,
        position: _msg_geometry_msgs.Point = ...,
        scale: _t.Float = ...,
        outline_color: _msg_std_msgs.ColorRGBA = ...,
        filled: _t.Int = ...,
        fill_color: _msg_std_msgs.ColorRGBA = ...,
        lifetime: _t.Duration = ...,
        points: _t.Items[_msg_geometry_msgs.Point] = ...,
        outline_colors: _t.Items[_msg_std_msgs.ColorRGBA] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        ns: _t.Text,
        id: _t.Int,
        type: _t.Int,
        action: _t.Int,
        position: _msg_geometry_msgs.Point,
        scale: _t.Float,
        outline_color: _msg_std_msgs.ColorRGBA,
        filled: _t.Int,
        fill_color: _msg_std_msgs.ColorRGBA,
        lifetime: _t.Duration,
        points: _t.Items[_msg_geometry_msgs.Point],
        outline_colors: _t.Items[_msg_std_msgs.ColorRGBA],
        /,
    ) -> None: ...

class InteractiveMarker(_t.Message):
    header: _msg_std_msgs.Header
    pose: _msg_geometry_msgs.Pose
    name: _b.str
    description: _b.str
    scale: _b.float
    menu_entries: _t.ItemList[_msg_visualization_msgs.MenuEntry]
    controls: _t.ItemList[_msg_visualization_msgs.InteractiveMarkerControl]
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        pose: _msg_geometry_msgs.Pose = ...,
        name: _t.Text = ...,
        description: _t.Text = ...,
        scale: _t.Float = ...,
        menu_entries: _t.Items[_msg_visualization_msgs.MenuEntry] = ...,
        controls: _t.Items[_msg_visualization_msgs.InteractiveMarkerControl] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        pose: _msg_geometry_msgs.Pose,
        name: _t.Text,
        description: _t.Text,
        scale: _t.Float,
        menu_entries: _t.Items[_msg_visualization_msgs.MenuEntry],
        controls: _t.Items[_msg_visualization_msgs.InteractiveMarkerControl],
        /,
    ) -> None: ...

class InteractiveMarkerControl(_t.Message):
    INHERIT: _ty.Final = 0
    FIXED: _ty.Final = 1
    VIEW_FACING: _ty.Final = 2
    NONE: _ty.Final = 0
    MENU: _ty.Final = 1
    BUTTON: _ty.Final = 2
    MOVE_AXIS: _ty.Final = 3
    MOVE_PLANE: _ty.Final = 4
    ROTATE_AXIS: _ty.Final = 5
    MOVE_ROTATE: _ty.Final = 6
    MOVE_3D: _ty.Final = 7
    ROTATE_3D: _ty.Final = 8
    MOVE_ROTATE_3D: _ty.Final = 9
    name: _b.str
    orientation: _msg_geometry_msgs.Quaternion
    orientation_mode: _b.int
    interaction_mode: _b.int
    always_visible: _b.bool
    markers: _t.ItemList[_msg_visualization_msgs.Marker]
    independent_marker_orientation: _b.bool
    description: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        name: _t.Text = ...,
        orientation: _msg_geometry_msgs.Quaternion = ...,
        orientation_mode: _t.Int = ...,
        interaction_mode: _t.Int = ...,
        always_visible: _t.Bool = ...,
        markers: _t.Items[_msg_visualization_msgs.Marker] = ...,
        independent_marker_orientation: _t.Bool = ...,
        description: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        name: _t.Text,
        orientation: _msg_geometry_msgs.Quaternion,
        orientation_mode: _t.Int,
        interaction_mode: _t.Int,
        always_visible: _t.Bool,
        markers: _t.Items[_msg_visualization_msgs.Marker],
        independent_marker_orientation: _t.Bool,
        description: _t.Text,
        /,
    ) -> None: ...

class InteractiveMarkerFeedback(_t.Message):
    KEEP_ALIVE: _ty.Final = 0
    POSE_UPDATE: _ty.Final = 1
    MENU_SELECT: _ty.Final = 2
    BUTTON_CLICK: _ty.Final = 3
    MOUSE_DOWN: _ty.Final = 4
    MOUSE_UP: _ty.Final = 5
    header: _msg_std_msgs.Header
    client_id: _b.str
    marker_name: _b.str
    control_name: _b.str
    event_type: _b.int
    pose: _msg_geometry_msgs.Pose
    menu_entry_id: _b.int
    mouse_point: _msg_geometry_msgs.Point
    mouse_point_valid: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        client_id: _t.Text = ...,
        marker_name: _t.Text = ...,
        control_name: _t.Text = ...,
        event_type: _t.Int = ...,
        pose: _msg_geometry_msgs.Pose = ...,
        menu_entry_id: _t.Int = ...,
        mouse_point: _msg_geometry_msgs.Point = ...,
        mouse_point_valid: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        client_id: _t.Text,
        marker_name: _t.Text,
        control_name: _t.Text,
        event_type: _t.Int,
        pose: _msg_geometry_msgs.Pose,
        menu_entry_id: _t.Int,
        mouse_point: _msg_geometry_msgs.Point,
        mouse_point_valid: _t.Bool,
        /,
    ) -> None: ...

class InteractiveMarkerInit(_t.Message):
    server_id: _b.str
    seq_num: _b.int
    markers: _t.ItemList[_msg_visualization_msgs.InteractiveMarker]
    @_ty.overload
    def __init__(
        self,
        *,
        server_id: _t.Text = ...,
        seq_num: _t.Int = ...,
        markers: _t.Items[_msg_visualization_msgs.InteractiveMarker] = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        server_id: _t.Text,
        seq_num: _t.Int,
        markers: _t.Items[_msg_visualization_msgs.InteractiveMarker],
        /,
    ) -> None: ...

class InteractiveMarkerPose(_t.Message):
    header: _msg_std_msgs.Header
    pose: _msg_geometry_msgs.Pose
    name: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        pose: _msg_geometry_msgs.Pose = ...,
        name: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        pose: _msg_geometry_msgs.Pose,
        name: _t.Text,
        /,
    ) -> None: ...

class InteractiveMarkerUpdate(_t.Message):
    KEEP_ALIVE: _ty.Final = 0
    UPDATE: _ty.Final = 1
    server_id: _b.str
    seq_num: _b.int
    type: _b.int
    markers: _t.ItemList[_msg_visualization_msgs.InteractiveMarker]
    poses: _t.ItemList[_msg_visualization_msgs.InteractiveMarkerPose]
    erases: _t.TextList
    @_ty.overload
    def __init__(
        self,
        *,
        server_id: _t.Text = ...,
        seq_num: _t.Int = ...,
        type: _t.Int = ...,
        markers: _t.Items[_msg_visualization_msgs.InteractiveMarker] = ...,
        poses: _t.Items[_msg_visualization_msgs.InteractiveMarkerPose] = ...,
        erases: _t.Texts = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        server_id: _t.Text,
        seq_num: _t.Int,
        type: _t.Int,
        markers: _t.Items[_msg_visualization_msgs.InteractiveMarker],
        poses: _t.Items[_msg_visualization_msgs.InteractiveMarkerPose],
        erases: _t.Texts,
        /,
    ) -> None: ...

class Marker(_t.Message):
    ARROW: _ty.Final = 0
    CUBE: _ty.Final = 1
    SPHERE: _ty.Final = 2
    CYLINDER: _ty.Final = 3
    LINE_STRIP: _ty.Final = 4
    LINE_LIST: _ty.Final = 5
    CUBE_LIST: _ty.Final = 6
    SPHERE_LIST: _ty.Final = 7
    POINTS: _ty.Final = 8
    TEXT_VIEW_FACING: _ty.Final = 9
    MESH_RESOURCE: _ty.Final = 10
    TRIANGLE_LIST: _ty.Final = 11
    ADD: _ty.Final = 0
    MODIFY: _ty.Final = 0
    DELETE: _ty.Final = 2
    DELETEALL: _ty.Final = 3
    header: _msg_std_msgs.Header
    ns: _b.str
    id: _b.int
    type: _b.int
    action: _b.int
    pose: _msg_geometry_msgs.Pose
    scale: _msg_geometry_msgs.Vector3
    color: _msg_std_msgs.ColorRGBA
    lifetime: _t.Duration
    frame_locked: _b.bool
    points: _t.ItemList[_msg_geometry_msgs.Point]
    colors: _t.ItemList[_msg_std_msgs.ColorRGBA]
    text: _b.str
    mesh_resource: _b.str
    mesh_use_embedded_materials: _b.bool
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        ns: _t.Text = ...,
        id: _t.Int = ...,
        type: _t.Int = ...,
        action: _t.Int = ...,
        pose: _msg_geometry_msgs.Pose = ...,
        scale: _msg_geometry_msgs.Vector3 = ...,
        color: _msg_std_msgs.ColorRGBA = ...,
        lifetime: _t.Duration = ...,
        frame_locked: _t.Bool = ...,
        points: _t.Items[_msg_geometry_msgs.Point] = ...,
        colors: _t.Items[_msg_std_msgs.ColorRGBA] = ...,
        text: _t.Text = ...,
        mesh_resource: _t.Text = ...,
        mesh_use_embedded_materials: _t.Bool = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        ns: _t.Text,
        id: _t.Int,
        type: _t.Int,
        action: _t.Int,
        pose: _msg_geometry_msgs.Pose,
        scale: _msg_geometry_msgs.Vector3,
        color: _msg_std_msgs.ColorRGBA,
        lifetime: _t.Duration,
        frame_locked: _t.Bool,
        points: _t.Items[_msg_geometry_msgs.Point],
        colors: _t.Items[_msg_std_msgs.ColorRGBA],
        text: _t.Text,
        mesh_resource: _t.Text,
        mesh_use_embedded_materials: _t.Bool,
        /,
    ) -> None: ...

class MarkerArray(_t.Message):
    markers: _t.ItemList[_msg_visualization_msgs.Marker]
    @_ty.overload
    def __init__(self, *, markers: _t.Items[_msg_visualization_msgs.Marker] = ...) -> None: ...
    @_ty.overload
    def __init__(self, markers: _t.Items[_msg_visualization_msgs.Marker], /) -> None: ...

class MenuEntry(_t.Message):
    FEEDBACK: _ty.Final = 0
    ROSRUN: _ty.Final = 1
    ROSLAUNCH: _ty.Final = 2
    id: _b.int
    parent_id: _b.int
    title: _b.str
    command: _b.str
    command_type: _b.int
    @_ty.overload
    def __init__(
        self,
        *,
        id: _t.Int = ...,
        parent_id: _t.Int = ...,
        title: _t.Text = ...,
        command: _t.Text = ...,
        command_type: _t.Int = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        id: _t.Int,
        parent_id: _t.Int,
        title: _t.Text,
        command: _t.Text,
        command_type: _t.Int,
        /,
    ) -> None: ...
