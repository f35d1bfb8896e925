"""Middleware around the whole application, outermost first: id, HEAD, headers, host, origin.

Only `direct_routes` knows paths, from the routes themselves. What differs from route to route (key, body
limit, conditions) is in `service.http.route`.
"""
