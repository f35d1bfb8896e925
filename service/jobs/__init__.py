"""Background jobs: work of minutes, cut into pieces that are kept as they are finished."""

from service.jobs.kind import JobKind, Piece
from service.jobs.runner import JobRunner, JobState

__all__ = ["JobKind", "JobRunner", "JobState", "Piece"]
