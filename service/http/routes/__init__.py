"""Routes, one file for each resource, thin over `service.sessions`."""
