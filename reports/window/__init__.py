"""The picture of estimates in a window."""
