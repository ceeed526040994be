"""How a node comes to be, stays known to its master, and ends."""
