"""Parameters: asked for, changed and followed."""
