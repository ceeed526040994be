"""A rospy subscriber that says what it hears, from whom and how."""

import argparse

import rospy
from common import message_class, plain, say

parser = argparse.ArgumentParser()
parser.add_argument("topic")
parser.add_argument("type", help="a type, or * for any, which is told undecoded")
parser.add_argument("--name", default="rospy_listener")
options = parser.parse_args(rospy.myargv()[1:])


def heard(message):
    header = message._connection_header
    any_type = options.type == "*"
    say(
        message={"length": len(message._buff)} if any_type else plain(message),
        callerid=header["callerid"],
        latching=header.get("latching"),
        definition=header["message_definition"],
        type=header["type"],
    )


rospy.init_node(options.name)
cls = rospy.AnyMsg if options.type == "*" else message_class(options.type)
subscriber = rospy.Subscriber(options.topic, cls, heard)
say(ready=True)
rospy.spin()
say(shutdown=True)
