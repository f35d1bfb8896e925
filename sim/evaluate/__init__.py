"""Evaluations: many episodes with one or several planners on the same roads, and what can be said of them.

An `Evaluation` says what is run, `run_part` runs a stretch of its episodes, an executor does so in several
processes, and `summarize` makes the figures. The result depends on the evaluation alone: not on how it is cut
into parts, nor on the number of processes or the order in which they finish.
"""

from sim.evaluate.spec import Evaluation, EvaluationError, Part

__all__ = ["Evaluation", "EvaluationError", "Part"]
