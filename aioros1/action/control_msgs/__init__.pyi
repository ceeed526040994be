# Made by aioros1 from message definitions. Change those, and have it made anew.
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.control_msgs as _msg_control_msgs

class FollowJointTrajectory(_t.Action[
    _msg_control_msgs.FollowJointTrajectoryGoal,
    _msg_control_msgs.FollowJointTrajectoryResult,
    _msg_control_msgs.FollowJointTrajectoryFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_control_msgs.FollowJointTrajectoryActionGoal
    ActionResult: _ty.TypeAlias = _msg_control_msgs.FollowJointTrajectoryActionResult
    ActionFeedback: _ty.TypeAlias = _msg_control_msgs.FollowJointTrajectoryActionFeedback
    Action: _ty.TypeAlias = _msg_control_msgs.FollowJointTrajectoryAction
    Goal: _ty.TypeAlias = _msg_control_msgs.FollowJointTrajectoryGoal
    Result: _ty.TypeAlias = _msg_control_msgs.FollowJointTrajectoryResult
    Feedback: _ty.TypeAlias = _msg_control_msgs.FollowJointTrajectoryFeedback

class GripperCommand(_t.Action[
    _msg_control_msgs.GripperCommandGoal,
    _msg_control_msgs.GripperCommandResult,
    _msg_control_msgs.GripperCommandFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_control_msgs.GripperCommandActionGoal
    ActionResult: _ty.TypeAlias = _msg_control_msgs.GripperCommandActionResult
    ActionFeedback: _ty.TypeAlias = _msg_control_msgs.GripperCommandActionFeedback
    Action: _ty.TypeAlias = _msg_control_msgs.GripperCommandAction
    Goal: _ty.TypeAlias = _msg_control_msgs.GripperCommandGoal
    Result: _ty.TypeAlias = _msg_control_msgs.GripperCommandResult
    Feedback: _ty.TypeAlias = _msg_control_msgs.GripperCommandFeedback

class JointTrajectory(_t.Action[
    _msg_control_msgs.JointTrajectoryGoal,
    _msg_control_msgs.JointTrajectoryResult,
    _msg_control_msgs.JointTrajectoryFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_control_msgs.JointTrajectoryActionGoal
    ActionResult: _ty.TypeAlias = _msg_control_msgs.JointTrajectoryActionResult
    ActionFeedback: _ty.TypeAlias = _msg_control_msgs.JointTrajectoryActionFeedback
    Action: _ty.TypeAlias = _msg_control_msgs.JointTrajectoryAction
    Goal: _ty.TypeAlias = _msg_control_msgs.JointTrajectoryGoal
    Result: _ty.TypeAlias = _msg_control_msgs.JointTrajectoryResult
    Feedback: _ty.TypeAlias = _msg_control_msgs.JointTrajectoryFeedback

class PointHead(_t.Action[
    _msg_control_msgs.PointHeadGoal,
    _msg_control_msgs.PointHeadResult,
    _msg_control_msgs.PointHeadFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_control_msgs.PointHeadActionGoal
    ActionResult: _ty.TypeAlias = _msg_control_msgs.PointHeadActionResult
    ActionFeedback: _ty.TypeAlias = _msg_control_msgs.PointHeadActionFeedback
    Action: _ty.TypeAlias = _msg_control_msgs.PointHeadAction
    Goal: _ty.TypeAlias = _msg_control_msgs.PointHeadGoal
    Result: _ty.TypeAlias = _msg_control_msgs.PointHeadResult
    Feedback: _ty.TypeAlias = _msg_control_msgs.PointHeadFeedback

class SingleJointPosition(_t.Action[
    _msg_control_msgs.SingleJointPositionGoal,
    _msg_control_msgs.SingleJointPositionResult,
    _msg_control_msgs.SingleJointPositionFeedback,
]):
    ActionGoal: _ty.TypeAlias = _msg_control_msgs.SingleJointPositionActionGoal
    ActionResult: _ty.TypeAlias = _msg_control_msgs.SingleJointPositionActionResult
    ActionFeedback: _ty.TypeAlias = _msg_control_msgs.SingleJointPositionActionFeedback
    Action: _ty.TypeAlias = _msg_control_msgs.SingleJointPositionAction
    Goal: _ty.TypeAlias = _msg_control_msgs.SingleJointPositionGoal
    Result: _ty.TypeAlias = _msg_control_msgs.SingleJointPositionResult
    Feedback: _ty.TypeAlias = _msg_control_msgs.SingleJointPositionFeedback
