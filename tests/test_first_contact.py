"""Where people slip in their first hour: each mistake is answered with what to do.

A row is a mistake, the error that Python or the library raises for it, and what its text has
to say.
"""

from __future__ import annotations

import gc
import inspect
import typing
import warnings
from collections.abc import Callable
from typing import Any

import pytest

import aioros1
import aioros1.msg.std_msgs
from aioros1.action.actionlib import Test as ActionTest
from aioros1.msg.geometry_msgs import Twist
from aioros1.msg.std_msgs import Empty, String
from aioros1.srv.std_srvs import SetBool

from .house.public import public_modules, public_names

one_loop = pytest.mark.asyncio(loop_factories=["asyncio"])


async def iterated(opening: Any) -> None:
    async for _ in opening:
        pass


def entered(opening: Any) -> None:
    with opening:
        pass


async def coroutine_function(message: object) -> None: ...


NOT_AWAITED = {
    "publish": lambda n: n.advertise("t", String).publish(data="x"),
    "send": lambda n: n.advertise("t", String).send(data="x"),
    "get": lambda n: n.subscribe("t", String).get(),
    "iterate": lambda n: iterated(n.subscribe("t", String)),
    "for": lambda n: list(n.subscribe("t", String)),
    "close": lambda n: n.subscribe("t", String).close(),
    "with": lambda n: entered(n.advertise("t", String)),
    "call": lambda n: n.service_caller("s", SetBool).call(data=True),
    "call it": lambda n: n.service_caller("s", SetBool)(data=True),
    "calls": lambda n: iterated(n.advertise_service("s", SetBool)),
    "value": lambda n: n.subscribe_param("p").value,
}


@one_loop
@pytest.mark.parametrize("mistake", NOT_AWAITED)
async def test_what_opens_a_role_was_not_awaited(make_node, mistake):
    node = await make_node()
    text = ""
    with warnings.catch_warnings():
        # Python says of the coroutine that it was never awaited, which is right.
        warnings.simplefilter("ignore", RuntimeWarning)
        try:
            await NOT_AWAITED[mistake](node)
        except (AttributeError, TypeError) as error:
            text = str(error)
        gc.collect()
    assert "is not open yet. Await the call that opens it" in text
    assert "async with" in text


@one_loop
async def test_python_names_what_was_not_awaited_as_users_know_it(make_node):
    node = await make_node()
    for mistake, name in (
        (lambda: node.advertise("t", String), "Node.advertise"),
        (lambda: node.subscribe("t", String), "Node.subscribe"),
        (lambda: node.advertise_service("s", SetBool), "Node.advertise_service"),
        (lambda: node.service_caller("s", SetBool), "Node.service_caller"),
        (lambda: node.subscribe_param("p"), "Node.subscribe_param"),
        (lambda: node.get_param("p"), "Node.get_param"),
        (lambda: node.wait_for_message("t"), "Node.wait_for_message"),
        (lambda: node.call("s", SetBool), "Node.call"),
        (lambda: node.sleep(1), "Node.sleep"),
    ):
        with pytest.warns(RuntimeWarning, match=f"^coroutine '{name}' was never awaited"):
            mistake()


async def test_private_names_of_an_opening_are_just_missing(make_node):
    opening = (await make_node()).advertise("t", String)
    with pytest.raises(AttributeError, match=r"^'Opening' object has no attribute '__array__'$"):
        opening.__array__  # noqa: B018
    await (await opening).close()


TABLE: list[tuple[str, Callable[[Any], Any], type[Exception], list[str]]] = [
    # what is published
    ("text", lambda t: t.string.publish("text"), aioros1.SerializationError,
     ["expected a std_msgs/String, got 'text'", "data='text'", "(std_msgs/String on /string)"]),
    ("a number", lambda t: t.string.publish(5), aioros1.SerializationError, ["data=5"]),
    ("a list", lambda t: t.string.publish(["a"]), aioros1.SerializationError, ["data=['a']"]),
    ("text for several fields", lambda t: t.twist.publish("x"), aioros1.SerializationError,
     ["got 'x'", "linear=..., angular=...", "(geometry_msgs/Twist on /twist)"]),
    ("something for nothing", lambda t: t.empty.publish("x"), aioros1.SerializationError,
     ["it has no fields, give nothing"]),
    ("the class", lambda t: t.string.publish(String), aioros1.SerializationError,
     ["got <class", "make a message of the class first"]),
    ("another message", lambda t: t.string.publish(Twist()), aioros1.SerializationError,
     ["expected a std_msgs/String, got a geometry_msgs/Twist", "/string"]),
    ("a wrong field", lambda t: t.string.publish({"dat": "x"}), aioros1.SerializationError,
     ["dat: not a field of std_msgs/String; its fields: data"]),
    ("a wrong keyword", lambda t: t.string.publish(dat="x"), AttributeError,
     ["std_msgs/String has no field 'dat'; its fields: data"]),
    ("a wrong value", lambda t: t.string.publish(data=5), aioros1.SerializationError,
     ["data: expected", "got 5", "(std_msgs/String on /string)"]),
    ("a wrong value, sent", lambda t: t.string.send("x"), aioros1.SerializationError,
     ["data='x'", "(std_msgs/String on /string)"]),
    ("a wrong value, repeated", lambda t: t.string.publish_every(1, "x"),
     aioros1.SerializationError, ["data='x'", "(std_msgs/String on /string)"]),
    ("a request", lambda t: t.node.call("flip", SetBool, True), aioros1.SerializationError,
     ["expected a std_srvs/SetBoolRequest, got True", "data=True", "SetBoolRequest to /flip)"]),
    ("a wrong value of a request", lambda t: t.node.call("flip", SetBool, data="no"),
     aioros1.SerializationError, ["data: expected", "'no'", "SetBoolRequest to /flip)"]),
    # types
    ("a misspelt type", lambda t: t.node.advertise("t", "std_msgs/Strng"),
     aioros1.MessageNotFoundError, ["did you mean std_msgs/String?"]),
    ("a misspelt package", lambda t: t.node.subscribe("t", "std_msg/String"),
     aioros1.MessageNotFoundError, ["did you mean std_msgs/String?"]),
    ("another package", lambda t: t.node.subscribe("t", "geometry_msgs/LaserScan"),
     aioros1.MessageNotFoundError, ["did you mean sensor_msgs/LaserScan?"]),
    ("wrong capitals", lambda t: t.node.wait_for_message("t", "std_msgs/string"),
     aioros1.MessageNotFoundError, ["did you mean std_msgs/String"]),
    ("a misspelt service", lambda t: t.node.service_caller("s", "std_srvs/SetBol"),
     aioros1.MessageNotFoundError, ["did you mean std_srvs/SetBool?"]),
    ("no package", lambda t: t.node.advertise("t", "String"), aioros1.InvalidNameError,
     ["'String'", "did you mean std_msgs/String?"]),
    ("no package, misspelt", lambda t: t.node.advertise("t", "Laserscan"),
     aioros1.InvalidNameError, ["did you mean sensor_msgs/LaserScan?"]),
    ("as Python imports it", lambda t: t.node.advertise("t", "std_msgs.msg.String"),
     aioros1.InvalidNameError, ["did you mean std_msgs/String?"]),
    ("as this library has it", lambda t: t.node.advertise("t", "aioros1.msg.std_msgs.String"),
     aioros1.InvalidNameError, ["did you mean std_msgs/String?"]),
    ("as ROS 2 names it", lambda t: t.node.advertise("t", "std_msgs/msg/String"),
     aioros1.InvalidNameError, ["did you mean std_msgs/String?"]),
    ("as C++ names it", lambda t: t.node.call("s", "std_srvs::SetBool"),
     aioros1.InvalidNameError, ["did you mean std_srvs/SetBool?"]),
    ("as its file is named", lambda t: t.node.advertise("t", "std_msgs/String.msg"),
     aioros1.InvalidNameError, ["did you mean std_msgs/String?"]),
    ("with spaces", lambda t: t.node.advertise("t", " std_msgs/String "),
     aioros1.InvalidNameError, ["did you mean std_msgs/String?"]),
    ("a service type for a topic", lambda t: t.node.advertise("t", "std_srvs/SetBool"),
     aioros1.MessageNotFoundError, ["got that of a service, std_srvs/SetBool",
                                    "advertise_service()"]),
    ("a service class for a topic", lambda t: t.node.subscribe("t", SetBool), TypeError,
     ["the service class std_srvs/SetBool", "service_caller()"]),
    ("a message type for a service", lambda t: t.node.service_caller("s", "std_msgs/String"),
     aioros1.MessageNotFoundError, ["got that of a message, std_msgs/String", "advertise()"]),
    ("a message class for a service", lambda t: t.node.advertise_service("s", String), TypeError,
     ["the message class std_msgs/String", "subscribe()"]),
    ("a request's class for a service", lambda t: t.node.service_caller("s", SetBool.Request),
     TypeError, ["hand over the class of the service, std_srvs/SetBool"]),
    ("an action type", lambda t: t.node.advertise("t", "actionlib/Test"),
     aioros1.MessageNotFoundError, ["that of an action", "actionlib/TestActionGoal"]),
    ("an action class", lambda t: t.node.advertise("t", ActionTest), TypeError,
     ["the action class actionlib/Test", "actionlib/TestActionGoal"]),
    ("a message", lambda t: t.node.advertise("t", String()), TypeError, ["hand over its class"]),
    ("a module", lambda t: t.node.advertise("t", aioros1.msg.std_msgs), TypeError,
     ["the module aioros1.msg.std_msgs", "one of the classes in it"]),
    ("a type of Python", lambda t: t.node.advertise("t", str), TypeError, ["std_msgs/String"]),
    ("none", lambda t: t.node.advertise("t", None), TypeError, ["message class", "got None"]),
    ("a callback", lambda t: t.node.subscribe("t", print), TypeError,
     ["the function", "comes after the type"]),
    ("a handler", lambda t: t.node.advertise_service("t", lambda request: None), TypeError,
     ["the function", "comes after the type"]),
    ("name and type the other way round", lambda t: t.node.advertise(String, "t"), TypeError,
     ["the name comes before the type"]),
    # options
    *(
        (f"queue_size={size}", lambda t, size=size: t.node.advertise("t", String, queue_size=size),
         ValueError, [f"got {size}", "every queue is bounded", "overflow='block'"])
        for size in (None, 0, -1)
    ),
    ("queue_size of a subscriber", lambda t: t.node.subscribe("t", String, queue_size=None),
     ValueError, ["got None", "every queue is bounded"]),
    ("queue_size as text", lambda t: t.node.advertise("t", String, queue_size="10"),
     ValueError, ["a whole number of messages, at least 1, got '10'"]),
    ("queue_size as a flag", lambda t: t.node.advertise("t", String, queue_size=True),
     ValueError, ["a whole number of messages, at least 1, got True"]),
    ("queue_size by position", lambda t: t.node.advertise("t", String, 10), TypeError,
     ["takes 3 positional arguments", "advertise(topic, type, *, latch=False, queue_size=10"]),
    ("no type", lambda t: t.node.advertise("t"), TypeError,
     ["missing 1 required positional argument: 'type'", "advertise(topic, type, *"]),
    ("a misspelt option", lambda t: t.node.advertise("t", String, latched=True), TypeError,
     ["'latched'", "id you mean", "latch", "queue_size=10"]),
    ("an option of rospy", lambda t: t.node.subscribe("t", data_class=String), TypeError,
     ["'data_class'", "did you mean type?", "subscribe(topic, type='*', callback=None"]),
    ("a callback's arguments", lambda t: t.node.subscribe("t", String, print, callback_args=1),
     TypeError, ["functools.partial"]),
    ("a misspelt option of a service",
     lambda t: t.node.advertise_service("s", SetBool, max_concurency=1), TypeError,
     ["id you mean", "max_concurrency", "advertise_service(name, type, handler=None"]),
    ("a misspelt option of a caller",
     lambda t: t.node.service_caller("s", SetBool, persistant=True), TypeError,
     ["id you mean", "persistent"]),
    ("a misspelt option of a node", lambda t: aioros1.Node("n", master="http://x:1"), TypeError,
     ["id you mean", "master_uri"]),
    ("a misspelt option of a master", lambda t: aioros1.Master(prot=0), TypeError,
     ["id you mean", "port"]),
    ("a method is named as users know it", lambda t: t.node.set_param("a"), TypeError,
     ["Node.set_param() missing 1 required positional argument: 'value'"]),
    ("latch as text", lambda t: t.node.advertise("t", String, latch="no"), TypeError,
     ["latch must be True or False, got 'no'"]),
    ("headers as text", lambda t: t.node.advertise("t", String, headers="a=b"), TypeError,
     ["headers must be a mapping of str to str or None"]),
    ("raw as text", lambda t: t.node.subscribe("t", String, raw="no"), TypeError,
     ["raw must be True or False, got 'no'"]),
    ("timeout as text", lambda t: t.node.service_caller("s", SetBool, timeout="1"), TypeError,
     ["timeout must be a number of seconds or None, got '1'"]),
    ("concurrency as text", lambda t: t.node.advertise_service("s", SetBool, max_concurrency="1"),
     TypeError, ["max_concurrency must be a whole number of calls or None, got '1'"]),
    ("a misspelt overflow", lambda t: t.node.advertise("t", String, overflow="drop-oldest"),
     ValueError, ["'drop_oldest', 'drop_newest', 'block', got 'drop-oldest'"]),
    # functions
    ("no callback", lambda t: t.node.subscribe("t", String, "print"), TypeError,
     ["subscriber t: the callback is a function, got 'print'"]),
    ("a callback that was called", lambda t: t.node.subscribe("t", String, coroutine_function(1)),
     TypeError, ["hand over the function itself", "coroutine_function()"]),
    ("a callback of nothing", lambda t: t.node.subscribe("t", String, lambda: None), TypeError,
     ["called with the message", "too many positional arguments"]),
    ("a handler of two", lambda t: t.node.advertise_service("s", SetBool, lambda a, b: None),
     TypeError, ["service s: the handler is called with the request", "(a, b)",
                 "missing a required argument: 'b'"]),
    ("no handler", lambda t: t.node.advertise_service("s", SetBool, "flip"), TypeError,
     ["service s: the handler is a function, got 'flip'"]),
    ("a timer's function of nothing", lambda t: t.node.timer(1, lambda: None), TypeError,
     ["the callback of a timer is called with the time"]),
    ("a function of messages", lambda t: t.string.publish_every(1, lambda: None), TypeError,
     ["publisher /string", "called with the time"]),
    ("a task of a function", lambda t: t.node.create_task(coroutine_function), TypeError,
     ["takes a coroutine", "call it, as in coroutine_function()"]),
    # numbers
    ("a period as text", lambda t: t.node.timer("1", print), TypeError,
     ["a Duration or a number of seconds, got '1'"]),
    ("a rate as text", lambda t: t.node.rate("10"), TypeError, ["a number of Hz, got '10'"]),
    ("to sleep for text", lambda t: t.node.sleep("1"), TypeError,
     ["a Duration or a number of seconds, got '1'"]),
    ("to wait for a number", lambda t: t.node.wait_for_time(5), TypeError,
     ["wait_for_time() takes a Time, as in Time(5), got 5"]),
    # other libraries
    ("a publisher of its own", lambda t: aioros1.Publisher("t", String, queue_size=10), TypeError,
     ["a publisher needs a node", "await node.advertise(...)"]),
    ("a subscriber of its own", lambda t: aioros1.Subscriber("t", String, print), TypeError,
     ["a subscriber needs a node", "await node.subscribe(...)"]),
    ("a caller of its own", lambda t: aioros1.ServiceCaller("s", SetBool), TypeError,
     ["await node.service_caller(...)"]),
    ("a provider of its own", lambda t: aioros1.ServiceProvider("s", SetBool, print), TypeError,
     ["await node.advertise_service(...)"]),
    ("a followed parameter", lambda t: aioros1.ParamSubscriber("p"), TypeError,
     ["await node.subscribe_param(...)"]),
    ("a rate of its own", lambda t: aioros1.Rate(10), TypeError, ["node.rate(hz)"]),
    ("a timer of its own", lambda t: aioros1.Timer(1, print), TypeError, ["node.timer("]),
    ("init_node", lambda t: aioros1.init_node("n"), AttributeError, ["aioros1.run(main, name)"]),
    ("spin", lambda t: aioros1.spin(), AttributeError, ["await node.wait_closed()"]),
    ("loginfo", lambda t: aioros1.loginfo("x"), AttributeError, ["node.log.info(text)"]),
    ("publish of a node", lambda t: t.node.publish("t", "x"), AttributeError,
     ["await node.advertise(topic, type)"]),
    ("create_publisher", lambda t: t.node.create_publisher(String, "t", 10), AttributeError,
     ["await node.advertise(topic, type)"]),
    ("sleep of a rate", lambda t: t.node.rate(10).sleep(), AttributeError,
     ["async for now in node.rate(hz)"]),
    ("something else", lambda t: t.node.frobnicate, AttributeError,
     ["'Node' object has no attribute 'frobnicate'"]),
    # imports
    *(
        (statement, lambda t, statement=statement: exec(statement), ModuleNotFoundError, parts)
        for statement, parts in {
            "from aioros1.msg.std_msg import String": ["did you mean aioros1.msg.std_msgs?"],
            "import aioros1.srv.std_srv": ["did you mean aioros1.srv.std_srvs?"],
            "from aioros1.msg.std_srvs import SetBool": ["did you mean aioros1.srv.std_srvs?"],
            "from aioros1.srv.std_msgs import String": ["did you mean aioros1.msg.std_msgs?"],
            "from aioros1.msg import String": ["mean from aioros1.msg.std_msgs import String?"],
            "from aioros1.msg import qqqqqqqq": ["no package 'qqqqqqqq' has message definitions"],
        }.items()
    ),
    ("a misspelt package", lambda t: aioros1.msg.std_msg, AttributeError,
     ["has no attribute 'std_msg'", "did you mean aioros1.msg.std_msgs?"]),
    ("a misspelt type", lambda t: aioros1.msg.std_msgs.Strng, AttributeError,
     ["did you mean std_msgs/String?"]),
]  # fmt: skip


class Things:
    """What the mistakes are made with."""

    node: aioros1.Node
    string: aioros1.Publisher[String]
    twist: aioros1.Publisher[Twist]
    empty: aioros1.Publisher[Empty]


@one_loop
@pytest.mark.parametrize(
    ("mistake", "error", "parts"),
    [pytest.param(*row[1:], id=row[0]) for row in TABLE],
)
async def test_a_mistake_is_answered_with_what_to_do(make_node, mistake, error, parts):
    things = Things()
    things.node = node = await make_node(rosout=False, logger_services=False)
    things.string = await node.advertise("string", String)
    things.twist = await node.advertise("twist", Twist)
    things.empty = await node.advertise("empty", Empty)
    roles = len(node.roles)
    with pytest.raises(error) as caught:
        result = mistake(things)
        if inspect.isawaitable(result):
            await result
    for part in parts:
        assert part in str(caught.value)
    assert len(node.roles) == roles, "something was left open"


@one_loop
async def test_a_function_that_takes_one_argument_in_any_way_will_do(make_node):
    node = await make_node(rosout=False, logger_services=False)

    class Callable:
        def __call__(self, message, more=1): ...

        def method(self, message): ...

    for callback in (print, [].append, String, Callable(), Callable().method,
                     lambda *messages: None, coroutine_function):  # fmt: skip
        await node.subscribe("t", String, callback)


def test_an_attribute_error_within_a_property_is_not_hidden():
    class Robot(aioros1.Node):
        @property
        def battery(self):
            return self.options.no_such_option

    with pytest.raises(AttributeError, match="no attribute 'no_such_option'"):
        Robot("robot").battery  # noqa: B018


async def test_a_node_that_was_not_started(master):
    node = aioros1.Node("n", master_uri=master.uri, host="localhost")
    with pytest.raises(aioros1.ClosedError, match=r"is new, not open: start it first, with"):
        await node.advertise("t", String)
    for name in ("uri", "tcpros_uri", "tcpros_address"):
        with pytest.raises(RuntimeError, match="/n has no address before it is started"):
            getattr(node, name)
    async with node:
        assert ":0" not in f"{node.uri} {node.tcpros_uri}"
        assert node.tcpros_address[1]


async def test_what_is_started_is_handed_back():
    master = aioros1.Master("localhost", 0)
    assert await master.start() is master
    node = aioros1.Node("n", master_uri=master.uri, host="localhost")
    assert await node.start() is node
    await node.close()
    await master.close()


def functions() -> dict[str, Any]:
    """All public functions and methods, by public path."""
    found = {}
    for path, one in public_names(public_modules()).items():
        members = {"": one.value}
        if isinstance(one.value, type):
            members = {name: inspect.getattr_static(one.value, name) for name in dir(one.value)}
        for name, member in members.items():
            if name.startswith("_") and name != "__init__":
                continue
            if isinstance(member, property):
                member = member.fget
            member = getattr(member, "__func__", member)
            if inspect.isfunction(member) and "aioros1" in member.__code__.co_filename:
                found[f"{path}.{name}"] = member
    return found


def test_annotations_can_be_evaluated():
    """Frameworks that inject arguments, and checkers at run time, do."""
    wrong = {}
    for path, function in functions().items():
        try:
            typing.get_type_hints(function)
        except NameError as error:
            wrong[path] = str(error)
    assert wrong == {}


@pytest.mark.parametrize("kind", ["msg", "srv"])
def test_suggestions_are_quick(tmp_path, kind):
    """Names of types may come from outside, through an application."""
    for number in range(300):
        folder = tmp_path / f"pack{number}_msgs" / kind
        folder.mkdir(parents=True)
        (folder / f"Kind{number}.{kind}").write_text("---\n" if kind == "srv" else "int8 x\n")
    store = aioros1.MessageStore(tmp_path)
    assert store.suggest("pack7_msgs/Kin7", kind)[0] == "pack7_msgs/Kind7"
    assert store.suggest("Kind7", kind) == ["pack7_msgs/Kind7"]
    assert store.suggest("x" * 1_000_000, kind) == []
    assert store.suggest("/".join("x" * 100_000), kind) == []
    assert store.suggest("", kind) == store.suggest("///", kind) == []
