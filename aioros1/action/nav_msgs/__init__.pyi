# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.nav_msgs as _msg_nav_msgs

class GetMap(_t.Action[
    _msg_nav_msgs.GetMapGoal,
    _msg_nav_msgs.GetMapResult,
    _msg_nav_msgs.GetMapFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_nav_msgs.GetMapActionGoal
    ActionResult: _ty.TypeAlias = _msg_nav_msgs.GetMapActionResult
    ActionFeedback: _ty.TypeAlias = _msg_nav_msgs.GetMapActionFeedback
    Action: _ty.TypeAlias = _msg_nav_msgs.GetMapAction
    Goal: _ty.TypeAlias = _msg_nav_msgs.GetMapGoal
    Result: _ty.TypeAlias = _msg_nav_msgs.GetMapResult
    Feedback: _ty.TypeAlias = _msg_nav_msgs.GetMapFeedback
