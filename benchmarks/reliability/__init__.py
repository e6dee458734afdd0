"""Trials of what must not fail: damaged files, kills, full disks, crowds, little memory, wrong kernels."""
