"""Tests of `service.actions`."""
