"""The report of a comparison of stipplings: table, pictures and page."""
