"""Topics: publishers, subscribers, and what they share."""
