"""Listening: from what was said in a session to actions that may be done, taught phrases included."""
