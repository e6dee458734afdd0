"""Generators from elsewhere: classes of installed packages, and external programs that a file describes."""
