"""The time of a node, and the rates and timers that follow it."""
