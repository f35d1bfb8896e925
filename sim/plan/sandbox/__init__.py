"""Sandbox for planners of other packages: each runs in a process of its own, which may hang, crash or lie."""
