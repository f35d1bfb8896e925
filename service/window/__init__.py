"""The window: the road, what the vehicle thinks, and a line to talk to it, without any service running.

    events ─▶ controls ─▶ game (a session of the service, in memory) ─▶ showing ─▶ painting ─▶ screen

It joins what is there: the session, language and words are the service's own, in the same order of
travel, and the views are those of `sim.render`. What is added is time brought frame by frame, a line to
type in, and where things stand on the screen. Leaves out: anything about HTTP, files kept between runs,
sound. Importing this package imports no pygame.
"""
