"""Planners of other packages, each in a process of its own that may hang, crash or lie."""
