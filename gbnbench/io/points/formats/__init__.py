"""One module a format of point files, and their registry."""
