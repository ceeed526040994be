"""What a node logs, on ``/rosout`` and elsewhere."""
