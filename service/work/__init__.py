"""Work: what requests cost, how much of it is done, and where: event loop, thread or worker process."""
