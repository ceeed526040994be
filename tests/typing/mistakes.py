"""Mistakes that type checkers are to find, in every line that says so.

A checker that misses one reports that there is nothing to ignore. Never run.
"""
# pyright: strict, reportUnnecessaryTypeIgnoreComment=true
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false, reportUnusedImport=false
# ruff: noqa: F401

from __future__ import annotations

import aioros1
import aioros1.msg.geometry_msgs
import aioros1.msg.no_such_msgs  # type: ignore[import-not-found]  # pyright: ignore[reportMissingImports]
from aioros1.msg.geometry_msgs import Point, Polygon, Twist
from aioros1.msg.sensor_msgs import Image, JointState, LaserScan, PointField
from aioros1.msg.std_msgs import Bool, Header, Int32, String
from aioros1.srv.std_srvs import SetBool, Trigger


def unknown_names() -> None:
    from aioros1.msg.std_msgs import NoSuchType  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]

    print(aioros1.msg.geometry_msgs.Vektor)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    print(String().dat)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    String().dat = "x"  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    print(PointField.FLOAT16)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    print(SetBool.Reply)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    String(date="x")  # type: ignore[call-overload]  # pyright: ignore[reportCallIssue]
    SetBool.Request(date=True)  # type: ignore[call-overload]  # pyright: ignore[reportCallIssue]


def wrong_values() -> None:
    Int32(data="1")  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType]
    Int32(data=1.5)  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType]
    Bool(data=2)  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType]
    String(data=1)  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType]
    Header(stamp=1.5)  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType]
    Twist(linear=Point())  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType]
    Point(1.0, 2.0)  # type: ignore[call-overload]  # pyright: ignore[reportCallIssue]
    Point(1.0, 2.0, z=3.0)  # type: ignore[call-overload]  # pyright: ignore[reportCallIssue]
    JointState(name="joint")  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType]
    LaserScan(ranges=["1.0"])  # type: ignore[list-item]  # pyright: ignore[reportArgumentType]
    Image().data = "text"  # type: ignore[assignment]  # pyright: ignore[reportAttributeAccessIssue]
    LaserScan().ranges = 1.0  # type: ignore[assignment]  # pyright: ignore[reportAttributeAccessIssue]
    Polygon().points = [Point()]  # type: ignore[list-item]  # pyright: ignore[reportAttributeAccessIssue]
    Polygon().points.append(Point())  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    Int32().data = "1"  # type: ignore[assignment]  # pyright: ignore[reportAttributeAccessIssue]
    PointField().FLOAT32 = 8  # type: ignore[misc]  # pyright: ignore[reportAttributeAccessIssue]


async def wrong_messages(node: aioros1.Node) -> None:
    pub = await node.advertise("chatter", String)
    pub.publish(Int32(data=1))  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    await pub.send("hi")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    sub = await node.subscribe("chatter", String)
    wrong: Int32 = await sub.get()  # type: ignore[assignment]  # pyright: ignore[reportAssignmentType]
    print(wrong, (await sub.get()).date)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    print(sub.latest.data)  # type: ignore[union-attr]  # pyright: ignore[reportOptionalMemberAccess]
    async for event in sub.events():
        print(event.message.date)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    await node.subscribe("chatter", SetBool)  # type: ignore[type-var]  # pyright: ignore[reportCallIssue, reportArgumentType]
    await node.advertise("chatter", int)  # type: ignore[type-var]  # pyright: ignore[reportCallIssue, reportArgumentType]


async def wrong_services(node: aioros1.Node) -> None:
    def answers_otherwise(request: SetBool.Request) -> Trigger.Response:
        return Trigger.Response()

    def takes_another(request: Trigger.Request) -> SetBool.Response:
        return SetBool.Response()

    await node.advertise_service("flip", SetBool, answers_otherwise)  # type: ignore[arg-type]  # pyright: ignore[reportCallIssue, reportArgumentType]
    await node.advertise_service("flip", SetBool, takes_another)  # type: ignore[arg-type]  # pyright: ignore[reportCallIssue, reportArgumentType]
    await node.advertise_service("flip", String)  # type: ignore[arg-type]  # pyright: ignore[reportCallIssue, reportArgumentType]
    caller = await node.service_caller("flip", SetBool)
    print((await caller.call(data=True)).succes)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    await caller.call(Trigger.Request())  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    print((await node.call("flip", SetBool, data=True)).succes)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
    async with node.advertise_service("flip", SetBool) as provider:
        async for call in provider:
            await call.reply(Trigger.Response())  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]


async def wrong_callbacks(node: aioros1.Node) -> None:
    def takes_another(message: Int32) -> None: ...
    async def awaits_another(message: Int32) -> None: ...

    await node.subscribe("chatter", String, takes_another)  # type: ignore[arg-type]  # pyright: ignore[reportCallIssue, reportArgumentType]
    await node.subscribe("chatter", String, awaits_another)  # type: ignore[arg-type]  # pyright: ignore[reportCallIssue, reportArgumentType]
    await node.subscribe("chatter", String, "takes_another")  # type: ignore[call-overload]  # pyright: ignore[reportCallIssue, reportArgumentType]


async def wrong_raw_services(node: aioros1.Node) -> None:
    def answers_with_text(request: bytes) -> str:
        return ""

    def takes_a_request(request: SetBool.Request) -> bytes:
        return b""

    await node.advertise_service("flip", SetBool, answers_with_text, raw=True)  # type: ignore[arg-type]  # pyright: ignore[reportCallIssue, reportArgumentType]
    await node.advertise_service("flip", SetBool, takes_a_request, raw=True)  # type: ignore[arg-type]  # pyright: ignore[reportCallIssue, reportArgumentType]
    caller = await node.service_caller("flip", SetBool)
    await caller.call_raw(SetBool.Request())  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    async with node.advertise_service("flip", "*", raw=True) as provider:
        async for call in provider:
            await call.reply("text")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]


async def wrong_tasks(node: aioros1.Node) -> None:
    async def work() -> int:
        return 1

    node.create_task(work)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    result: int = await node.create_task(work())  # type: ignore[func-returns-value, assignment]  # pyright: ignore[reportAssignmentType]
    print(result)


class WrongComposite(aioros1.Composite):
    async def _open(self) -> None:
        sub = await self._own(self.node.subscribe("chatter", String))
        wrong: Int32 = await sub.get()  # type: ignore[assignment]  # pyright: ignore[reportAssignmentType]
        print(wrong)
        await self._own(self.node.sleep(1))  # type: ignore[type-var]  # pyright: ignore[reportArgumentType]
        self._create_task(print)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]

    def _abort(self) -> int:  # type: ignore[override]  # pyright: ignore[reportIncompatibleMethodOverride]
        return 1


async def wrong_composites(node: aioros1.Node) -> None:
    WrongComposite("node")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    wrong: WrongComposite = WrongComposite(node)
    print((await wrong).nam)  # type: ignore[attr-defined]  # pyright: ignore[reportAttributeAccessIssue]
