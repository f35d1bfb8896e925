"""How sessions are stored and come back: log, replay, snapshots, recordings."""
