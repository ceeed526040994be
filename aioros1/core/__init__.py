"""What every part of a node is given: its context, tasks, registrations, and the base of roles."""
