"""Connections: how they are made and accepted, and the protocols that run on them."""
