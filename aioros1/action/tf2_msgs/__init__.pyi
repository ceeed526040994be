# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.tf2_msgs as _msg_tf2_msgs

class LookupTransform(_t.Action[
    _msg_tf2_msgs.LookupTransformGoal,
    _msg_tf2_msgs.LookupTransformResult,
    _msg_tf2_msgs.LookupTransformFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_tf2_msgs.LookupTransformActionGoal
    ActionResult: _ty.TypeAlias = _msg_tf2_msgs.LookupTransformActionResult
    ActionFeedback: _ty.TypeAlias = _msg_tf2_msgs.LookupTransformActionFeedback
    Action: _ty.TypeAlias = _msg_tf2_msgs.LookupTransformAction
    Goal: _ty.TypeAlias = _msg_tf2_msgs.LookupTransformGoal
    Result: _ty.TypeAlias = _msg_tf2_msgs.LookupTransformResult
    Feedback: _ty.TypeAlias = _msg_tf2_msgs.LookupTransformFeedback
