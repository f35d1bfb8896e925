"""A run over time: its log, changes to it, and how states are saved and restored."""
