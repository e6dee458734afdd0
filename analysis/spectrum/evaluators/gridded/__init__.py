"""The gridded product: one axis is carried to a grid by a window, the others are summed as they are."""
