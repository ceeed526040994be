"""The message types that the targets decode and encode: at least one for each code path."""

from __future__ import annotations

from pathlib import Path

from aioros1.idl import Message, MessageStore

__all__ = ["CLASSES", "DEFINITIONS", "store"]

BUNDLE = Path(__file__).parents[1] / "share" / "msg"

# In an order in which each type comes behind those that it needs.
DEFINITIONS = {
    "fz/None": "",
    "fz/Scalars": "bool a\nint8 b\nuint8 c\nint16 d\nuint16 e\nint32 f\nuint32 g\nint64 h\n"
    "uint64 i\nfloat32 j\nfloat64 k\ntime l\nduration m\nchar n\nbyte o",
    "fz/Lists": "bool[] a\nint8[] b\nuint8[] c\nint16[] d\nuint16[] e\nint32[] f\nuint32[] g\n"
    "int64[] h\nuint64[] i\nfloat32[] j\nfloat64[] k\ntime[] l\nduration[] m\nchar[] n\nbyte[] o\n"
    "string[] p",
    "fz/Fixed": "bool[2] a\nint8[3] b\nuint8[4] c\nint16[2] d\nfloat32[2] e\nfloat64[1] f\n"
    "time[2] g\nduration[1] h\nchar[2] i\nstring[0] j\nint32[0] k\nuint64[1] l\nNone[2] m",
    "fz/Texts": "string a\nstring[] b\nstring c\nstring[2] d\nstring e",
    "fz/Keywords": "int8 from\nstring None\ntime class\nstring[] is\nuint8[] in\nfloat64[2] as\n"
    "bool[] or\nbool self\nint16 data\nint32 pos\nint64 end",
    "fz/Words": "Keywords def\nKeywords[] del\nstring for",
    "fz/Pair": "uint16 q\nint32[2] r",
    "fz/Row": "int8 x\nbool p\nPair[2] pairs\ntime[1] t\nNone[2] es\nPair[0] no\nstring[0] nor\n"
    "duration d\nint8 y\nfloat32 from",
    "fz/Rows": "Row[2] a\nRow[] b\nPair[] c\nint8 end\nPair d",
    "fz/Hollow": "None[] a\nNone b\nNone[2] c",
    "fz/Hollows": "Hollow[] a\nHollow[2] b\nNone[] c\nHollow d",
    "fz/Leaf": "string name\nuint8[] raw",
    "fz/Twig": "Leaf[] leaves\nLeaf[2] two\nLeaf one\nint16 n",
    "fz/Tree": "Twig[] twigs\nTwig trunk\nint8 end",
    "fz/Deep": "Tree[] trees\nTree[1] own",
    "fz/Stamped": "Header header\nuint8[] data\nfloat32[] values\nHeader second\nbool last",
    "fz/Tail": "int32 a\nfloat64[] b\nuint16 c\nuint8[] d\nuint8[16] e\nint64[2] f",
    "fz/Times": "time a\nduration[] b\ntime[] c\nTime[] d\nstring e",
    "fz/Time": "time data",
    # Types with a single field, which are often a case of their own.
    "fz/OnlyLeaves": "Leaf[3] leaves",
    "fz/OnlyThose": "OnlyLeaves[] those",
    "fz/OnlyPairs": "Pair[] pairs",
    "fz/OnlyTwins": "Pair[2] twins",
    "fz/OnlyTexts": "string[] texts",
    "fz/OnlyWords": "string[3] words",
    "fz/OnlyOctets": "uint8[] octets",
    "fz/OnlyTruths": "bool[] truths",
    "fz/Clump": "None[20] nothings",
    "fz/Clumps": "Clump[] clumps\nint8 end",
    "fz/ClumpRow": "int8 x\nClump[2] clumps",
    "fz/ClumpRows": "ClumpRow[] rows\nClump clump",
}

BUNDLED = [
    "std_msgs/String",
    "std_msgs/Empty",
    "std_msgs/Float64MultiArray",
    "rosgraph_msgs/Log",
    "rosgraph_msgs/Clock",
    "geometry_msgs/PoseArray",
    "geometry_msgs/PolygonStamped",
    "geometry_msgs/TwistStamped",
    "nav_msgs/Odometry",
    "nav_msgs/Path",
    "nav_msgs/OccupancyGrid",
    "sensor_msgs/LaserScan",
    "sensor_msgs/Image",
    "sensor_msgs/CameraInfo",
    "sensor_msgs/JointState",
    "sensor_msgs/PointCloud2",
    "tf2_msgs/TFMessage",
    "diagnostic_msgs/DiagnosticArray",
    "actionlib_msgs/GoalStatusArray",
    "trajectory_msgs/JointTrajectory",
    "visualization_msgs/Marker",
]


def store() -> MessageStore:
    """A store of the bundled types and those above, whatever ROS there is on the machine."""
    made = MessageStore([BUNDLE], parent=None)
    for type_, text in DEFINITIONS.items():
        made.add_text(type_, text)
    return made


def _classes() -> list[type[Message]]:
    own = store()
    return [own.load_msg(name) for name in [*DEFINITIONS, *BUNDLED]]


CLASSES = _classes()
"""An input's first byte picks one of these: append, so that a corpus keeps its meaning."""
