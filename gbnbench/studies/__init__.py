"""The two studies: the comparison of point sets, and numerical integration with them."""
