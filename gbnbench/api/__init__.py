"""Studies as Python objects: a call makes one in a folder, and it holds the tables, figures and report."""
