"""A rospy service server: answers as JSON says, raises, returns nothing, or hangs."""

import argparse
import json
import time

import genpy
import rospy
from common import plain, say, service_class

parser = argparse.ArgumentParser()
parser.add_argument("service")
parser.add_argument("type")
parser.add_argument("--reply", default="{}")
parser.add_argument("--error", help="raise this")
parser.add_argument("--none", action="store_true")
parser.add_argument("--hang", action="store_true", help="never answer")
parser.add_argument("--name", default="rospy_server")
options = parser.parse_args(rospy.myargv()[1:])
cls = service_class(options.type)


def answer(request):
    say(request=plain(request), callerid=request._connection_header["callerid"])
    while options.hang and not rospy.is_shutdown():
        time.sleep(0.1)
    if options.error is not None:
        raise ValueError(options.error)
    if options.none:
        return None
    response = cls._response_class()
    fields = json.loads(options.reply)
    genpy.message.fill_message_args(response, [fields] if fields else [])
    return response


rospy.init_node(options.name)
service = rospy.Service(options.service, cls, answer)
say(ready=True)
rospy.spin()
say(shutdown=True)
