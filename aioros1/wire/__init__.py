"""What goes over the wire, as pure functions and state machines without any I/O."""
