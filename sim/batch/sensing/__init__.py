"""Sensors in a batch: beliefs of many worlds side by side, and the rule planner on what is believed."""
