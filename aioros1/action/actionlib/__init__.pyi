# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib as _msg_actionlib

class Test(_t.Action[_msg_actionlib.TestGoal, _msg_actionlib.TestResult, _msg_actionlib.TestFeedback]):
    ActionGoal: _ty.TypeAlias = _msg_actionlib.TestActionGoal
    ActionResult: _ty.TypeAlias = _msg_actionlib.TestActionResult
    ActionFeedback: _ty.TypeAlias = _msg_actionlib.TestActionFeedback
    Action: _ty.TypeAlias = _msg_actionlib.TestAction
    Goal: _ty.TypeAlias = _msg_actionlib.TestGoal
    Result: _ty.TypeAlias = _msg_actionlib.TestResult
    Feedback: _ty.TypeAlias = _msg_actionlib.TestFeedback

class TestRequest(_t.Action[
    _msg_actionlib.TestRequestGoal,
    _msg_actionlib.TestRequestResult,
    _msg_actionlib.TestRequestFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_actionlib.TestRequestActionGoal
    ActionResult: _ty.TypeAlias = _msg_actionlib.TestRequestActionResult
    ActionFeedback: _ty.TypeAlias = _msg_actionlib.TestRequestActionFeedback
    Action: _ty.TypeAlias = _msg_actionlib.TestRequestAction
    Goal: _ty.TypeAlias = _msg_actionlib.TestRequestGoal
    Result: _ty.TypeAlias = _msg_actionlib.TestRequestResult
    Feedback: _ty.TypeAlias = _msg_actionlib.TestRequestFeedback

class TwoInts(_t.Action[
    _msg_actionlib.TwoIntsGoal,
    _msg_actionlib.TwoIntsResult,
    _msg_actionlib.TwoIntsFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_actionlib.TwoIntsActionGoal
    ActionResult: _ty.TypeAlias = _msg_actionlib.TwoIntsActionResult
    ActionFeedback: _ty.TypeAlias = _msg_actionlib.TwoIntsActionFeedback
    Action: _ty.TypeAlias = _msg_actionlib.TwoIntsAction
    Goal: _ty.TypeAlias = _msg_actionlib.TwoIntsGoal
    Result: _ty.TypeAlias = _msg_actionlib.TwoIntsResult
    Feedback: _ty.TypeAlias = _msg_actionlib.TwoIntsFeedback
