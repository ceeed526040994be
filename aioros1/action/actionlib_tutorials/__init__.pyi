# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.actionlib_tutorials as _msg_actionlib_tutorials

class Averaging(_t.Action[
    _msg_actionlib_tutorials.AveragingGoal,
    _msg_actionlib_tutorials.AveragingResult,
    _msg_actionlib_tutorials.AveragingFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_actionlib_tutorials.AveragingActionGoal
    ActionResult: _ty.TypeAlias = _msg_actionlib_tutorials.AveragingActionResult
    ActionFeedback: _ty.TypeAlias = _msg_actionlib_tutorials.AveragingActionFeedback
    Action: _ty.TypeAlias = _msg_actionlib_tutorials.AveragingAction
    Goal: _ty.TypeAlias = _msg_actionlib_tutorials.AveragingGoal
    Result: _ty.TypeAlias = _msg_actionlib_tutorials.AveragingResult
    Feedback: _ty.TypeAlias = _msg_actionlib_tutorials.AveragingFeedback

class Fibonacci(_t.Action[
    _msg_actionlib_tutorials.FibonacciGoal,
    _msg_actionlib_tutorials.FibonacciResult,
    _msg_actionlib_tutorials.FibonacciFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_actionlib_tutorials.FibonacciActionGoal
    ActionResult: _ty.TypeAlias = _msg_actionlib_tutorials.FibonacciActionResult
    ActionFeedback: _ty.TypeAlias = _msg_actionlib_tutorials.FibonacciActionFeedback
    Action: _ty.TypeAlias = _msg_actionlib_tutorials.FibonacciAction
    Goal: _ty.TypeAlias = _msg_actionlib_tutorials.FibonacciGoal
    Result: _ty.TypeAlias = _msg_actionlib_tutorials.FibonacciResult
    Feedback: _ty.TypeAlias = _msg_actionlib_tutorials.FibonacciFeedback
