"""Logging of a node, to ``/rosout`` and elsewhere."""
