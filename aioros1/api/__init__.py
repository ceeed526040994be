"""The XML-RPC APIs of ROS 1: the master's and other nodes', as they are called, and our own."""
