"""Evaluations as jobs of the service: how one is asked for, run, told and reported."""
