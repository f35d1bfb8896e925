"""Searches in a grid over time: which cells can be reached when, and what the cheapest path costs.

`reachability` steps whole sets of cells (breadth first), `astar` expands one state at a time with a
heuristic, and `backward_dp` settles all states backwards from the goal (Dijkstra's order, given by time).
They share what a step is (`step_costs`, `graph`) and nothing else, so that each is an oracle for the others.
"""
