"""Parameter operations of rospy: a JSON list on standard input is one call."""

import json
import sys

import rospy
from common import say

rospy.init_node("rospy_params", anonymous="--anonymous" in sys.argv)
operations = {
    "get": rospy.get_param,
    "get_cached": rospy.get_param_cached,
    "set": rospy.set_param,
    "has": rospy.has_param,
    "delete": rospy.delete_param,
    "search": rospy.search_param,
    "names": rospy.get_param_names,
}
say(ready=True)
for line in sys.stdin:
    operation, *arguments = json.loads(line)
    try:
        say(result=operations[operation](*arguments))
    except Exception as error:
        say(result=None, error=str(error), kind=type(error).__name__)
