# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.move_base_msgs as _msg_move_base_msgs

class MoveBase(_t.Action[
    _msg_move_base_msgs.MoveBaseGoal,
    _msg_move_base_msgs.MoveBaseResult,
    _msg_move_base_msgs.MoveBaseFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_move_base_msgs.MoveBaseActionGoal
    ActionResult: _ty.TypeAlias = _msg_move_base_msgs.MoveBaseActionResult
    ActionFeedback: _ty.TypeAlias = _msg_move_base_msgs.MoveBaseActionFeedback
    Action: _ty.TypeAlias = _msg_move_base_msgs.MoveBaseAction
    Goal: _ty.TypeAlias = _msg_move_base_msgs.MoveBaseGoal
    Result: _ty.TypeAlias = _msg_move_base_msgs.MoveBaseResult
    Feedback: _ty.TypeAlias = _msg_move_base_msgs.MoveBaseFeedback
