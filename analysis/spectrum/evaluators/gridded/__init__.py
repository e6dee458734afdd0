"""The gridded product: the first axis is carried to a grid by a window, and the others are summed exactly."""
