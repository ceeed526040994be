"""XML-RPC: client and server, and master and nodes as they are called."""
