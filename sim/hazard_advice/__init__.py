"""Advice about a hazard ahead: brake, steer or keep on, with the chance of coming away unharmed.

`physics` has the textbook formulas. Uncertain quantities (reaction time, friction, the distance itself)
follow published distributions (`parameters`) and are sampled once (`samples`). The chance of a choice is the
share of samples without harm (`chances`); the choice with the best chance is advised, before people on foot
the one with the least expected harm by the published risk of death (`advise`). Not
modelled: motion of the hazard, traffic behind and beside, slopes and the build-up of brake pressure. Braking
while steering shares the friction between them. Sentences are made elsewhere.
"""

from sim.hazard_advice.advise import advise
from sim.hazard_advice.facts import Advice, Choice, Ending, Figures, NoAdviceError, Prospect

__all__ = ["Advice", "Choice", "Ending", "Figures", "NoAdviceError", "Prospect", "advise"]
