"""YAML on standard input, as rosparam writes it, to JSON."""

import json
import sys

import yaml

json.dump(yaml.safe_load(sys.stdin), sys.stdout)
