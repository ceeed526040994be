"""Nodes in other kinds of programs: web frameworks, and programs without an event loop.

Import the module you want; it needs the package that it is named after.
"""
