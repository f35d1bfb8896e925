"""What to do about a hazard ahead: brake, steer or keep, and how sure that is.

The motion is the textbook's (`physics`); what nobody knows exactly (reaction, grip, the distance itself)
is drawn from published distributions (`parameters`), always the same draws (`samples`); an option's
chance is the share of draws in which it comes away unharmed (`chances`), and the best chance is advised
(`advise`). Left out: movement of the hazard, traffic behind and beside, slopes, the build-up of brake
pressure, and braking while steering. Words come elsewhere.
"""

from sim.hazard_advice.advise import advise
from sim.hazard_advice.facts import Advice, Choice, Ending, Figures, NoAdviceError, Prospect

__all__ = ["Advice", "Choice", "Ending", "Figures", "NoAdviceError", "Prospect", "advise"]
