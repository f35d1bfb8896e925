"""Makes sentences by program and compares what they mean with what they must mean.

Nothing here takes part in understanding a sentence. `sayings` holds the sentences to start from, `pairs`
joins two of them, `mutations` changes words of one, and `run` counts what became of them.
"""
