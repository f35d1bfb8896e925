"""When sessions tick: the clock, its batches, playback speed, eviction and work beside the event loop."""
