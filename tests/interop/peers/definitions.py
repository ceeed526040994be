"""What Debian's tools and classes say of the types named: md5sum and full text."""

import sys

import rosmsg
from common import message_class, say, service_class

for kind, _, name in (argument.partition(":") for argument in sys.argv[1:]):
    mode = rosmsg.MODE_MSG if kind == "msg" else rosmsg.MODE_SRV
    try:
        cls = message_class(name) if kind == "msg" else service_class(name)
        md5 = rosmsg.rosmsg_md5(mode, name)
    except (AssertionError, OSError):
        continue
    say(kind=kind, type=name, md5=md5, text=getattr(cls, "_full_text", ""))
say(done=True)
