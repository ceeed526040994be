"""What a node does in the graph: its publishers, subscribers, services and parameters."""
