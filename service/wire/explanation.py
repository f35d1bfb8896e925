"""The structured part of an explanation as JSON values: all that its words were made from."""

from __future__ import annotations

from typing import Any

from service import actions as contract
from service.wire.decision import option_json
from sim.explain import Cause, Counterfactual, Explanation

Json = dict[str, Any]


def explanation_json(explanation: Explanation) -> Json:
    """Causes, alternatives, proofs; every `change` is a list of actions to try it with at that tick."""
    decision, verified = explanation.decision, explanation.verified
    flips = [_flip_json(flip) for flip in explanation.counterfactuals]
    return {
        "tick": decision.tick,
        "move": decision.move,
        "foil": explanation.foil,
        "causes": [_cause_json(cause) for cause in explanation.causes],
        "alternatives": [option_json(option) for option in decision.options],
        "verified": {
            "necessary": verified.necessary,
            "sufficient": verified.sufficient,
            "minimal": verified.minimal,
        },
        "counterfactual": flips[0] if flips else None,
        "evidence": {"counterfactuals": flips, "reruns": explanation.reruns},
    }


def _cause_json(cause: Cause) -> Json:
    return {
        "id": cause.id,
        "kind": cause.kind,
        "cell": cause.cell,
        "role": cause.role,
        "moves": cause.moves,
        "necessary": cause.necessary,
        "group": cause.group,
    }


def _flip_json(flip: Counterfactual) -> Json:
    return {"change": contract.dump(flip.change), "decision": flip.move}
