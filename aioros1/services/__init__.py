"""Services: providers and callers."""
