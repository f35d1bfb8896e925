"""Advice about a hazard ahead: brake, steer or keep on, with the chance of coming away unharmed.

`physics` has the textbook formulas. Uncertain quantities (reaction time, friction, the distance itself)
follow published distributions (`parameters`) and are sampled once (`samples`). The chance of a choice is the
share of samples without harm (`chances`); the choice with the best chance is advised (`advise`). Not
modelled: motion of the hazard, traffic behind and beside, slopes, the build-up of brake pressure, and braking
while steering. Sentences are made elsewhere.
"""

from sim.hazard_advice.advise import advise
from sim.hazard_advice.facts import Advice, Choice, Ending, Figures, NoAdviceError, Prospect

__all__ = ["Advice", "Choice", "Ending", "Figures", "NoAdviceError", "Prospect", "advise"]
