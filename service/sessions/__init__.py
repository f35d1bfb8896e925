"""Live sessions: a timeline each, their scheduler and their persistence."""
