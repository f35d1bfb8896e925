"""The commands of `roadtalk` beside `serve`, one subject to a file; `service.cli` gives them their names."""
