"""The commands of `roadtalk`, one subject to a file; `main` gives them their names."""
