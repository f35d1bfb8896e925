"""Why a decision was taken, proved: every claim is a re-run of perceive → forecast → plan.

`query` finds the decision that is meant, `causes` and `contrast` prove what brought it about,
`crash` the same for how an episode ended, `facts` is what they answer. Words come last and elsewhere.
"""

from sim.explain.alternatives import Alternatives, Future
from sim.explain.facts import Cause, Counterfactual, Explanation, QuestionError, Role, Verified
from sim.explain.query import why, why_not

__all__ = [
    "Alternatives",
    "Cause",
    "Counterfactual",
    "Explanation",
    "Future",
    "QuestionError",
    "Role",
    "Verified",
    "why",
    "why_not",
]
