"""Our classes beside genpy's, in one process of Debian's Python: one check a run, by its name.

The library itself needs aiohttp, which Debian's Python may lack, but messages do not.
"""

import contextlib
import importlib
import io
import json
import sys

import genpy
import genpy.message
import rosbag
import rospy.msg
import rostopic
from genpy_types import class_of, modules, octets
from neutral import build, random_message, show

import aioros1
from aioros1.idl import Message, MessageStore, convert, to_dict

SEEDS = ("low", "high", "odd 1", "odd 2", "random 1", "random 2")


def packages():
    """The packages that are named on the command line and that have classes here."""
    return [name for name in sys.argv[2:] if importlib.util.find_spec(name) is not None]


def classes():
    for package in packages():
        for module in modules(package):
            for cls in vars(module).values():
                if isinstance(cls, type) and issubclass(cls, genpy.Message):
                    yield cls


def random_pairs(seeds=SEEDS):
    """genpy's and our class, genpy's message, and whether that equals itself."""
    store = MessageStore()
    for theirs in classes():
        ours = store.resolve_msg(theirs)
        for seed in seeds:
            neutral = random_message(class_of, theirs._type, seed)
            message = build(class_of, theirs._type, neutral)
            yield theirs, ours, message, "nan " not in json.dumps(neutral)


def check_classes():
    """A class of theirs is taken for ours of the same definition."""
    count = 0
    for theirs in classes():
        ours = MessageStore(parent=None).resolve_msg(theirs)
        assert issubclass(ours, Message)
        assert (ours._type, ours._md5sum) == (theirs._type, theirs._md5sum)
        if theirs.__module__.split(".")[1] == "msg":
            assert MessageStore().resolve_msg(theirs) is aioros1.load_msg(theirs._type)
        assert str(ours()) == str(theirs()), theirs
        count += 1
    assert count > 100, count
    for package in packages():
        for module in modules(package):
            for theirs in vars(module).values():
                if hasattr(theirs, "_request_class"):
                    for store in (MessageStore(), MessageStore(parent=None)):
                        ours = store.resolve_srv(theirs)
                        assert (ours._type, ours._md5sum) == (theirs._type, theirs._md5sum)


def check_their_messages():
    """Their messages are encoded as they are, alone and as the fields of ours."""
    for theirs, ours, message, comparable in random_pairs():
        wire = octets(message)
        assert convert(ours, message) is message
        assert ours._encode(message) == ours._frame(message)[4:] == wire, theirs
        values = [getattr(message, name) for name in theirs.__slots__]
        assert ours(*values).to_bytes() == wire, theirs
        assert ours.from_dict(as_dict(message)).to_bytes() == wire, theirs
        text = json.dumps(to_dict(message, json=True), allow_nan=False)
        assert ours.from_dict(json.loads(text)).to_bytes() == wire, theirs
        if comparable:
            assert ours.from_bytes(wire) == message, theirs
            assert ours(*values) == message, theirs


def as_dict(message):
    """Fields by name, nested messages and times of theirs left as they are."""
    return {name: getattr(message, name) for name in message.__slots__}


def check_our_messages():
    """genpy encodes messages of theirs that have our values as fields, our times included."""
    for theirs, ours, message, comparable in random_pairs():
        wire = octets(message)
        values = ours.from_bytes(wire)
        assert octets(theirs(*as_dict(values).values())) == wire, theirs
        buffer = io.BytesIO()
        values.serialize(buffer)
        assert buffer.getvalue() == wire
        again = ours().deserialize(wire)
        assert show(again) == show(values)
        if comparable:
            assert again == values


def check_texts():
    """What is printed is what genpy prints, for all but the oddest strings in lists."""
    for theirs, ours, message, _ in random_pairs([f"odd {n}" for n in range(8)]):
        wire = octets(message)
        one, other = str(ours.from_bytes(wire)), str(theirs().deserialize(wire))
        assert one == other, f"{theirs}\n{one}\n{other}"


def check_rosbag():
    """The Python API of rosbag writes our messages, and what it reads equals them."""
    pose = aioros1.load_msg("geometry_msgs/PoseStamped")()
    pose.header.stamp = aioros1.Time(5, 6)
    pose.pose.position.x = 1.5
    image = aioros1.load_msg("sensor_msgs/Image")(height=1, width=3, step=3, data=b"abc")
    scan = aioros1.load_msg("sensor_msgs/LaserScan")(ranges=[1.0, 2.5])
    written = [("/pose", pose), ("/image", image), ("/scan", scan), ("/pose", pose)]
    with rosbag.Bag("ours.bag", "w") as bag:
        for number, (topic, message) in enumerate(written):
            bag.write(topic, message, aioros1.Time(number + 1))
    with rosbag.Bag("ours.bag") as bag:
        info = bag.get_type_and_topic_info().topics
        read = [(topic, message, stamp) for topic, message, stamp in bag.read_messages()]
        raw = [data for _, (_, data, *_), _ in bag.read_messages(raw=True)]
    for topic, message in written:
        assert info[topic].msg_type == message._type
    assert info["/pose"].message_count == 2
    assert len(read) == len(written)
    for number, ((topic, message), (their_topic, theirs, stamp)) in enumerate(
        zip(written, read, strict=True)
    ):
        assert topic == their_topic
        assert message == theirs
        assert isinstance(theirs, genpy.Message)
        assert stamp == genpy.Time(number + 1)
    assert raw == [message.to_bytes() for _, message in written]


def check_printing():
    """strify_message, which all tools print with, and rostopic's own way of printing."""
    ours = aioros1.load_msg("geometry_msgs/PoseStamped")()
    ours.header.stamp = aioros1.Time(5, 6)
    ours.header.frame_id = "map"
    theirs = class_of(ours._type)().deserialize(ours.to_bytes())
    assert genpy.message.strify_message(ours) == genpy.message.strify_message(theirs)
    shown = []
    for message in (ours, theirs):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            rostopic.CallbackEcho("/pose", None).callback(message, {"topic": "/pose"})
        shown.append(out.getvalue())
    assert shown[0] == shown[1]
    assert 'frame_id: "map"' in shown[0]


def check_publishing():
    """What rospy.Publisher does with a message, and what a subscriber makes of it."""
    ours = aioros1.load_msg("geometry_msgs/PoseStamped")()
    ours.pose.position.x = 1.5
    theirs = class_of(ours._type)
    assert rospy.msg.args_kwds_to_message(theirs, (ours,), {}) is ours
    buffer = io.BytesIO()
    rospy.msg.serialize_message(buffer, 7, ours)
    assert ours.header.seq == 7
    body = ours.to_bytes()
    assert buffer.getvalue() == len(body).to_bytes(4, "little") + body
    for cls in (theirs, type(ours)):
        queue = []
        stream = io.BytesIO(buffer.getvalue())
        stream.seek(0, io.SEEK_END)
        rospy.msg.deserialize_messages(stream, queue, cls)
        (received,) = queue
        assert type(received) is cls
        assert ours == received


def check_filling():
    """What asks for an instance of genpy.Message is given one: of theirs, from our octets."""
    ours = aioros1.load_msg("geometry_msgs/PoseStamped")()
    ours.header.frame_id = "map"
    theirs = class_of(ours._type)().deserialize(ours.to_bytes())
    genpy.message.fill_message_args(theirs, [{"pose": {"position": {"x": 1.5}}}])
    names = "header.seq header.stamp header.frame_id pose.position.x"
    assert genpy.message.get_printable_message_args(theirs).startswith(names)
    back = type(ours).from_bytes(octets(theirs))
    assert (back.header.frame_id, back.pose.position.x) == ("map", 1.5)
    # The plain values that genpy fills messages with are those of from_dict, and to_dict's.
    assert type(ours).from_dict({"pose": {"position": {"x": 1.5}}}).pose == theirs.pose
    genpy.message.fill_message_args(theirs, [ours.to_dict()])
    assert octets(theirs) == ours.to_bytes()


if __name__ == "__main__":
    globals()[f"check_{sys.argv[1]}"]()
    print("done")
