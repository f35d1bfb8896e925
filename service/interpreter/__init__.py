"""The interpreter: from text to actions and their outcome, taught phrases included."""
