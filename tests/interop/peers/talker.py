"""A rospy publisher; message number i is the JSON given, with its "$i" replaced.

Unless it latches it waits for a subscriber, so that the first one hears all of it.
"""

import argparse
import json

import genpy
import rospy
from common import message_class, say

parser = argparse.ArgumentParser()
parser.add_argument("topic")
parser.add_argument("type")
parser.add_argument("fields")
parser.add_argument("--name", default="rospy_talker")
parser.add_argument("--count", type=int, default=0)
parser.add_argument("--rate", type=float, default=100)
parser.add_argument("--latch", action="store_true")
parser.add_argument("--bytes", type=int, help="fill the field `data` with so many bytes")
options = parser.parse_args(rospy.myargv()[1:])


class Watch(rospy.SubscribeListener):
    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        say(subscriber=topic_name)

    def peer_unsubscribe(self, topic_name, num_peers):
        say(gone=topic_name)


rospy.init_node(options.name)
cls = message_class(options.type)
publisher = rospy.Publisher(
    options.topic, cls, subscriber_listener=Watch(), latch=options.latch, queue_size=100
)
say(ready=True, definition=cls._full_text)
rate = rospy.Rate(options.rate)
i = 0
while not rospy.is_shutdown():
    connected = options.latch or publisher.get_num_connections() > 0
    if connected and (options.count == 0 or i < options.count):
        message = cls()
        fields = json.loads(options.fields.replace("$i", str(i)))
        genpy.message.fill_message_args(message, [fields] if fields else [])
        if options.bytes is not None:
            message.data = bytes((k + i) % 251 for k in range(options.bytes))
        publisher.publish(message)
        i += 1
    try:
        rate.sleep()
    except rospy.ROSInterruptException:
        break
say(shutdown=True)
