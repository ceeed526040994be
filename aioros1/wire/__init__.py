"""The wire formats, as pure functions and state machines without any I/O."""
