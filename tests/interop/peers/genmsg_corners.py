"""What Debian's genmsg reads in definitions of corner_msgs/Corner, or null where it fails.

Standard input has them as JSON: pairs of a kind and a text, or the name of a file for both.
"""

import json
import sys

from genmsg import gentools, msg_loader

SHARE = {name: [f"/usr/share/{name}/msg"] for name in ("std_msgs", "geometry_msgs")}
LOAD = {
    "msg": msg_loader.load_msg_from_string,
    "srv": msg_loader.load_srv_from_string,
    "file": msg_loader.load_msg_from_file,
}


def read(kind, text, other):
    context = msg_loader.MsgContext.create_default()
    msg_loader.load_msg_from_string(context, other, "corner_msgs/Other")
    try:
        spec = LOAD[kind](context, text, "corner_msgs/Corner")
        msg_loader.load_depends(context, spec, SHARE)
        md5sum = gentools.compute_md5(context, spec)
    except Exception:
        return None
    specs = [spec.request, spec.response] if kind == "srv" else [spec]
    return {"md5sum": md5sum, "specs": [show(one) for one in specs]}


def show(spec):
    return {
        "text": spec.text,
        "has_header": spec.has_header(),
        "fields": [[f.name, f.type, f.base_type, f.array_len] for f in spec.parsed_fields()],
        "constants": [[c.type, c.name, repr(c.val), c.val_text] for c in spec.constants],
    }


question = json.load(sys.stdin)
json.dump([read(*case, question["other"]) for case in question["cases"]], sys.stdout)
