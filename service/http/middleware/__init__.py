"""Middleware, one file for each concern, in the order in which `service.app` adds it."""
