"""Where definitions come from, and which of several is meant."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import pytest

from aioros1.errors import InvalidNameError, MessageNotFoundError, MessageSpecError
from aioros1.idl import (
    Action,
    Message,
    MessageStore,
    Service,
    default_store,
    load_action,
    load_msg,
    load_srv,
)


def write(root: Path, **files: str) -> Path:
    """Files by their path, with two underscores for a slash and one at the end for a dot."""
    for name, text in files.items():
        path = root / name.replace("__", "/").replace("_DOT_", ".")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return root


class TestFiles:
    def test_a_directory_of_packages(self, tmp_path: Path) -> None:
        write(
            tmp_path, my_msgs__msg__Thing_DOT_msg="int32 x\nPart p", my_msgs__msg__Part_DOT_msg=""
        )
        store = MessageStore([tmp_path])
        assert store.load_msg("my_msgs/Thing")(x=5).to_bytes() == b"\5\0\0\0"
        assert store.find("my_msgs/Thing") == tmp_path / "my_msgs" / "msg" / "Thing.msg"
        assert store.types("my_msgs") == ["my_msgs/Part", "my_msgs/Thing"]
        assert "my_msgs" in store.packages()
        assert "std_msgs" in store.packages()

    @pytest.mark.parametrize(
        ("file", "root"),
        [
            ("my_msgs__Thing_DOT_msg", ""),
            ("my_msgs__msg__Thing_DOT_msg", "my_msgs"),
            ("my_msgs__msg__Thing_DOT_msg", "my_msgs/msg"),
        ],
    )
    def test_other_layouts(self, tmp_path: Path, file: str, root: str) -> None:
        write(tmp_path, **{file: "int32 x"})
        store = MessageStore(tmp_path / root, parent=None)
        assert store.load_msg("my_msgs/Thing")._slot_types == ["int32"]
        assert store.packages() == ["my_msgs"]

    def test_a_file_that_is_not_utf_8(self, tmp_path: Path) -> None:
        """As it may be in a comment of another age; what counts for the sum is as it is."""
        file = tmp_path / "my_msgs" / "msg" / "Thing.msg"
        file.parent.mkdir(parents=True)
        file.write_bytes(b"# 90\xb0\nstring UNIT=\xb0\nint32 x\n")
        cls = MessageStore([tmp_path], parent=None).load_msg("my_msgs/Thing")
        assert cls._md5sum == hashlib.md5(b"string UNIT=\xb0\nint32 x").hexdigest()
        assert cls.UNIT.encode("utf-8", "surrogateescape") == b"\xb0"
        assert cls.from_bytes(cls(x=1).to_bytes()).x == 1

    def test_packages_are_known_by_their_manifest(self, tmp_path: Path) -> None:
        write(
            tmp_path,
            src__repo__folder__package_DOT_xml="<package>\n<name> my_msgs </name></package>",
            src__repo__folder__msg__Thing_DOT_msg="int32 x",
            src__repo__old__manifest_DOT_xml="<package/>",
            src__repo__old__srv__Do_DOT_srv="---\n",
            src__ignored__CATKIN_IGNORE="",
            src__ignored__pkg__package_DOT_xml="<package><name>no_msgs</name></package>",
            src__ignored__pkg__msg__Thing_DOT_msg="",
            _DOT_hidden__package_DOT_xml="<package><name>hidden</name></package>",
            _DOT_hidden__msg__Thing_DOT_msg="",
        )
        (tmp_path / "src" / "loop").symlink_to(tmp_path, target_is_directory=True)
        store = MessageStore([tmp_path], parent=None)
        assert store.packages() == ["my_msgs", "old"]
        assert store.types("old", "srv") == ["old/Do"]
        assert store.load_msg("my_msgs/Thing").__slots__ == ("x",)

    def test_the_first_path_wins(self, tmp_path: Path) -> None:
        for number in (1, 2):
            write(tmp_path / str(number), p__msg__T_DOT_msg=f"int32 x{number}")
        store = MessageStore([tmp_path / "2", tmp_path / "1"])
        assert store.load_msg("p/T").__slots__ == ("x2",)

    def test_ros_package_path(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        for number in (1, 2):
            write(
                tmp_path / str(number),
                **{
                    f"deep__p{number}__package_DOT_xml": f"<name>env{number}_msgs</name>",
                    f"deep__p{number}__msg__T_DOT_msg": "int32 x",
                },
            )
        monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path / '1'}:/no/such/place")
        assert default_store().load_msg("env1_msgs/T").__slots__ == ("x",)
        with pytest.raises(MessageNotFoundError):
            default_store().load_msg("env2_msgs/T")
        monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path / '1'}:{tmp_path / '2'}")
        assert default_store().load_msg("env2_msgs/T").__slots__ == ("x",)

    def test_files_that_are_not_utf8(self, tmp_path: Path) -> None:
        path = tmp_path / "p" / "msg" / "T.msg"
        path.parent.mkdir(parents=True)
        path.write_bytes(b"int32 x # gr\xf6\xdfe\r\n")
        assert MessageStore([tmp_path]).load_msg("p/T").__slots__ == ("x",)

    def test_a_file_that_appears_later(self, tmp_path: Path) -> None:
        store = MessageStore([tmp_path])
        with pytest.raises(MessageNotFoundError):
            store.load_msg("p/T")
        write(tmp_path, p__msg__T_DOT_msg="int32 x")
        assert store.load_msg("p/T").__slots__ == ("x",)


class TestNames:
    @pytest.mark.parametrize(
        "name",
        ["String", "", "a/b/c", "a/", "/a", "a b/c", "a/b[]", "1a/b", "a/b\n", "../a/b", None],
    )
    def test_only_package_and_type(self, name: Any) -> None:
        with pytest.raises(InvalidNameError):
            load_msg(name)

    def test_missing_types_name_who_needs_them(self) -> None:
        store = MessageStore()
        store.add_text("p/Outer", "Middle m")
        store.add_text("p/Middle", "Inner[] i")
        with pytest.raises(
            MessageNotFoundError, match="of p/Inner, needed by p/Outer -> p/Middle; searched: /"
        ):
            store.load_msg("p/Outer")
        with pytest.raises(LookupError, match=r"no definition \(.srv\) of p/Nothing; searched"):
            load_srv("p/Nothing")
        with pytest.raises(MessageNotFoundError):
            load_action("p/Nothing")
        with pytest.raises(MessageNotFoundError):
            store.find("p/Nothing")

    def test_circles(self) -> None:
        store = MessageStore()
        store.add_text("p/A", "B b")
        store.add_text("p/B", "C[] c")
        store.add_text("p/C", "A[2] a")
        with pytest.raises(MessageSpecError, match="contains itself: p/B -> p/C -> p/A -> p/B"):
            store.load_msg("p/B")


class TestTexts:
    def test_the_kind_is_told_by_the_dashes(self) -> None:
        store = MessageStore()
        store.add_text("p/T", "int32 x")
        store.add_text("p/S", "int32 a\n---\nint32 b")
        store.add_text("p/Go", "int32 g\n---\nint32 r\n---\nint32 f")
        assert store.load_msg("p/T").__slots__ == ("x",)
        assert store.load_srv("p/S").Response.__slots__ == ("b",)
        assert store.load_action("p/Go").Feedback.__slots__ == ("f",)
        assert (store.types("p"), store.types("p", "srv"), store.types("p", "action")) == (
            ["p/T"],
            ["p/S"],
            ["p/Go"],
        )

    def test_a_service_may_do_without_dashes(self) -> None:
        store = MessageStore()
        store.add_text("p/S", "int32 a", kind="srv")
        assert store.load_srv("p/S").Response.__slots__ == ()

    def test_a_text_stands_in_for_a_file(self) -> None:
        store = MessageStore()
        store.add_text("std_msgs/String", "string text")
        assert store.load_msg("std_msgs/String").__slots__ == ("text",)
        assert load_msg("std_msgs/String").__slots__ == ("data",)

    def test_a_text_can_be_replaced(self) -> None:
        store = MessageStore()
        store.add_text("p/In", "int32 x")
        store.add_text("p/Out", "In i")
        before = store.load_msg("p/Out")
        store.add_text("p/In", "int64 x")
        after = store.load_msg("p/Out")
        assert (before._min_size, after._min_size) == (4, 8)
        assert before._md5sum != after._md5sum

    def test_bad_texts_are_refused_at_once(self) -> None:
        with pytest.raises(MessageSpecError, match="p/T:1"):
            MessageStore().add_text("p/T", "int32")
        with pytest.raises(MessageSpecError, match="three sections"):
            MessageStore().add_text("p/T", "---", kind="action")


class TestParents:
    def test_classes_are_shared_with_the_parent(self) -> None:
        assert MessageStore().load_msg("std_msgs/String") is load_msg("std_msgs/String")
        assert MessageStore().load_srv("std_srvs/Empty") is load_srv("std_srvs/Empty")

    def test_without_a_parent_there_is_nothing_else(self) -> None:
        store = MessageStore(parent=None)
        with pytest.raises(MessageNotFoundError, match="searched: no directory"):
            store.load_msg("std_msgs/String")
        for load in (store.load_srv, store.load_action):
            with pytest.raises(MessageNotFoundError):
                load("p/T")
        assert (store.packages(), store.types("std_msgs")) == ([], [])

    def test_types_of_the_parent_take_definitions_of_the_child(self) -> None:
        store = MessageStore()
        store.add_text("geometry_msgs/Point", "float32 x")
        pose = store.load_msg("geometry_msgs/Pose")
        assert pose._nested["geometry_msgs/Point"].__slots__ == ("x",)
        assert pose is not load_msg("geometry_msgs/Pose")
        assert store.load_msg("geometry_msgs/Twist") is load_msg("geometry_msgs/Twist")
        store.add_text("std_msgs/Header", "int32 x")
        srv = store.load_srv("sensor_msgs/SetCameraInfo")
        assert srv._md5sum != load_srv("sensor_msgs/SetCameraInfo")._md5sum


OTHER_HEADER = """Header header
int32 x
================================================================================
MSG: std_msgs/Header
string other
"""


class TestDefinitions:
    def test_the_class_of_the_store_where_it_is_the_same(self) -> None:
        known = load_msg("sensor_msgs/LaserScan")
        assert MessageStore().add_definition(known._type, known._full_text) is known

    def test_what_is_inside_comes_from_the_same_text(self) -> None:
        store = MessageStore()
        cls = store.add_definition("p/T", OTHER_HEADER)
        assert cls().header.__slots__ == ("other",)
        assert cls._full_text == OTHER_HEADER
        assert store.load_msg("std_msgs/Header") is load_msg("std_msgs/Header")

    def test_definitions_of_one_name_are_kept_apart(self) -> None:
        store = MessageStore()
        store.add_text("p/T", "int32 own")
        first = store.add_definition("p/T", "int32 first")
        second = store.add_definition("p/T", "int32 second")
        assert (first.__slots__, second.__slots__) == (("first",), ("second",))
        assert store.load_msg("p/T").__slots__ == ("own",)
        assert store.add_definition("p/T", "int32 first # again") is first

    def test_an_unknown_type_can_be_loaded_afterwards(self) -> None:
        store = MessageStore()
        cls = store.add_definition("p/Unknown", "int32 x")
        assert store.load_msg("p/Unknown") is cls
        with pytest.raises(MessageNotFoundError):
            load_msg("p/Unknown")

    def test_nothing_is_taken_from_elsewhere(self) -> None:
        with pytest.raises(
            MessageNotFoundError, match="definition of p/T lacks std_msgs/Header, needed by p/T"
        ):
            MessageStore().add_definition("p/T", "Header header\n")

    @pytest.mark.parametrize(
        ("text", "error"),
        [
            ("int32", "p/T:1"),
            ("p/T x", "contains itself: p/T -> p/T"),
            ("int32 x\n" + "=" * 80 + "\nMSG: Header\n", "expected 'MSG: package/Type'"),
            (OTHER_HEADER.replace("string other", "string"), "std_msgs/Header:1"),
        ],
    )
    def test_broken_ones(self, text: str, error: str) -> None:
        with pytest.raises(MessageSpecError, match=error):
            MessageStore().add_definition("p/T", text)

    def test_other_line_ends_and_rules(self) -> None:
        text = OTHER_HEADER.replace("=" * 80, "=" * 78).replace("\n", "\r\n")
        assert MessageStore().add_definition("p/T", text)().header.__slots__ == ("other",)

    def test_their_number_is_bounded(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr("aioros1.idl.store._MAX_DEFINITIONS", 3)
        store = MessageStore(parent=None)
        for number in range(10):
            store.add_definition("p/T", f"int32 x{number}")
        assert len(store._definitions) == 3


class Foreign:
    """What genpy's classes carry."""

    _type = "p/Foreign"
    _full_text = "int32 x\n"
    _md5sum = "53af918a2a4a2a182c184142fff49b0c"


class TestResolving:
    def test_our_own(self) -> None:
        store = MessageStore()
        string = load_msg("std_msgs/String")
        assert store.resolve_msg("std_msgs/String") is string
        assert store.resolve_msg(string) is string
        assert store.resolve_srv("std_srvs/Empty") is load_srv("std_srvs/Empty")
        assert store.resolve_srv(load_srv("std_srvs/Empty")) is load_srv("std_srvs/Empty")
        other = MessageStore(parent=None)
        other.add_text("std_msgs/String", "int32 x")
        assert store.resolve_msg(other.load_msg("std_msgs/String")).__slots__ == ("x",)

    def test_foreign_classes_by_their_definition(self) -> None:
        store = MessageStore()
        expected = store.add_definition("p/Same", "int32 x\n")._md5sum
        foreign = type("Foreign", (Foreign,), {"_md5sum": expected})
        cls = store.resolve_msg(foreign)
        assert (cls._type, cls._md5sum, cls.__slots__) == ("p/Foreign", expected, ("x",))
        assert store.resolve_msg(foreign) is cls

    def test_foreign_classes_of_a_type_that_is_known(self) -> None:
        string = load_msg("std_msgs/String")
        attributes = {name: getattr(string, name) for name in ("_type", "_md5sum", "_full_text")}
        assert MessageStore().resolve_msg(type("String", (), attributes)) is string
        store = MessageStore()
        store.add_text("std_msgs/String", "int32 x")
        assert store.resolve_msg(type("String", (), attributes)).__slots__ == ("data",)

    def test_foreign_classes_that_are_not_what_they_say(self) -> None:
        with pytest.raises(MessageSpecError, match=r"has MD5 sum .*, not 0"):
            MessageStore().resolve_msg(type("Foreign", (Foreign,), {"_md5sum": "0"}))

    def test_foreign_services(self) -> None:
        store = MessageStore()
        md5sum = store.add_definition("p/Same", "int32 x\n")._md5sum

        def part(name: str) -> type:
            return type(name, (Foreign,), {"_type": f"p/{name}", "_md5sum": md5sum})

        attributes = {
            "_type": "p/Do",
            "_md5sum": "?",
            "_request_class": part("DoRequest"),
            "_response_class": part("DoResponse"),
        }
        srv = store.resolve_srv(type("Do", (), attributes))
        assert (srv._type, srv.Request._type, srv.Response.__slots__) == (
            "p/Do",
            "p/DoRequest",
            ("x",),
        )
        assert srv._full_text == "int32 x\n---\nint32 x\n"
        known = load_srv("std_srvs/SetBool")
        names = ("_type", "_md5sum", "_request_class", "_response_class")
        assert store.resolve_srv(type("S", (), {n: getattr(known, n) for n in names})) is known

    def test_actions(self) -> None:
        store = MessageStore()
        fibonacci = load_action("actionlib_tutorials/Fibonacci")
        assert store.resolve_action("actionlib_tutorials/Fibonacci") is fibonacci
        assert store.resolve_action(fibonacci) is fibonacci
        # As in rospy: by the message that has goal, result and feedback in it.
        assert store.resolve_action(fibonacci.Action) is fibonacci
        names = ("_type", "_md5sum", "_full_text")
        attributes = {name: getattr(fibonacci.Action, name) for name in names}
        attributes["__slots__"] = list(fibonacci.Action.__slots__)
        foreign = type("FibonacciAction", (), attributes)
        assert store.resolve_action(foreign) is fibonacci

    def test_foreign_actions_that_are_not_known(self) -> None:
        other = MessageStore()
        other.add_text("p/Do", "int32 a\n---\nint32 b\n---\nint32 c\n")
        known = other.load_action("p/Do")
        store = MessageStore()
        action = store.resolve_action(known.Action)
        assert (action._type, action._md5sum) == ("p/Do", known._md5sum)
        assert action._full_text.rstrip() == "int32 a\n---\nint32 b\n---\nint32 c"
        assert (action.Goal, action.ActionGoal) == (known.Goal, known.ActionGoal)
        assert store.resolve_action(known.Action) is action

    def test_messages_that_look_like_those_of_actions(self) -> None:
        store = MessageStore()
        parts = ("goal", "result", "feedback")
        store.add_text("p/NoAction", "".join(f"int8 action_{part}\n" for part in parts))
        with pytest.raises(MessageSpecError, match="nothing in it is a p/NoActionGoal"):
            store.resolve_action(store.load_msg("p/NoAction"))

    @pytest.mark.parametrize("value", [5, None, int, object(), Message, Service, Action])
    def test_anything_else(self, value: Any) -> None:
        store = MessageStore()
        for resolve, kind in (
            (store.resolve_msg, "a message"),
            (store.resolve_srv, "a service"),
            (store.resolve_action, "an action"),
        ):
            with pytest.raises(TypeError, match=f"^expected {kind} class or 'package/Type', got "):
                resolve(value)

    def test_the_class_of_another_kind(self) -> None:
        store = MessageStore()
        message, service = load_msg("std_msgs/String"), load_srv("std_srvs/SetBool")
        action = load_action("actionlib_tutorials/Fibonacci")
        for resolve, value, got in (
            (store.resolve_msg, service, "the service class std_srvs/SetBool"),
            (store.resolve_msg, action, "the action class actionlib_tutorials/Fibonacci"),
            (store.resolve_srv, message, "the message class std_msgs/String"),
            (store.resolve_action, message, "the message class std_msgs/String"),
            (store.resolve_msg, message(data="x"), "a message of std_msgs/String"),
        ):
            with pytest.raises(TypeError, match=got):
                resolve(value)

    def test_names_of_another_kind(self) -> None:
        for store in (MessageStore(), default_store()):
            with pytest.raises(
                MessageNotFoundError,
                match=r"^expected the type of a message, got that of a service, std_srvs/SetBool: ",
            ):
                store.resolve_msg("std_srvs/SetBool")
        with pytest.raises(InvalidNameError, match="'String' is not the name of a type"):
            MessageStore().resolve_msg("String")


def test_repr(tmp_path: Path) -> None:
    store = MessageStore(tmp_path)
    assert repr(store) == f"<MessageStore: {tmp_path}, 0 types loaded>"
    store.add_text("p/T", "int32 x")
    store.load_msg("p/T")
    assert repr(store) == f"<MessageStore: {tmp_path}, 1 added text, 1 type loaded>"
    many = MessageStore([f"/dir{number}" for number in range(5)])
    assert repr(many) == "<MessageStore: /dir0, /dir1, 3 more directories, 0 types loaded>"
    assert repr(default_store()).startswith("<MessageStore: the standard places, ")
    assert repr(MessageStore()) == "<MessageStore: no directories, 0 types loaded>"


class TestServices:
    def test_attributes(self) -> None:
        srv = load_srv("std_srvs/SetBool")
        assert srv._md5sum == "09fb03525b03e7ea1fd3992bafd87e16"
        assert (srv._request_class, srv._response_class) == (srv.Request, srv.Response)
        assert srv.Request._type == "std_srvs/SetBoolRequest"
        assert srv.Request.__name__ == "SetBoolRequest"
        assert srv.Response(success=True, message="ok").to_bytes() == b"\1\2\0\0\0ok"
        assert srv._full_text.count("---") == 1


GO = "int32 order\n---\nint32[] sequence\n---\nint32[] sequence\n"


class TestActions:
    def store(self) -> MessageStore:
        store = MessageStore()
        store.add_text("tutorials/Fibonacci", GO)
        return store

    def test_the_seven_messages(self) -> None:
        action = self.store().load_action("tutorials/Fibonacci")
        assert action.Goal(order=5).to_bytes() == b"\5\0\0\0"
        assert action.ActionGoal.__slots__ == ("header", "goal_id", "goal")
        assert action.ActionResult.__slots__ == ("header", "status", "result")
        assert action.ActionFeedback.__slots__ == ("header", "status", "feedback")
        assert action.Action.__slots__ == ("action_goal", "action_result", "action_feedback")
        assert isinstance(action.ActionGoal().goal, action.Goal)
        # The sums that actionlib_tutorials has everywhere.
        assert action._md5sum == "f59df5767bf7634684781c92598b2406"
        assert action.Goal._md5sum == "6889063349a00b249bd1661df429d822"
        assert action.ActionResult._md5sum == "bee73a9fe29ae25e966e105f5553dd03"

    def test_they_can_be_loaded_by_name(self) -> None:
        store = self.store()
        result = store.load_msg("tutorials/FibonacciActionResult")
        assert store.load_action("tutorials/Fibonacci").ActionResult is result
        assert store.load_action("tutorials/Fibonacci") is store.load_action("tutorials/Fibonacci")

    def test_in_a_parent(self) -> None:
        parent = self.store()
        action = parent.load_action("tutorials/Fibonacci")
        assert MessageStore(parent=parent).load_action("tutorials/Fibonacci") is action
