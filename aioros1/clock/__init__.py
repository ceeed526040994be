"""The time of a node, and what goes by it."""
