"""Nodes in programs of other kinds: web frameworks, and programs without an event loop.

Each module is imported by who wants it, and needs what it is named after.
"""
