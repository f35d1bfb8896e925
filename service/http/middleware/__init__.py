"""Middleware around the whole application, outermost first: request id, HEAD, security headers, host, origin.

Nothing here knows paths. What differs from route to route (key, body limit, conditions) is in
`service.http.route`.
"""
