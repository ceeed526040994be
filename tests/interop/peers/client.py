"""A rospy service client; each line on standard input, or --count, is one more call."""

import argparse
import json
import sys

import genpy
import rospy
from common import plain, say, service_class

parser = argparse.ArgumentParser()
parser.add_argument("service")
parser.add_argument("type")
parser.add_argument("requests", nargs="+", help="a JSON object each")
parser.add_argument("--persistent", action="store_true")
parser.add_argument("--step", action="store_true", help="wait for a line before each call")
parser.add_argument("--name", default="rospy_client")
options = parser.parse_args(rospy.myargv()[1:])

rospy.init_node(options.name)
cls = service_class(options.type)
rospy.wait_for_service(options.service, timeout=10)
proxy = rospy.ServiceProxy(options.service, cls, persistent=options.persistent)
say(ready=True)
for text in options.requests:
    if options.step:
        sys.stdin.readline()
    request = cls._request_class()
    fields = json.loads(text)
    genpy.message.fill_message_args(request, [fields] if fields else [])
    try:
        say(answer=plain(proxy(request)))
    except Exception as error:
        say(error=str(error), kind=type(error).__name__)
proxy.close()
say(done=True)
