"""Parameters: reading, changing and following them."""
