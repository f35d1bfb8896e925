"""WebSocket, server-sent events and the stream of frames."""
