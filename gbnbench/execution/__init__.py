"""Carrying work out: a pool of worker processes, the tasks they are given, and progress."""
