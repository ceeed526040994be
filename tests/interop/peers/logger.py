"""A rospy node that logs a warning again and again."""

import argparse

import rospy
from common import say

parser = argparse.ArgumentParser()
parser.add_argument("text")
parser.add_argument("--name", default="rospy_logger")
options = parser.parse_args(rospy.myargv()[1:])
rospy.init_node(options.name)
say(ready=True)
while not rospy.is_shutdown():
    rospy.logwarn(options.text)
    try:
        rospy.sleep(0.1)
    except rospy.ROSInterruptException:
        break
