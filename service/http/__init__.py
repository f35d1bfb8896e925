"""HTTP and the stream: one file for each resource, thin over `service.sessions`."""
