"""Timing of code on a shared machine, and the record of that machine."""
