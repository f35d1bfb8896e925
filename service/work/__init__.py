"""Work: what dear requests cost, how much of it is done, and where: on the event loop, in a thread, in a process."""
