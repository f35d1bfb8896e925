"""Ways through a grid over time: which cells can be reached when, and what the cheapest way costs.

`reach` steps whole sets of cells, `astar` one state at a time with a heuristic, `sweep` all states
backwards from the goal. They share what a step is (`moves`, `terrain`) and nothing else, so that
each is an oracle for the others.
"""
